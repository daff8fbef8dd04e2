#!/usr/bin/env python3
"""Writes studio.hdr beside this file: the environment map of the light rig "studio" (engine/scene/light_rig.h).

A photo studio without lamps of its own: a grey cove that is darker below, a large overhead panel, two strip panels and a reflector, all with
soft edges, so that glossy things have something to reflect. The mean radiance over the sphere is 1. Lat-long, the centre column looks along
-Z, the top row up; Radiance RGBE with run-length encoding.

Python's standard library is all it needs, and it writes the same bytes on every machine. With --check nothing is written; it fails if the
file is not what it would write.
"""
import math
import pathlib
import sys

FILE = pathlib.Path(__file__).parent / "studio.hdr"
WIDTH, HEIGHT = 512, 256


def smooth(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def panel(azimuth, elevation, center, half_size, edge):
    """1 inside a panel given in degrees, 0 outside, with a soft edge."""
    across = abs((azimuth - center[0] + 180) % 360 - 180) * math.cos(math.radians(elevation))
    along = abs(elevation - center[1])
    return (1 - smooth(half_size[0] - edge, half_size[0] + edge, across)) * (1 - smooth(half_size[1] - edge, half_size[1] + edge, along))


def radiance(azimuth, elevation):
    """Degrees: azimuth 0 is -Z, 90 is +X."""
    cove = 0.35 + 0.40 * smooth(-60, 10, elevation) + 0.25 * smooth(10, 80, elevation)
    grey = (cove, cove * 1.002, cove * 1.01)
    overhead = 5.0 * smooth(58, 68, elevation)
    left = 4.0 * panel(azimuth, elevation, (-140, 38), (12, 24), 4)
    right = 2.5 * panel(azimuth, elevation, (125, 34), (8, 26), 3)
    reflector = 1.2 * panel(azimuth, elevation, (-20, 46), (34, 8), 5)
    warm, cool = overhead + left, right + reflector
    return (grey[0] + warm * 1.02 + cool * 0.98, grey[1] + warm + cool, grey[2] + warm * 0.97 + cool * 1.03)


def image():
    rows = []
    total = weight = 0.0
    for y in range(HEIGHT):
        elevation = 90 - 180 * (y + 0.5) / HEIGHT
        row = [radiance(360 * (x + 0.5) / WIDTH - 180, elevation) for x in range(WIDTH)]
        solid_angle = math.cos(math.radians(elevation))
        total += solid_angle * sum(0.212671 * r + 0.715160 * g + 0.072169 * b for r, g, b in row)
        weight += solid_angle * WIDTH
        rows.append(row)
    scale = weight / total
    # Rounded to six digits, so that the sine of different C libraries gives the same file.
    return [[tuple(float(f"{c * scale:.5e}") for c in texel) for texel in row] for row in rows]


def rgbe(texel):
    mantissa, exponent = math.frexp(max(texel))
    factor = mantissa * 256 / max(texel)
    return tuple(int(c * factor) for c in texel) + (exponent + 128,)


def encoded(values):
    """Run-length encoding: runs of four or more equal bytes, and literal bytes."""
    out, i = bytearray(), 0
    while i < len(values):
        run = 1
        while i + run < len(values) and run < 127 and values[i + run] == values[i]:
            run += 1
        if run >= 4:
            out += bytes((128 + run, values[i]))
            i += run
            continue
        start = i
        while i < len(values) and i - start < 128 and not (i + 3 < len(values) and len(set(values[i:i + 4])) == 1):
            i += 1
        out += bytes((i - start,)) + bytes(values[start:i])
    return bytes(out)


def content():
    out = bytearray(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode())
    for row in image():
        pixels = [rgbe(texel) for texel in row]
        out += bytes((2, 2, WIDTH >> 8, WIDTH & 255))
        for channel in range(4):
            out += encoded([p[channel] for p in pixels])
    return bytes(out)


if __name__ == "__main__":
    if "--check" not in sys.argv:
        FILE.write_bytes(content())
    elif FILE.read_bytes() != content():
        sys.exit("studio.hdr is not what make_studio.py writes")
