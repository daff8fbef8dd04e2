#!/usr/bin/python3
"""Efficiency of Blush against Cycles on the scenes of peer_scenes.py, in turn, as JSON.

efficiency.py [SCENE...] [--spp 64] [--seeds 3] [--size 512x512] [--blush FILE] [--panoramas FOLDER] [--options "..."]

Needs Debian's blender, python3-numpy and python3-openimageio. Box filter, two threads; Blush with its default settings,
Cycles without clamping, adaptive sampling and denoiser. The error of an image needs no reference: for independent seeds,
E[(a - b)^2] / 2 is the MSE of either. Efficiency is 1 / (error x seconds); seconds are those of rendering.
`means` must agree within the noise, else the programs render different scenes.
"""
import argparse
import itertools
import json
import os
import re
import subprocess
import sys
import tempfile

import numpy as np
import OpenImageIO as oiio

import peer_scenes
from write_glb import write_glb

HERE = os.path.dirname(os.path.abspath(__file__))
parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("scenes", nargs="*", default=list(peer_scenes.SCENES))
parser.add_argument("--spp", type=int, default=64)
parser.add_argument("--seeds", type=int, default=3)
parser.add_argument("--size", default="512x512")
parser.add_argument("--blush", default="build/release/blush")
parser.add_argument("--panoramas", default=os.path.join(HERE, "../../../../shared/hdri"))
parser.add_argument("--options", default="", help="more options of `blush render`")
parser.add_argument("--keep", help="folder that keeps the images")
options = parser.parse_args()


def pixels(file):
    return oiio.ImageBuf(file).get_pixels(oiio.FLOAT)[..., :3].astype(np.float64)


def run(command):
    p = subprocess.run(command, capture_output=True, text=True)
    if p.returncode:
        sys.exit(f"{command[0]} failed:\n{p.stdout[-2000:]}{p.stderr[-2000:]}")
    return p.stdout


def cycles(name, scene, seed, folder):
    file = os.path.join(folder, f"{name}-cycles-{seed}.exr")
    output = run(["blender", "-b", "-noaudio", "--python", os.path.join(HERE, "cycles_scene.py"), "--", name, str(options.spp), str(seed), file,
                  options.size, options.panoramas])
    seconds = re.search(r"RENDER_SECONDS (\S+) (\S+)", output)
    if not seconds:
        sys.exit("Cycles did not render:\n" + output[-2000:])
    return pixels(file), float(seconds[1]), float(seconds[2])


def blush(name, scene, seed, folder):
    glb, file = os.path.join(folder, name + ".glb"), os.path.join(folder, f"{name}-blush-{seed}.exr")
    write_glb(scene, glb)
    environment = os.path.join(options.panoramas, scene.environment + ".exr") if scene.environment else "constant=" + ",".join(map(str, scene.sky or (0, 0, 0)))
    begin = os.times()
    output = run([options.blush, "render", glb, "-o", file, "--env", environment, "--size", options.size, "--spp", str(options.spp), "--seed", str(seed),
                  "--filter", "box", "--threads", "2", "--json", "-", *options.options.split()])
    end = os.times()
    cores = end.children_user + end.children_system - begin.children_user - begin.children_system
    return pixels(file), float(json.loads(output)["seconds"]), cores


def compare(name, folder):
    scene = peer_scenes.SCENES[name]()
    programs = {"cycles": cycles, "blush": blush}
    runs = {program: [] for program in programs}
    for seed in range(1, options.seeds + 1):
        for program, render in programs.items():
            runs[program].append(render(name, scene, seed, folder))
    mean = np.mean([image for r in runs.values() for image, _, _ in r], 0)
    row = {"scene": name}
    for program, r in runs.items():
        squares = [(a - b) ** 2 / 2 for a, b in itertools.combinations([image for image, _, _ in r], 2)]
        row[program] = {
            "seconds": float(np.median([s for _, s, _ in r])),
            "core_seconds": float(np.median([c for _, _, c in r])),
            "mse": float(np.mean(squares)),
            "relmse": float(np.mean([s / (mean**2 + 0.01) for s in squares])),
            "means": np.mean([image for image, _, _ in r], (0, 1, 2)).round(5).tolist(),
        }
    for seconds in ("seconds", "core_seconds"):
        cost = {error: [row[program][error] * row[program][seconds] for program in programs] for error in ("mse", "relmse")}
        row["efficiency_by_" + seconds] = {error: cycles / blush for error, (cycles, blush) in cost.items()}
    return row


with tempfile.TemporaryDirectory() as temporary:
    folder = options.keep or temporary
    os.makedirs(folder, exist_ok=True)
    for scene_name in options.scenes:
        print(json.dumps(compare(scene_name, folder)), flush=True)
