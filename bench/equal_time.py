#!/usr/bin/env python3
"""Pictures of the integrators that follow light, each of the same CPU time on one thread, and how far they are off.

equal_time.py RAY NAME=SCENE=INTEGRATOR... [--seconds S] [--width W] [--seeds N] [--many SAMPLES] [--keep FOLDER] [-o FOLDER]

Writes FOLDER/equal-time-NAME.png, one row of pictures, with the one they are compared with last, and prints a Markdown
table. That one is of very many samples by the integrator that is named, mlt or bdpt. Of each pixel's luminance the square of the difference counts,
over reference^2 + 0.01 (mean of the reference)^2, averaged over the pixels; and over all but the hundredth that is worst,
which is that of rare bright paths. The samples are chosen by two short renders of each. The figures are means over
the seeds, the pictures those of the last one. --keep leaves the pictures of very many samples in a folder and takes them from there
the next time.
"""
import argparse
import os
import resource
import struct
import subprocess
import tempfile
import zlib

INTEGRATORS = {
    "path": ["path"],
    "bdpt": ["bdpt"],
    "photon": ["photon"],
    "mlt --chains path": ["mlt", "--chains", "path", "--chain-starts", "50000"],
    "mlt": ["mlt", "--chains", "bdpt", "--chain-starts", "50000"],
    "mlt --chains veach": ["mlt", "--chains", "veach", "--chain-starts", "50000"],
}


def read_hdr(path):
    """Width, height and the pixels of a picture of Radiance's format."""
    data = open(path, "rb").read()
    start = data.index(b"\n\n") + 2
    end = data.index(b"\n", start)
    words = data[start:end].split()
    height, width, at = int(words[1]), int(words[3]), end + 1
    pixels = []
    for _ in range(height):
        if data[at] == 2 and data[at + 1] == 2 and (data[at + 2] << 8 | data[at + 3]) == width:
            at += 4
            planes = []
            for _ in range(4):
                row = bytearray()
                while len(row) < width:
                    count = data[at]
                    if count > 128:
                        row += data[at + 1:at + 2] * (count - 128)
                        at += 2
                    else:
                        row += data[at + 1:at + 1 + count]
                        at += 1 + count
                planes.append(row)
            row = list(zip(*planes))
        else:
            row = [tuple(data[at + 4 * x:at + 4 * x + 4]) for x in range(width)]
            at += 4 * width
        for r, g, b, e in row:
            scale = 2.0 ** (e - 136) if e else 0.0
            pixels.append(((r + 0.5) * scale, (g + 0.5) * scale, (b + 0.5) * scale))
    return width, height, pixels


def luminance(pixel):
    return 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]


def errors(pixels, reference):
    """The mean squared relative error, of all and of all but the worst hundredth."""
    wanted = [luminance(p) for p in reference]
    least = 0.01 * (sum(wanted) / len(wanted)) ** 2
    each = sorted((luminance(p) - w) ** 2 / (w * w + least) for p, w in zip(pixels, wanted))
    most = each[:len(each) - len(each) // 100]
    return sum(each) / len(each), sum(most) / len(most)


def srgb(value, white):
    value = min(1.0, max(0.0, value / white))
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))


def write_row(path, width, height, pictures, white):
    """Pictures beside one another, as PNG."""
    gap = 4
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for number, pixels in enumerate(pictures):
            rows += b"\xff" * (3 * gap) if number else b""
            for pixel in pixels[y * width:(y + 1) * width]:
                rows += bytes(srgb(c, white) for c in pixel)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    whole = width * len(pictures) + gap * (len(pictures) - 1)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", whole, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


def reference(given, name, scene, by):
    """The picture of very many samples; made only if there is none in the folder of --keep."""
    how = ["mlt", "--chain-starts", "500000"] if by == "mlt" else [by]
    kept = given.keep and os.path.join(given.keep, f"{name}-{given.width}-{given.many}.hdr")
    if kept and os.path.exists(kept):
        return read_hdr(kept)
    return render(given.ray, scene, given.width, how + ["--seed", "99"], given.many, kept)[0]


def render(ray, scene, width, how, samples, kept=None):
    """The picture and the CPU seconds that it took."""
    with tempfile.TemporaryDirectory() as folder:
        file = kept or os.path.join(folder, "picture.hdr")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([ray, scene, "-o", file, "-q", "-t", "1", "--width", str(width), "--depth", "8",
                        "--firefly-limit", "0", "--spp", str(samples), "--integrator"] + how, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return read_hdr(file), after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def samples_for(ray, scene, width, how, seconds):
    few, more = 8, 32  # as many passes of photons in both
    short, longer = (render(ray, scene, width, how, n)[1] for n in (few, more))
    each = max(1e-4, (longer - short) / (more - few))
    return max(1, round((seconds - short) / each + few))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ray")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--width", type=int, default=128)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--many", type=int, default=2000)
    parser.add_argument("--keep")
    parser.add_argument("-o", "--output", default=".")
    given = parser.parse_args()
    print("| scene | integrator | samples | CPU s | error | s x error | of 99 % |\n|---|---|--:|--:|--:|--:|--:|")
    for named in given.scenes:
        name, scene, by = named.split("=")
        width, height, wanted = reference(given, name, scene, by)
        pictures = []
        for title, how in INTEGRATORS.items():
            samples = samples_for(given.ray, scene, given.width, how, given.seconds)
            found = []  # a list for each seed: CPU seconds, error, that of 99 %
            for seed in range(1, given.seeds + 1):
                (_, _, pixels), seconds = render(given.ray, scene, given.width, how + ["--seed", str(seed)], samples)
                found.append((seconds, *errors(pixels, wanted)))
            pictures.append(pixels)
            mean = lambda values: sum(values) / given.seeds
            print(f"| {name} | `{title}` | {samples} | {mean(f[0] for f in found):.1f} | {mean(f[1] for f in found):.3g} | "
                  f"{mean(f[0] * f[1] for f in found):.3g} | {mean(f[0] * f[2] for f in found):.3g} |", flush=True)
        bright = sorted(luminance(p) for p in wanted)
        write_row(os.path.join(given.output, f"equal-time-{name}.png"), width, height, pictures + [wanted],
                  max(1e-9, bright[int(0.97 * len(bright))]))


if __name__ == "__main__":
    main()
