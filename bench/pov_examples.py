#!/usr/bin/env python3
"""Renders every .pov file of a folder by Trace and by POV-Ray, and compares the pictures.

    bench/pov_examples.py [--ray build/release/bin/ray] [--out FOLDER] [--width 160] [--limit SECONDS] [SCENES...]

Without SCENES it takes Debian's package povray-examples. It prints how many scenes were read, how many
left nothing out, how many pictures lie within RMSE 8 (of 255) of POV-Ray's, and the most frequent omissions.
Some scenes of portfolio/ need options of their .ini files: POV-Ray alone makes no picture of them.
POV-Ray's pictures are kept in FOLDER and made once. It needs povray, and Python 3 with nothing else.
"""
import argparse
import collections
import json
import math
import os
import re
import struct
import subprocess
import zlib

EXAMPLES = "/usr/share/doc/povray/examples"


def read_png(path):
    """Width, height and bytes of an 8 bit RGB or RGBA picture, without its transparency."""
    data = open(path, "rb").read()
    at, packed, width, height, channels = 8, b"", 0, 0, 3
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            channels = {0: 1, 2: 3, 6: 4}[colour]
            if depth != 8:
                raise ValueError("not 8 bits")
        elif kind == b"IDAT":
            packed += body
        at += size + 12
    raw, step = zlib.decompress(packed), width * channels
    rows, before = [], bytearray(step)
    for y in range(height):
        kind, line = raw[y * (step + 1)], bytearray(raw[y * (step + 1) + 1:(y + 1) * (step + 1)])
        for i in range(step):
            a = line[i - channels] if i >= channels else 0
            b, c = before[i], before[i - channels] if i >= channels else 0
            if kind == 1:
                line[i] = (line[i] + a) & 255
            elif kind == 2:
                line[i] = (line[i] + b) & 255
            elif kind == 3:
                line[i] = (line[i] + (a + b) // 2) & 255
            elif kind == 4:
                p = a + b - c
                near = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                line[i] = (line[i] + near) & 255
        rows.append(line)
        before = line
    pixels = bytearray()
    for line in rows:
        for x in range(width):
            part = line[x * channels:x * channels + channels]
            pixels += bytes(part[:3]) if channels > 1 else bytes(part) * 3
    return width, height, bytes(pixels)


def rmse(a, b):
    if a[:2] != b[:2]:
        return None
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a[2], b[2])) / len(a[2]))


def by_trace(args, scene, picture):
    command = [args.ray, scene, picture, "-w", str(args.width), "--spp", "9", "--time-limit", str(args.limit),
               "--threads", "1"]
    run = subprocess.run(command, capture_output=True, text=True, errors="replace",
                         timeout=args.limit * 4 + 60)
    left = re.findall(r"warning: (.*? left out)", run.stderr)
    failed = re.findall(r"error: (.*)", run.stderr)
    return run.returncode, left, failed, run.stderr


def by_povray(args, scene, picture, width, height):
    # Nine samples for every pixel, and the mean of their light, as Trace has it.
    command = ["povray", f"+I{scene}", f"+O{picture}", f"+W{width}", f"+H{height}", "-D", "+A0.0", "+R3",
               "-J", "+AG1.0", "-GA",
               "+WT1", f"+L{os.path.dirname(scene)}"]
    try:
        subprocess.run(command, capture_output=True, timeout=args.limit * 2, cwd=os.path.dirname(scene))
    except subprocess.TimeoutExpired:
        pass


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--ray", default="build/release/bin/ray")
    parser.add_argument("--out", default="build/pov-examples")
    parser.add_argument("--width", type=int, default=160)
    parser.add_argument("--limit", type=float, default=15)
    parser.add_argument("--part", default="0/1", help="N/M: every M-th scene from the N-th on")
    parser.add_argument("scenes", nargs="*")
    args = parser.parse_args()
    scenes = args.scenes
    if not scenes:
        for folder, _, files in os.walk(EXAMPLES):
            scenes += [os.path.join(folder, f) for f in files if f.endswith(".pov")]
    scenes.sort()
    first, step = (int(x) for x in args.part.split("/"))
    scenes = scenes[first::step]
    os.makedirs(args.out, exist_ok=True)
    results, omissions = [], collections.Counter()
    for scene in scenes:
        name = os.path.relpath(scene, EXAMPLES).replace("/", "_")[:-4] if scene.startswith(EXAMPLES) else \
            os.path.basename(scene)[:-4]
        ours = os.path.join(args.out, name + ".trace.png")
        theirs = os.path.join(args.out, name + ".pov.png")
        result = {"scene": scene, "read": False, "whole": False, "rmse": None, "why": ""}
        try:
            code, left, failed, said = by_trace(args, scene, ours)
        except subprocess.TimeoutExpired:
            code, left, failed, said = 5, [], ["too slow"], ""
        result["read"] = code == 0
        result["whole"] = code == 0 and not left
        result["left"] = left
        result["why"] = failed[0] if failed else ""
        omissions.update(set(left))
        if failed:
            omissions["ERROR " + re.sub(r"\"[^\"]*\"", "\"...\"", failed[0])[:90]] += 1
        if code == 0 and os.path.exists(ours):
            mine = read_png(ours)
            if not os.path.exists(theirs):
                by_povray(args, scene, theirs, mine[0], mine[1])
            if os.path.exists(theirs):
                try:
                    result["rmse"] = rmse(mine, read_png(theirs))
                except (ValueError, KeyError, zlib.error):
                    pass
        results.append(result)
        shown = "-" if result["rmse"] is None else f"{result['rmse']:.1f}"
        print(f"{name}: {'read' if result['read'] else 'FAILED'} rmse {shown} "
              f"{'; '.join(left[:3])} {result['why'][:100]}", flush=True)
    with open(os.path.join(args.out, f"results-{first}-{step}.json"), "w") as file:
        json.dump(results, file, indent=1)
    n = max(len(results), 1)
    compared = [r["rmse"] for r in results if r["rmse"] is not None]
    close = sum(value <= 8 for value in compared)
    print(f"\n{len(results)} scenes: {sum(r['read'] for r in results)} read, "
          f"{sum(r['whole'] for r in results)} without an omission ({100 * sum(r['whole'] for r in results) / n:.0f} %), "
          f"{close} within RMSE 8 ({100 * close / n:.0f} %; {100 * close / max(len(compared), 1):.0f} % of the "
          f"{len(compared)} that both programs rendered in time)")
    for what, count in omissions.most_common(40):
        print(f"{count:5d}  {what}")


if __name__ == "__main__":
    main()
