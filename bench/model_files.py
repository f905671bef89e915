#!/usr/bin/env python3
"""Renders every model of some folders at 96x72, and lists what was refused, what was reported and what is empty.

    bench/model_files.py [--ray build/release/bin/ray] [--out FOLDER] [--limit SECONDS] FOLDER...

It prints a line for each file and a summary: the refusals with their reasons, the kinds of warnings with their
numbers, and the pictures of one colour whose files had no warning, which may be silent losses. FOLDER/sheet.png
shows all pictures in the order of the lines; FOLDER/results.json has the messages. It needs Python 3 alone.
"""
import argparse
import collections
import json
import os
import re
import struct
import subprocess
import zlib

SUFFIXES = (".obj", ".gltf", ".glb", ".ply", ".stl", ".off", ".wrl", ".iv", ".out")
WIDTH, HEIGHT, COLUMNS = 96, 72, 16


def models_of(folders):
    found = []
    for folder in folders:
        for place, _, files in os.walk(folder):
            found += [os.path.join(place, f) for f in files if f.lower().endswith(SUFFIXES)]
    return sorted(found)


def read_ppm(path):
    """The pixels of a picture of WIDTH x HEIGHT, or None."""
    try:
        data = open(path, "rb").read()
    except OSError:
        return None
    size = 3 * WIDTH * HEIGHT
    return data[-size:] if len(data) > size else None


def write_png(path, width, height, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows))) + chunk(b"IEND", b""))


def write_sheet(path, pictures):
    refused = bytes((96, 0, 0)) * (WIDTH * HEIGHT)
    lines = [pictures[i:i + COLUMNS] for i in range(0, len(pictures), COLUMNS)]
    rows = []
    for line in lines:
        line = [p or refused for p in line] + [bytes(3 * WIDTH * HEIGHT)] * (COLUMNS - len(line))
        for y in range(HEIGHT):
            rows.append(b"".join(p[3 * WIDTH * y:3 * WIDTH * (y + 1)] for p in line))
    write_png(path, WIDTH * COLUMNS, HEIGHT * len(lines), rows)


def is_flat(picture):
    """Nearly all pixels have one colour."""
    pixels = collections.Counter(picture[i:i + 3] for i in range(0, len(picture), 3))
    return pixels.most_common(1)[0][1] > 0.998 * WIDTH * HEIGHT


def kind_of(message):
    return re.sub(r"[0-9][0-9.]*", "N", re.sub(r'"[^"]*"', '"..."', message))[:110]


def render(args, model, picture):
    command = [args.ray, model, picture, "-w", str(WIDTH), "--height", str(HEIGHT), "--quality", "draft",
               "--threads", "1", "--allow-read", args.root or os.path.dirname(model) or ".",
               "--time-limit", str(args.limit)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, errors="replace",
                             timeout=4 * args.limit + 30)
    except subprocess.TimeoutExpired:
        return None, ["too slow"], []
    return run.returncode, re.findall(r"error: (.*)", run.stderr), re.findall(r"warning: (.*)", run.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--ray", default="build/release/bin/ray")
    parser.add_argument("--out", default="build/model-files")
    parser.add_argument("--limit", type=float, default=20)
    parser.add_argument("--root", help="a folder below which all models may read")
    parser.add_argument("folders", nargs="+")
    args = parser.parse_args()
    os.makedirs(args.out, exist_ok=True)
    results, pictures, kinds = [], [], collections.Counter()
    for number, model in enumerate(models_of(args.folders)):
        picture = os.path.join(args.out, f"{number}.ppm")
        if os.path.exists(picture):
            os.remove(picture)
        code, errors, warnings = render(args, model, picture)
        pixels = read_ppm(picture)
        pictures.append(pixels)
        flat = pixels is not None and is_flat(pixels)
        results.append({"model": model, "code": code, "errors": errors, "warnings": warnings, "flat": flat})
        kinds.update({kind_of(w) for w in warnings})
        state = "REFUSED" if pixels is None else "FLAT" if flat else "shown"
        print(f"{number:4d} {state:7s} {model}: {'; '.join(errors + warnings)[:200]}", flush=True)
    write_sheet(os.path.join(args.out, "sheet.png"), pictures)
    with open(os.path.join(args.out, "results.json"), "w") as file:
        json.dump(results, file, indent=1)
    refused = [r for r, p in zip(results, pictures) if p is None]
    print(f"\n{len(results)} models, {len(refused)} refused")
    for result in refused:
        print(f"  {result['model']}: {'; '.join(result['errors']) or result['code']}")
    print("pictures of one colour without a warning:")
    for result in results:
        if result["flat"] and not result["warnings"]:
            print(f"  {result['model']}")
    print("kinds of warnings:")
    for kind, count in kinds.most_common():
        print(f"  {count:4d}  {kind}")


if __name__ == "__main__":
    main()
