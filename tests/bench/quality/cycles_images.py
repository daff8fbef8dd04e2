# Writes the images that Cycles has at given times of progressive sampling, for `blush_bench quality --peer FILE`.
#   blender -b -noaudio --python tests/bench/quality/cycles_images.py -- PEERS SCENE FOLDER [LONGEST_SECONDS] [REFERENCE_SPP]
# PEERS: folder of scenes_for_cycles.py. SCENE: cornell, cornell_spheres, dense_cornell. FOLDER gets SCENE.json and images.
# In favour of Cycles, only seconds of sampling count (time of many samples less that of one), and each time has the finest
# resolution at which a sample is complete by then.
import json
import os
import sys
import time

import bpy

arguments = sys.argv[sys.argv.index("--") + 1 :]
peers, scene_name, folder = arguments[:3]
longest = float(arguments[3]) if len(arguments) > 3 else 10
reference_spp = int(arguments[4]) if len(arguments) > 4 else 512
sys.path.insert(0, peers)
import scenes_for_cycles  # noqa: E402

WIDTH, HEIGHT, BOUNCES, THREADS = 1280, 720, 64, 2
DEADLINES = [s for s in (0.033, 0.1, 0.3, 1, 3, 10) if s <= longest]
os.makedirs(folder, exist_ok=True)
scene = scenes_for_cycles.build(scene_name, WIDTH, HEIGHT)


def render(spp, divider, seed, file):
    scenes_for_cycles.settings(scene, spp, BOUNCES, seed, THREADS)
    scene.render.resolution_x, scene.render.resolution_y = WIDTH // divider, HEIGHT // divider
    scene.render.filepath = os.path.join(folder, file)
    begin = time.time()
    bpy.ops.render.render(write_still=True)
    return time.time() - begin


def seconds_per_sample(divider):
    count = 8 * divider * divider
    runs = [(render(1, divider, 1, "timing.exr"), render(1 + count, divider, 1, "timing.exr")) for _ in range(3)]
    return sorted((many - one) / count for one, many in runs)[1]


cost = {}
images = []
for seconds in DEADLINES:
    for divider in (1, 2, 4, 8, 16):
        if divider not in cost:
            cost[divider] = seconds_per_sample(divider)
        if cost[divider] <= seconds or divider == 16:
            break
    samples = max(1, int(seconds / cost[divider]))
    file = f"{scene_name}_{int(1000 * seconds)}ms.exr"
    render(samples, divider, 1, file)
    images.append({"ms": 1000 * seconds, "divider": divider, "samples": samples, "file": file})
reference = f"{scene_name}_reference.exr"
render(reference_spp, 1, 2, reference)
with open(os.path.join(folder, scene_name + ".json"), "w") as out:
    json.dump(
        {
            "scene": scene_name + ".glb",
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
