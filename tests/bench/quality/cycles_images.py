"""Writes the images that Cycles has at given times of progressive sampling, for `blush_bench quality --peer FILE`.

blender -b -noaudio --python tests/bench/quality/cycles_images.py -- SCENE.gltf FOLDER [--longest SECONDS] [--reference-spp N]
FOLDER gets NAME.json and images. An earlier reference of as many samples in FOLDER is kept. Where Cycles does not converge, as on
caustics, --reference names the converged image of another renderer, with a box filter.
In favour of Cycles, only seconds of sampling count (time of many samples less that of one), and each time has the finest
resolution at which a sample is complete by then.
"""
import argparse
import json
import os
import statistics
import sys
import time

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "peers"))
import cycles_gltf  # noqa: E402
import cycles_scene  # noqa: E402

WIDTH, HEIGHT = 1280, 720

parser = argparse.ArgumentParser(prog="cycles_images.py")
parser.add_argument("scene")
parser.add_argument("folder")
parser.add_argument("--longest", type=float, default=10, help="seconds; 0: the reference alone")
parser.add_argument("--reference-spp", type=int, default=512)
parser.add_argument("--reference", help="EXR of the converged image, instead of one of Cycles")
parser.add_argument("--timings", type=int, default=3, help="of each resolution; the median counts")
options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])

os.makedirs(options.folder, exist_ok=True)
name = os.path.basename(options.scene)
scene = cycles_gltf.build(options.scene)


def render(spp, divider, seed, file):
    cycles_scene.settings(scene, spp, seed, WIDTH // divider, HEIGHT // divider)
    scene.render.filepath = os.path.join(options.folder, file)
    begin = time.time()
    bpy.ops.render.render(write_still=True)
    return time.time() - begin


def seconds_per_sample(divider):
    count = 8 * divider * divider
    timed = [(render(1, divider, 1, "timing.exr"), render(1 + count, divider, 1, "timing.exr")) for _ in range(options.timings)]
    return statistics.median((many - one) / count for one, many in timed)


reference = os.path.abspath(options.reference) if options.reference else f"{name}_reference_{options.reference_spp}.exr"
if not os.path.exists(os.path.join(options.folder, reference)):
    if options.reference:
        raise SystemExit(f"{options.reference}: not found")
    render(options.reference_spp, 1, 2, reference)
cost = {}
images = []
for seconds in [s for s in (0.033, 0.1, 0.3, 1, 3, 10) if s <= options.longest]:
    for divider in (1, 2, 4, 8, 16):
        if divider not in cost:
            cost[divider] = seconds_per_sample(divider)
        if cost[divider] <= seconds or divider == 16:
            break
    samples = max(1, int(seconds / cost[divider]))
    file = f"{name}_{int(1000 * seconds)}ms.exr"
    render(samples, divider, 1, file)
    images.append({"ms": 1000 * seconds, "divider": divider, "samples": samples, "file": file})
if images:
    with open(os.path.join(options.folder, name + ".json"), "w") as out:
        json.dump(
            {
                "scene": name,
                "renderer": "Cycles " + bpy.app.version_string,
                "width": WIDTH,
                "height": HEIGHT,
                "reference": reference,
                "seconds_per_sample": cost,
                "images": images,
            },
            out,
            indent=1,
        )
