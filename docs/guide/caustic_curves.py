#!/usr/bin/env python3
"""Plots FLIP over the seconds of rendering, a panel for each scene, from files that `blush converge --preset caustics` wrote.

docs/guide/caustic_curves.py NAME=convergence.csv... > images/caustic-curves.svg
"""
import csv
import math
import sys

# Variants of the preset: name in the file, name in the chart, colour, width of the line.
CURVES = [
    ("without", "path tracing, no caustic strategies", "#0072b2", 1.6),
    ("all (auto)", "Blush (auto)", "#d55e00", 3),
    ("progressive photon mapping", "progressive photon mapping", "#56b4e9", 1.6),
    ("bidirectional path tracing", "bidirectional path tracing", "#555555", 1.6),
    ("Metropolis light transport", "Metropolis light transport", "#8c5200", 1.6),
]
PANEL_WIDTH, PANEL_HEIGHT, LEFT, TOP, GAP = 290, 190, 52, 30, 56
LEAST_SECONDS = 0.05  # the first samples of a small image say little


def curves_of(path):
    """Points (seconds, FLIP) by variant, of the first repeat."""
    points = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["repeat"] == "0" and float(row["seconds"]) >= LEAST_SECONDS:
                points.setdefault(row["variant"], []).append((float(row["seconds"]), float(row["flip"])))
    return points


def ticks(low, high):
    """1, 2 and 5 times powers of ten within the range."""
    decades = range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1)
    return [m * 10.0**d for d in decades for m in (1, 2, 5) if low <= m * 10.0**d <= high]


def panel(name, points, x0, y0):
    shown = [p for variant, *_ in CURVES for p in points.get(variant, [])]
    x_range = LEAST_SECONDS, max(x for x, _ in shown) * 1.1
    y_range = min(y for _, y in shown) / 1.15, max(y for _, y in shown) * 1.15

    def along(value, limits, size):
        return size * math.log(value / limits[0]) / math.log(limits[1] / limits[0])

    def x_at(value):
        return x0 + along(value, x_range, PANEL_WIDTH)

    def y_at(value):
        return y0 + PANEL_HEIGHT - along(value, y_range, PANEL_HEIGHT)

    yield f"<text x='{x0}' y='{y0 - 9}' class='title'>{name}</text>"
    for value in ticks(*x_range):
        yield f"<line x1='{x_at(value):.1f}' y1='{y0}' x2='{x_at(value):.1f}' y2='{y0 + PANEL_HEIGHT}'/>"
        yield f"<text x='{x_at(value):.1f}' y='{y0 + PANEL_HEIGHT + 15}' text-anchor='middle'>{value:g}</text>"
    for value in ticks(*y_range):
        yield f"<line x1='{x0}' y1='{y_at(value):.1f}' x2='{x0 + PANEL_WIDTH}' y2='{y_at(value):.1f}'/>"
        yield f"<text x='{x0 - 6}' y='{y_at(value) + 4:.1f}' text-anchor='end'>{value:g}</text>"
    for variant, _, colour, width in CURVES:
        line = " ".join(f"{x_at(x):.1f},{y_at(y):.1f}" for x, y in points.get(variant, []))
        yield f"<polyline points='{line}' stroke='{colour}' stroke-width='{width}'/>"


def chart(files):
    columns = 2
    rows = (len(files) + columns - 1) // columns
    width = columns * (LEFT + PANEL_WIDTH) + 20
    legend = rows * (PANEL_HEIGHT + GAP) + TOP + 4
    height = legend + 20 * len(CURVES) + 6
    yield (f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {width} {height}' width='{width}' height='{height}' "
           "font-family='system-ui, sans-serif' font-size='12' fill='#333'>")
    yield ("<style>line{stroke:#dddddd}polyline{fill:none;stroke-linejoin:round}.title{font-size:14px;font-weight:600}</style>")
    yield f"<rect width='{width}' height='{height}' fill='#ffffff'/>"
    for k, (name, path) in enumerate(files):
        x0, y0 = LEFT + k % columns * (PANEL_WIDTH + LEFT), TOP + k // columns * (PANEL_HEIGHT + GAP)
        yield from panel(name, curves_of(path), x0, y0)
    yield f"<text x='{width - 20}' y='{legend + 8}' text-anchor='end'>FLIP over seconds of rendering</text>"
    for k, (_, name, colour, line_width) in enumerate(CURVES):
        y = legend + 20 * k + 4
        yield f"<polyline points='{LEFT},{y} {LEFT + 26},{y}' stroke='{colour}' stroke-width='{line_width}'/>"
        yield f"<text x='{LEFT + 34}' y='{y + 4}'>{name}</text>"
    yield "</svg>"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print("\n".join(chart([argument.split("=", 1) for argument in sys.argv[1:]])))


main()
