#!/usr/bin/env python3
"""Joins drawings of `ray explain --format svg`, each of another pixel of one scene, to one that moves: `./dev lessons` calls it.

Usage: animate.py DRAWING.svg... > MOVING.svg
"""
import re
import sys
from pathlib import Path

SECONDS = 1.2  # that each pixel is shown


def frame(number: int, drawing: str) -> str:
    """All of a drawing but the ground and the picture from the camera, which all of them share; a ring is around the pixel."""
    body = re.sub(r"\A<svg[^>]*>\n<rect[^>]*>\n|</svg>\s*\Z", "", drawing)
    body = re.sub(r"<image[^>]*>\n", "", body, count=1)
    body = re.sub(r"\bframe(\d)\b", rf"f{number}-\1", body)
    x, y = re.search(r'<circle cx="([\d.]+)" cy="([\d.]+)"', body).groups()
    ring = f'<circle cx="{x}" cy="{y}" r="9" fill="none" stroke="#d52b2b" stroke-width="2"/>\n'
    return f'<g class="pixel" style="animation-delay:{SECONDS * number:.2f}s">\n{body}{ring}</g>\n'


def main() -> None:
    drawings = [Path(name).read_text() for name in sys.argv[1:]]
    head = re.match(r"<svg[^>]*>\n<rect[^>]*>\n", drawings[0])[0]
    width, height = re.search(r'width="([\d.]+)" height="([\d.]+)"', head).groups()
    head = head.replace("<svg ", f'<svg viewBox="0 0 {width} {height}" ', 1)  # so that a page can scale it
    picture = re.search(r"<image[^>]*>\n", drawings[0])[0]
    if any(picture not in drawing for drawing in drawings):
        sys.exit("animate.py: the drawings are not of one scene")
    count = len(drawings)
    style = (f"<style>.pixel{{visibility:hidden;animation:show {SECONDS * count:.2f}s step-end infinite}}"
             f"@keyframes show{{0%{{visibility:visible}}{100 / count:.4f}%{{visibility:hidden}}}}"
             "@media(prefers-reduced-motion:reduce){.pixel{animation:none}.pixel:last-of-type{visibility:visible}}</style>\n")
    print(head + style + picture + "".join(frame(i, drawing) for i, drawing in enumerate(drawings)) + "</svg>")


if __name__ == "__main__":
    main()
