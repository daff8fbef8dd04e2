#!/usr/bin/env python3
"""Writes false_color.spi1d: the colour of each stop of luminance about middle grey.

The axis of the table is stops from middle grey (log2 of luminance / 0.18). The band of a whole number of stops reaches
half a stop to either side of it, so that middle grey lies in the midst of its own band. Colours are sRGB-encoded.
The steps between bands are one table cell wide (1/64 stop): OpenColorIO interpolates linearly between entries.
With --check nothing is written; it fails if the file is not what it would write.
"""
import pathlib
import sys

CELLS_PER_STOP = 64
LOWEST, HIGHEST = -8, 8  # stops; beyond these the end colours hold

BELOW = (0, 0, 0)
BANDS = {
    -6: (52, 10, 84),
    -5: (98, 32, 160),
    -4: (52, 52, 214),
    -3: (24, 116, 232),
    -2: (24, 182, 214),
    -1: (20, 136, 96),
    0: (128, 128, 128),
    1: (116, 204, 64),
    2: (244, 230, 40),
    3: (248, 178, 24),
    4: (242, 112, 20),
    5: (220, 32, 28),
    6: (255, 128, 190),
}
ABOVE = (255, 255, 255)


def color(stops):
    band = int(stops + 100.5) - 100
    if band < min(BANDS):
        return BELOW
    return BANDS.get(band, ABOVE)


def main():
    count = (HIGHEST - LOWEST) * CELLS_PER_STOP + 1
    lines = ["Version 1", f"From {LOWEST} {HIGHEST}", f"Length {count}", "Components 3", "{"]
    for i in range(count):
        lines.append(" ".join(f"{c / 255:.6f}" for c in color(LOWEST + i / CELLS_PER_STOP)))
    lines.append("}")
    file = pathlib.Path(__file__).with_name("false_color.spi1d")
    text = "\n".join(lines) + "\n"
    if "--check" not in sys.argv:
        file.write_text(text)
    elif file.read_text() != text:
        sys.exit(f"{file.name} is not what make_false_color.py writes")


if __name__ == "__main__":
    main()
