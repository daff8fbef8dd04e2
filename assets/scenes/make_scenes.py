#!/usr/bin/env python3
"""Writes the demo scenes beside this file: NAME.gltf and NAME.bin for each. README.md describes what to see in them.

Python's standard library is all it needs, and it writes the same bytes on every machine. Metres; +Y is up.
With --check nothing is written; it fails if a file is not what it would write.
"""
import math
import pathlib
import sys

import caustic_scenes
from placement import about_y, direction
from scene_writer import SceneWriter
from shapes import Mesh, add, box, cross, dot, faceted, grid, lathe, mul, prism, quad, rounded, sphere, sub, tube, unit

FOLDER = pathlib.Path(__file__).parent


# --- card-and-mug -----------------------------------------------------------------------------------------------

def mug_body():
    """A mug of 9.5 cm: foot ring, tapered wall of 3.5 mm, rolled rim, rounded bottom inside."""
    profile = rounded([
        (0, 0.0015, 0), (0.0270, 0.0015, 0.0008), (0.0285, 0, 0.0006), (0.0325, 0, 0.0012), (0.0388, 0.0070, 0.0080),
        (0.0412, 0.0950, 0.0017), (0.0376, 0.0950, 0.0017), (0.0352, 0.0055, 0.0120), (0, 0.0055, 0),
    ], arc_steps=6)
    return lathe(profile, columns=96)


def mug_handle():
    """Half an ellipse whose ends are inside the wall; the wall tilts outwards by 1.2 mm between them."""
    def path(t):
        phi = math.pi * (0.5 - t)
        x = 0.0378 + 0.0012 * (1 - t) + 0.031 * math.cos(phi)
        dx, dy = 0.031 * math.pi * math.sin(phi) - 0.0012, -0.0245 * math.pi * math.cos(phi)
        return (x, 0.0505 + 0.0245 * math.sin(phi)), unit((dx, dy))

    return tube(path, half_width=0.0058, half_height=0.0036, rows=40, columns=20)


def card():
    """An upright card of 12 x 17 cm and 0.6 mm, curved by 4 mm over its width. Its concave side faces +Z."""
    width, height, thickness, radius = 0.12, 0.17, 0.0006, 0.5
    columns = 32

    def side(offset, sign):
        def at(row, column):
            angle = sign * (column / columns - 0.5) * width / radius
            n = (-sign * math.sin(angle) * sign, 0.0, math.cos(angle))
            p = ((radius - offset) * math.sin(angle), height * row, radius - (radius - offset) * math.cos(angle))
            return p, mul(n, sign)
        return grid(1, columns, at)

    front, back = side(thickness, 1), side(0, -1)
    mesh = Mesh().add(front).add(back)
    # The four edges: strips between the borders of the two sides, whose orders are reversed.
    row = columns + 1
    for i in range(columns):
        f0, f1 = front.points[i], front.points[i + 1]
        b0, b1 = back.points[columns - i], back.points[columns - i - 1]
        mesh.add(quad(b0, b1, f1, f0))
        f0, f1 = front.points[row + i], front.points[row + i + 1]
        b0, b1 = back.points[row + columns - i], back.points[row + columns - i - 1]
        mesh.add(quad(f0, f1, b1, b0))
    mesh.add(quad(back.points[columns], front.points[0], front.points[row], back.points[row + columns]))
    return mesh.add(quad(front.points[columns], back.points[0], back.points[row], front.points[row + columns]))


def card_and_mug():
    scene = SceneWriter(
        "card-and-mug", "A matte white card beside a red mug under a low sun: the card blushes.",
        environment={"kind": "constant", "color": [0.74, 0.85, 1], "intensity": 0.6})
    table = scene.material("grey table", (0.17, 0.17, 0.175), roughness=0.6)
    glaze = scene.material("red glaze", (0.62, 0.018, 0.016), roughness=0.35)
    paper = scene.material("white card", (0.82, 0.81, 0.79), lambertian=True)

    scene.object("table", box((-2.4, -0.04, -2.4), (2.4, 0, 2.4)), table)
    mug = scene.node("mug", translation=(0.046, 0, 0.026), rotation=about_y(14))
    scene.object("mug body", mug_body(), glaze, parent=mug)
    scene.object("mug handle", mug_handle(), glaze, parent=mug)
    scene.object("card", card(), paper, translation=(-0.036, 0, -0.006), rotation=about_y(180 + 19))

    toward_sun = direction(azimuth=-66, elevation=27)
    scene.sun("sun", toward_sun, (1, 0.84, 0.64), lux=9, angle_degrees=0.53, translation=mul(toward_sun, 0.18))
    scene.camera("hero", (0.03, 0.28, 0.60), (0.010, 0.072, 0), yfov_degrees=25.5)
    scene.camera("blush close-up", (-0.02, 0.12, 0.30), (0.005, 0.06, -0.01), yfov_degrees=24)
    scene.camera("from above", (0.02, 0.62, 0.24), (0.01, 0.03, 0), yfov_degrees=24)
    return scene


# --- cornell ----------------------------------------------------------------------------------------------------

def millimetres(*points):
    return [tuple(x / 1000 for x in p) for p in points]


def cornell():
    """Positions as measured and published by the Cornell Program of Computer Graphics (millimetres)."""
    scene = SceneWriter("cornell", "The Cornell box from its published measurements, with RGB reflectances.")
    white = scene.material("white", (0.725, 0.71, 0.68), lambertian=True)
    red = scene.material("red", (0.63, 0.065, 0.05), lambertian=True)
    green = scene.material("green", (0.14, 0.45, 0.091), lambertian=True)
    light = scene.material("light", (0.78, 0.78, 0.78), lambertian=True, emission=(17, 12, 4))

    scene.object("floor", quad(*millimetres((552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))), white, "sheet")
    scene.object("back wall", quad(*millimetres((549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2))), white, "sheet")
    scene.object("green wall", quad(*millimetres((0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2))), green, "sheet")
    # In the measured data, its four corners are not exactly coplanar.
    red_wall = quad(*millimetres((552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0)))
    scene.object("red wall", faceted(red_wall), red, "sheet")

    # The light is in the plane of the ceiling, so the ceiling has a hole there.
    x0, x1, z0, z1 = 213, 343, 227, 332
    ceiling = Mesh()
    for left, right, near, far in ((0, 556, 0, z0), (0, 556, z1, 559.2), (0, x0, z0, z1), (x1, 556, z0, z1)):
        ceiling.add(quad(*millimetres((left, 548.8, near), (right, 548.8, near), (right, 548.8, far), (left, 548.8, far))))
    scene.object("ceiling", ceiling, white, "sheet")
    scene.object("light", quad(*millimetres((x1, 548.8, z0), (x1, 548.8, z1), (x0, 548.8, z1), (x0, 548.8, z0))), light, "sheet")

    short = [(x / 1000, z / 1000) for x, z in ((130, 65), (82, 225), (240, 272), (290, 114))]
    tall = [(x / 1000, z / 1000) for x, z in ((423, 247), (265, 296), (314, 456), (472, 406))]
    scene.object("short block", prism(short, 0.165), white, "standing")
    scene.object("tall block", prism(tall, 0.330), white, "standing")

    # 35 mm focal length behind a film of 25 x 25 mm.
    scene.camera("published camera", (0.278, 0.273, -0.800), (0.278, 0.273, 0), math.degrees(2 * math.atan(12.5 / 35)), aspect=1)
    return scene


# --- furnace ----------------------------------------------------------------------------------------------------

def furnace():
    scene = SceneWriter("furnace", "A white sphere in a uniform white world: nothing is to be seen.",
                        environment={"kind": "constant", "color": [1, 1, 1], "intensity": 1})
    white = scene.material("perfect white", (1, 1, 1), lambertian=True)
    # Flat facets: interpolated normals would tilt hemispheres below the surface and lose light.
    scene.object("sphere", faceted(sphere((0, 0, 0), 0.5, 32, 64)), white)
    scene.camera("camera", (0, 0.6, 2.2), (0, 0, 0), yfov_degrees=35)
    return scene


# --- veach-mis --------------------------------------------------------------------------------------------------

def area(mesh):
    total = 0.0
    for t in mesh.triangles:
        a, b, c = (mesh.points[i] for i in t)
        n = cross(sub(b, a), sub(c, a))
        total += math.sqrt(dot(n, n)) / 2
    return total


def veach_mis():
    """After figure 9.2 of E. Veach, Robust Monte Carlo Methods for Light Transport Simulation (1997)."""
    scene = SceneWriter("veach-mis", "Four plates of growing roughness mirror four lights of growing size and equal power.")
    eye = (0, 0.20, 1.50)

    grey = scene.material("matte grey", (0.5, 0.5, 0.5), lambertian=True)
    scene.object("floor", quad((-2, -0.42, 2), (2, -0.42, 2), (2, -0.42, -0.35), (-2, -0.42, -0.35)), grey, "sheet")
    scene.object("back wall", quad((-2, -0.42, -0.35), (2, -0.42, -0.35), (2, 1.6, -0.35), (-2, 1.6, -0.35)), grey, "sheet")

    power = 0.4  # of each light; radiance follows from the area of its triangles
    for i, radius in enumerate((0.0033, 0.01, 0.03, 0.09)):
        ball = sphere((0, 0, 0), radius, 12, 24)
        radiance = power / (math.pi * area(ball))
        material = scene.material(f"light {i + 1}", (0, 0, 0), lambertian=True, emission=(radiance,) * 3)
        scene.object(f"light {i + 1}", ball, material, translation=(-0.375 + 0.25 * i, 0, 0))

    # Each plate is tilted so that its centre reflects the row of lights to the camera.
    for i, (center, roughness) in enumerate((
            ((0, -0.240, -0.020), 0.06), ((0, -0.305, 0.090), 0.14), ((0, -0.357, 0.220), 0.22), ((0, -0.390, 0.360), 0.34))):
        metal = scene.material(f"plate {i + 1}", (0.62, 0.62, 0.62), roughness=roughness, metallic=1)
        normal = unit(add(unit(sub(eye, center)), unit(sub((0, 0, 0), center))))
        across, along = (0.42, 0, 0), mul(cross((1, 0, 0), normal), 0.052)
        top = [add(center, add(mul(across, u), mul(along, v))) for u, v in ((-1, 1), (1, 1), (1, -1), (-1, -1))]
        assert dot(quad(*top).normals[0], normal) > 0.999
        bottom = [add(p, mul(normal, -0.006)) for p in top]
        plate = quad(*top).add(quad(*reversed(bottom)))
        for k in range(4):
            plate.add(quad(bottom[k], bottom[(k + 1) % 4], top[(k + 1) % 4], top[k]))
        scene.object(f"plate {i + 1}", plate, metal)

    scene.camera("camera", eye, (0, -0.185, 0.1), yfov_degrees=28)
    return scene


# --- corridor ---------------------------------------------------------------------------------------------------

def corridor():
    """Three legs of 1.6 m width and 2.4 m height joined by two corners; the camera is in the first, the lamp in the last."""
    scene = SceneWriter("corridor", "All light comes around two corners.")
    white = scene.material("white paint", (0.78, 0.78, 0.77), lambertian=True)
    ochre = scene.material("ochre paint", (0.78, 0.55, 0.30), lambertian=True)
    wood = scene.material("wooden floor", (0.50, 0.40, 0.30), roughness=0.6)
    ceramic = scene.material("white ceramic", (0.8, 0.8, 0.8), roughness=0.25)
    lamp = scene.material("lamp", (0.8, 0.8, 0.8), lambertian=True, emission=(135, 146, 160))
    height = 2.4

    # Clockwise from above, so that the walls face inwards: (x, z) of each corner and the colour of the wall after it.
    plan = [((0, 0), white), ((2.8, 0), white), ((2.8, -3), white), ((4.4, -3), ochre),
            ((4.4, 1.6), white), ((1.6, 1.6), white), ((1.6, 4.4), white), ((0, 4.4), white)]
    painted = {white: Mesh(), ochre: Mesh()}
    for i, ((ax, az), paint) in enumerate(plan):
        (bx, bz), _ = plan[(i + 1) % len(plan)]
        painted[paint].add(quad((ax, 0, az), (bx, 0, bz), (bx, height, bz), (ax, height, az)))
    scene.object("walls", painted[white], white, "sheet")
    scene.object("ochre wall", painted[ochre], ochre, "sheet")

    floor, ceiling = Mesh(), Mesh()
    for x0, x1, z0, z1 in ((0, 1.6, 0, 4.4), (1.6, 4.4, 0, 1.6), (2.8, 4.4, -3, 0)):
        floor.add(quad((x0, 0, z1), (x1, 0, z1), (x1, 0, z0), (x0, 0, z0)))
        ceiling.add(quad((x0, height, z0), (x1, height, z0), (x1, height, z1), (x0, height, z1)))
    scene.object("floor", floor, wood, "sheet")
    scene.object("ceiling", ceiling, white, "sheet")
    scene.object("lamp", box((3.1, height - 0.06, -2.6), (4.1, height - 0.01, -1.6)), lamp)

    scene.object("pedestal", box((0.30, 0, 0.50), (0.70, 0.75, 0.90)), white)
    scene.object("ceramic ball", sphere((0, 0, 0), 0.17, 48, 96), ceramic, translation=(0.50, 0.9201, 0.70))
    scene.object("bench", box((0.02, 0.40, 1.7), (0.40, 0.45, 3.0)), wood)
    for z in (1.8, 2.8):
        scene.object(f"bench leg at {z} m", box((0.06, 0, z), (0.36, 0.40, z + 0.1)), wood)

    scene.camera("camera", (0.80, 1.45, 4.2), (0.82, 1.12, 0), yfov_degrees=46)
    return scene


# --- two-bounces ------------------------------------------------------------------------------------------------

def two_bounces():
    """A red wall of reflectance 0.7, a white floor of 0.9 and a lamp of 12 nits that reflects nothing: 0.7 x 0.9 x 12 = 7.56."""
    scene = SceneWriter("two-bounces", "A red wall, a white floor and a lamp: a path over both surfaces is worth 0.7 x 0.9 x 12 = 7.56.")
    red = scene.material("red", (0.7, 0.07, 0.06), lambertian=True)
    white = scene.material("white", (0.9, 0.9, 0.9), lambertian=True)
    light = scene.material("light", (0, 0, 0), lambertian=True, emission=(12, 12, 12))
    scene.object("red wall", quad((-1.6, 0, 0), (1.6, 0, 0), (1.6, 2.4, 0), (-1.6, 2.4, 0)), red, "sheet")
    scene.object("white floor", quad((-1.6, 0, 2.8), (1.6, 0, 2.8), (1.6, 0, 0), (-1.6, 0, 0)), white, "sheet")
    x, y, z0, z1 = 0.9, 2.2, 0.4, 2.0
    scene.object("lamp", quad((x, y, z0), (x, y, z1), (-x, y, z1), (-x, y, z0)), light, "sheet")
    scene.camera("camera", (1.1, 1.5, 5.4), (0, 1.1, 0.6), yfov_degrees=34)
    return scene


if __name__ == "__main__":
    for make in (card_and_mug, cornell, furnace, veach_mis, corridor, two_bounces, *caustic_scenes.SCENES):
        for name, content in make().files().items():
            if "--check" not in sys.argv:
                (FOLDER / name).write_bytes(content)
            elif (FOLDER / name).read_bytes() != content:
                sys.exit(f"{name} is not what make_scenes.py writes")
