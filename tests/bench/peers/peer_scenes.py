"""Scenes for comparisons with other renderers, as plain data: each program builds the same triangles, materials and lights.

Lengths in metres, +Y up. Radiance in nits, irradiance in lux, intensity in candela, as in glTF. A comparison is about noise
in equal time, so materials are those that both programs define alike: Lambertian, smooth glass, GGX metal.
"""
import dataclasses
import math

import numpy as np


@dataclasses.dataclass
class Material:
    color: tuple = (0.8, 0.8, 0.8)  # linear Rec.709 reflectance
    kind: str = "lambert"  # lambert, glass (smooth, IOR 1.5), metal (GGX), emitter
    roughness: float = 1.0  # glTF's: alpha is its square
    alpha: float = 1.0  # below 1: glTF's BLEND
    emission: tuple = (0.0, 0.0, 0.0)  # nits


@dataclasses.dataclass
class Object:
    points: np.ndarray  # n x 3
    triangles: np.ndarray  # m x 3, counter-clockwise from outside
    material: Material
    smooth: bool = False  # shade with the normals of the vertices


@dataclasses.dataclass
class Scene:
    objects: list
    eye: tuple
    target: tuple
    yfov_degrees: float
    sky: tuple = None  # constant radiance, nits
    environment: str = None  # name of a shipped panorama
    sun: tuple = None  # direction to the sun, lux, diameter in degrees
    point_light: tuple = None  # position, candela


def quad(corners, material):
    return Object(np.array(corners, float), np.array([(0, 1, 2), (0, 2, 3)]), material)


def floor(half, material=None, height=0.0):
    corners = [(-half, height, half), (half, height, half), (half, height, -half), (-half, height, -half)]
    return quad(corners, material or Material((0.5, 0.5, 0.5)))


def box(low, high, material):
    (x0, y0, z0), (x1, y1, z1) = low, high
    points = np.array([(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)], float)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return Object(points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]), material)


def sphere(center, radius, material, columns=96, rows=48):
    theta = np.pi * np.arange(1, rows) / rows
    phi = 2 * np.pi * np.arange(columns) / columns
    ring = np.stack(np.broadcast_arrays(np.sin(theta)[:, None] * np.cos(phi), np.cos(theta)[:, None], np.sin(theta)[:, None] * np.sin(phi)), -1)
    points = np.concatenate([[(0, 1, 0)], ring.reshape(-1, 3), [(0, -1, 0)]])
    last = len(points) - 1
    triangles = []
    for i in range(columns):
        j = (i + 1) % columns
        triangles.append((0, 1 + j, 1 + i))
        for k in range(rows - 2):
            a = 1 + k * columns
            triangles += [(a + i, a + j, a + columns + j), (a + i, a + columns + j, a + columns + i)]
        a = 1 + (rows - 2) * columns
        triangles.append((a + i, a + j, last))
    return Object(np.asarray(center, float) + radius * points, np.array(triangles), material, smooth=True)


def leaves(count, material, seed=1):
    """Quads of 20 to 50 cm, turned at random, 0.4 to 2 m over the floor."""
    random = np.random.default_rng(seed)
    points, triangles = [], []
    for i in range(count):
        center = random.uniform((-1.4, 0.4, -1.4), (1.4, 2.0, 1.4))
        u, v = np.linalg.qr(random.normal(size=(3, 2)))[0].T * random.uniform(0.1, 0.25, (2, 1))
        points += [center - u - v, center + u - v, center + u + v, center - u + v]
        triangles += [(4 * i, 4 * i + 1, 4 * i + 2), (4 * i, 4 * i + 2, 4 * i + 3)]
    return Object(np.array(points), np.array(triangles), material)


def things():
    return [
        sphere((-0.75, 0.5, 0.1), 0.5, Material((0.7, 0.25, 0.15))),
        box((0.25, 0.0, -0.5), (1.05, 0.9, 0.3), Material((0.25, 0.45, 0.6))),
        sphere((0.15, 0.25, 0.9), 0.25, Material((0.75, 0.72, 0.65))),
    ]


def room_with_window():
    """4 x 3 x 5 m with a window of 1.2 x 1 m in the wall at x = 2."""
    white, red = Material((0.75, 0.73, 0.7)), Material((0.55, 0.12, 0.1))
    wall = 0.2
    shell = [
        box((-2, -wall, -2.5), (2, 0, 2.5), Material((0.45, 0.4, 0.35))),
        box((-2, 3, -2.5), (2, 3 + wall, 2.5), white),
        box((-2 - wall, -wall, -2.5), (-2, 3 + wall, 2.5), red),
        box((-2 - wall, -wall, -2.5 - wall), (2 + wall, 3 + wall, -2.5), white),
        box((-2 - wall, -wall, 2.5), (2 + wall, 3 + wall, 2.5 + wall), white),
        box((2, -wall, -2.5), (2 + wall, 1, 2.5), white),
        box((2, 2, -2.5), (2 + wall, 3 + wall, 2.5), white),
        box((2, 1, -2.5), (2 + wall, 2, -0.6), white),
        box((2, 1, 0.6), (2 + wall, 2, 2.5), white),
    ]
    return shell + [box((-0.6, 0, -1.6), (0.6, 0.75, -0.8), white), sphere((0.0, 1.05, -1.2), 0.3, Material((0.7, 0.7, 0.72)))]


VIEW = {"eye": (0.0, 1.9, 5.2), "target": (0.0, 0.6, 0.0), "yfov_degrees": 32.0}
GLASS = Material((1, 1, 1), "glass", 0.0)


def veach_spheres():
    lamps = [sphere((x, 1.7, -0.6), r, Material(kind="emitter", emission=(e, e, e)), 64, 32) for x, r, e in
             ((-1.6, 0.03, 600.0), (-0.8, 0.08, 85.0), (0.0, 0.15, 24.0), (0.8, 0.25, 8.7), (1.6, 0.35, 4.4))]
    plates = []
    for i, roughness in enumerate((0.08, 0.16, 0.28, 0.45)):
        y, z = 0.05 + 0.22 * i * i / 3, 1.2 - 0.55 * i
        tilt = math.radians(8 + 14 * i)
        d = (0.0, 0.24 * math.sin(tilt), -0.24 * math.cos(tilt))
        corners = [(-2.2, y - d[1], z - d[2]), (2.2, y - d[1], z - d[2]), (2.2, y + d[1], z + d[2]), (-2.2, y + d[1], z + d[2])]
        plates.append(quad(corners, Material((0.7, 0.7, 0.7), "metal", roughness)))
    return Scene(lamps + plates + [floor(6)], **VIEW)


SCENES = {
    "sky": lambda: Scene([floor(8)] + things(), **VIEW, sky=(1, 1, 1)),
    "sky_and_lamp": lambda: Scene([floor(8)] + things(), **VIEW, sky=(1, 1, 1), point_light=((1.5, 3.0, 2.0), 20.0)),
    "alpha_sky": lambda: Scene([floor(8), leaves(60, Material((0.3, 0.6, 0.2), alpha=0.5))], **VIEW, sky=(1, 1, 1)),
    "alpha_sun": lambda: Scene([floor(8), leaves(60, Material((0.3, 0.6, 0.2), alpha=0.5))], **VIEW, sky=(1, 1, 1), sun=((0.4, 0.8, 0.45), 8.0, 0.53)),
    "glass_sky": lambda: Scene([floor(8), sphere((-0.6, 0.55, 0), 0.55, GLASS), box((0.2, 0.02, -0.5), (1.1, 0.92, 0.4), GLASS)], **VIEW, sky=(1, 1, 1)),
    "lobby": lambda: Scene([floor(8), sphere((0, 0.8, 0), 0.8, Material((0.9, 0.6, 0.3), "metal", 0.35))] + things()[2:], **VIEW, environment="lobby"),
    "lobby_lambert": lambda: Scene([floor(8)] + things(), **VIEW, environment="lobby"),
    "sunset_lambert": lambda: Scene([floor(8)] + things(), **VIEW, environment="sunset"),
    "window": lambda: Scene(room_with_window(), (0.4, 1.5, 2.3), (-0.2, 1.2, -1.5), 55.0, sky=(4, 4.5, 5), sun=((0.8, 0.75, -0.3), 60.0, 0.53)),
    "window_sky": lambda: Scene(room_with_window(), (0.4, 1.5, 2.3), (-0.2, 1.2, -1.5), 55.0, sky=(4, 4.5, 5)),
    "veach_spheres": veach_spheres,
}
