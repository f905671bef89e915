#!/usr/bin/env python3
"""Renders the pictures of docs/gallery.md, each by the command on the page, and writes size and estimated error below it.

Usage: gallery.py RAY [NAME...]   the pictures of these sections only
"""
import json, re, shlex, subprocess, sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/gallery.md"
PICTURE = re.compile(r"^!\[.*\]\((gallery/.*)\)\n(?:\n\*.* pixels.*\*\n)?", re.M)
COMMAND = re.compile(r"^    (ray .*)$", re.M)


def caption(picture, command, ray):
    """Renders by the command into the picture; what is to stand below it."""
    arguments = shlex.split(command)[1:]
    if arguments[0] == "render":
        del arguments[0]
    if "-o" in arguments:
        del arguments[arguments.index("-o"):][:2]
    frames = arguments.index("--frames") if "--frames" in arguments else None
    if frames is not None:  # the page shows its first frame
        del arguments[frames:frames + 2]
    run = subprocess.run([ray, "render", *arguments, "-o", picture, "--passes", "none", "--strict", "--resume=never",
                          "--jpeg-quality", "90", "--stats=json"], cwd=ROOT, stdout=subprocess.PIPE, check=True)
    said = json.loads(run.stdout)
    text = f"{said['width']} x {said['height']} pixels"
    if (said["error"]["mean"] or 0) >= 0.005:
        before = " before denoising" if said["settings"].get("denoise") == "on" else ""
        text += f", estimated error {said['error']['mean']:.2g} of 255 levels{before}"
    return f"\n*{text}*\n"


def sections():
    """The parts of the page that show a picture and its command, by name."""
    parts = re.split(r"^(?=### )", PAGE.read_text(), flags=re.M)
    named = {part.split("\n", 1)[0].removeprefix("### "): part for part in parts}
    return {name: part for name, part in named.items() if PICTURE.search(part) and COMMAND.search(part)}


def main(ray, names):
    known = sections()
    if unknown := set(names) - set(known):
        sys.exit(f"gallery.py: docs/gallery.md has no picture of {', '.join(sorted(unknown))}")
    for name in names or known:
        below = caption(f"docs/{PICTURE.search(known[name])[1]}", COMMAND.search(known[name])[1], ray)
        part = sections()[name]  # the page may have been edited since
        shown = PICTURE.search(part)
        line = shown[0].split("\n", 1)[0]
        PAGE.write_text(PAGE.read_text().replace(part, part.replace(shown[0], line + "\n" + below)))


main(str(Path(sys.argv[1]).resolve()), sys.argv[2:])
