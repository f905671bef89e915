#!/usr/bin/env python3
"""Path tracing by Trace and by Cycles, in turn, of the same two scenes.

beside_cycles.py RAY MESHES [--seeds N] [--samples N] [--scenes NAME...] [--keep FOLDER]

Prints a Markdown table. The error is the relative variance: of each pixel's luminance the variance over the seeds,
over mean^2 + 0.01 (mean of the picture)^2, averaged over the pixels; and over all but the hundredth that is worst,
which is that of rare bright paths. Where the mean is right, that is the squared error without a reference. CPU seconds are
medians: of Trace for the whole process, of Cycles around the render, without Blender's start and the making of the
scene. The last column is Trace's product over that of Cycles.
"""
import argparse
import array
import itertools
import os
import re
import resource
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
import zlib

from equal_time import luminance

HERE = os.path.dirname(os.path.abspath(__file__))


def cpu_of(command, **how):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, check=True, **how)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done


def by_trace(ray, scene, samples, seed, out, _):
    return cpu_of([ray, os.path.join(HERE, scene + ".ray"), "-q", "-o", out, "--spp", str(samples), "--seed", str(seed)])[0]


def by_cycles(_, scene, samples, seed, out, mesh):
    command = ["blender", "--background", "--factory-startup", "--python", os.path.join(HERE, "cycles.py"), "--", scene,
               str(samples), str(seed), out] + ([mesh] if scene == "dragon" else [])
    said = cpu_of(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)[1].stdout
    return next(float(line.split()[1]) for line in said.splitlines() if line.startswith("cpu "))


def read_exr(path):
    """The pixels of an OpenEXR picture of 32-bit floats R, G, B, stored as they are or by deflate."""
    data = open(path, "rb").read()
    at, header = 8, {}
    while data[at]:
        name, kind, at = *data[at:].split(b"\0", 2)[:2], at
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        header[name], at = data[at + 4:at + 4 + size], at + 4 + size
    channels = [entry[:1] for entry in re.findall(rb"([A-Z])\0\x02\0\0\0.{12}", header[b"channels"], re.DOTALL)]
    left, top, right, bottom = struct.unpack("<4i", header[b"dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    rows = {0: 1, 2: 1, 3: 16}[header[b"compression"][0]]
    pixels = []
    for place in struct.unpack_from(f"<{-(-height // rows)}Q", data, at + 1):
        size = struct.unpack_from("<i", data, place + 4)[0]
        block = data[place + 8:place + 8 + size]
        if size < 4 * width * len(channels) * min(rows, height - len(pixels) // width):
            bytewise = bytes(itertools.accumulate(zlib.decompress(block), lambda a, b: (a + b - 128) & 255))
            half = -(-len(bytewise) // 2)
            block = bytearray(len(bytewise))
            block[0::2], block[1::2] = bytewise[:half], bytewise[half:]
        values = array.array("f", bytes(block))
        for start in range(0, len(values), width * len(channels)):
            planes = [values[start + n * width:start + (n + 1) * width] for n in range(len(channels))]
            pixels += zip(*(planes[channels.index(name)] for name in (b"R", b"G", b"B")))
    return pixels


def variances(pictures):
    """The mean luminance, and the relative variance of all pixels and of all but the worst hundredth."""
    bright = sum(map(sum, pictures)) / sum(map(len, pictures))
    each = []
    for values in zip(*pictures):
        mean = sum(values) / len(values)
        each.append(sum((v - mean) ** 2 for v in values) / (len(values) - 1) / (mean * mean + 0.01 * bright * bright))
    each.sort()
    most = each[:len(each) - len(each) // 100]
    return bright, sum(each) / len(each), sum(most) / len(most)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ray")
    parser.add_argument("meshes")
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--scenes", nargs="+", default=["cornell", "dragon"])
    parser.add_argument("--keep", help="a folder for the pictures")
    given = parser.parse_args()
    if given.seeds < 2:
        parser.error("a variance takes two seeds or more")
    peers = {"Trace": by_trace, "Cycles": by_cycles}
    if not shutil.which("blender"):
        sys.exit("beside_cycles.py: SKIPPED: there is no blender")
    folder = given.keep or tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    print("| scene | by | mean | CPU s | error | of 99 % | s x error | s x error of 99 % | of Cycles |")
    print("|---|---|--:|--:|--:|--:|--:|--:|--:|")
    for scene in given.scenes:
        mesh = os.path.join(given.meshes, "dragon.ply")
        if scene == "dragon" and not os.path.exists(mesh):
            print(f"beside_cycles.py: SKIPPED the dragon: there is no {mesh}", file=sys.stderr)
            continue
        seconds, pictures = ({name: [] for name in peers} for _ in range(2))
        for seed in range(1, given.seeds + 1):
            for name, render in peers.items():  # in turn, so that both find the machine in the same state
                out = os.path.join(folder, f"{scene}-{name}-{seed}.exr")
                seconds[name].append(render(given.ray, scene, given.samples, seed, out, mesh))
                pictures[name].append([luminance(pixel) for pixel in read_exr(out)])
        found = {name: (statistics.median(seconds[name]), *variances(pictures[name])) for name in peers}
        for name, (cpu, mean, every, most) in found.items():
            its = found["Cycles"]
            print(f"| {scene} | {name} | {mean:.4f} | {cpu:.2f} | {every:.3g} | {most:.3g} | {cpu * every:.3g} | "
                  f"{cpu * most:.3g} | {cpu * every / (its[0] * its[2]):.2f} ({cpu * most / (its[0] * its[3]):.2f}) |", flush=True)
    if not given.keep:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
