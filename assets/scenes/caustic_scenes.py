"""The demo scenes of caustics: light that mirrors and glass focus. make_scenes.py writes them; README.md describes what to see."""
import math

from placement import about_y, direction
from scene_writer import SceneWriter
from shapes import Mesh, box, curved, grid, lathe, mul, prism, quad, rounded, sphere, unit

CLEAR = (1, 1, 1)


def lamp(scene, position, side, radiance):
    """A square that shines down."""
    black = scene.material("lamp", (0, 0, 0), lambertian=True, emission=(radiance,) * 3)
    r = side / 2
    scene.object("lamp", quad((-r, 0, -r), (r, 0, -r), (r, 0, r), (-r, 0, r)), black, "sheet", translation=position)


def wine_glass():
    """A glass of 19 cm, filled to two thirds, under a small lamp behind it at the left. Glass and wine are one solid."""
    scene = SceneWriter("wine-glass", "A glass of wine focuses the light of a lamp on the table.",
                        environment={"kind": "constant", "color": [0.75, 0.85, 1], "intensity": 0.05})
    table = scene.material("table", (0.5, 0.42, 0.34), lambertian=True)
    glass = scene.material("glass", CLEAR, roughness=0, transmission=1, ior=1.52, attenuation=((0.8, 0.22, 0.18), 0.05))
    profile = curved([
        (0, 0.0004), (0.0200, 0.0004), (0.0325, 0.0006), (0.0345, 0.0018), (0.0320, 0.0033), (0.0150, 0.0060), (0.0058, 0.0120),
        (0.0045, 0.0300), (0.0046, 0.0600), (0.0100, 0.0745), (0.0290, 0.0910), (0.0410, 0.1200), (0.0410, 0.1480), (0.0345, 0.1890),
        (0.0339, 0.1900), (0.0333, 0.1890), (0.0390, 0.1500), (0.0385, 0.1455), (0.0340, 0.1450), (0.0150, 0.1450), (0, 0.1450),
    ], steps=5)
    scene.object("table", box((-0.9, -0.03, -0.9), (0.9, 0, 0.9)), table)
    scene.object("wine glass", lathe(profile, columns=80), glass)
    lamp(scene, (-0.34, 0.66, -0.26), 0.04, 900)
    scene.camera("camera", (0.16, 0.34, 0.52), (0.04, 0.065, 0.02), yfov_degrees=30)
    return scene


def pool():
    """A basin of 2.4 x 1.6 x 1 m whose water has waves of some millimetres, under the sun."""
    scene = SceneWriter("pool", "Waves focus the sun on the bottom of a pool, and the camera sees it through them.",
                        environment={"kind": "constant", "color": [0.55, 0.75, 1], "intensity": 0.2})
    tiles = scene.material("tiles", (0.55, 0.75, 0.8), lambertian=True)
    stone = scene.material("stone", (0.55, 0.5, 0.44), lambertian=True)
    water = scene.material("water", CLEAR, roughness=0, transmission=1, ior=1.33, attenuation=((0.6, 0.9, 0.95), 4))
    x, z, wall, depth, level = 1.2, 0.8, 0.2, 1.0, -0.08
    scene.object("bottom", box((-x - wall, -depth - 0.1, -z - wall), (x + wall, -depth, z + wall)), tiles)
    walls = Mesh()
    for low, high in (((-x - wall, -z - wall), (-x, z + wall)), ((x, -z - wall), (x + wall, z + wall)), ((-x, -z - wall), (x, -z)),
                      ((-x, z), (x, z + wall))):
        walls.add(box((low[0], -depth + 0.0005, low[1]), (high[0], -0.05, high[1])))
    scene.object("walls", walls, tiles)
    deck = Mesh()
    for low, high in (((-x - 1, -z - 1), (-x, z + 1)), ((x, -z - 1), (x + 1, z + 1)), ((-x, -z - 1), (x, -z)), ((-x, z), (x, z + 1))):
        deck.add(box((low[0], -0.0495, low[1]), (high[0], 0, high[1])))
    scene.object("deck", deck, stone)

    # The body of water ends within the walls and the bottom.
    waves = [(0.0060, 6.1, 4.9, 0.3), (0.0052, -4.2, 9.1, 1.7), (0.0040, 11.3, -3.2, 4.0), (0.0032, -9.1, -9.8, 2.2), (0.0022, 14.3, 9.4, 5.1),
             (0.0018, 3.0, -17.5, 0.9)]
    columns, rows, reach = 112, 76, 0.05
    width, length = 2 * (x + reach), 2 * (z + reach)

    def surface(row, column):
        px, pz = (column / columns - 0.5) * width, (0.5 - row / rows) * length
        inside = min(1.0, row, rows - row, column, columns - column)  # the edge is flat
        y, dx, dz = level, 0.0, 0.0
        for height, kx, kz, phase in waves:
            angle = kx * px + kz * pz + phase
            y += inside * height * math.sin(angle)
            dx += height * kx * math.cos(angle)
            dz += height * kz * math.cos(angle)
        return (px, y, pz), unit((-dx, 1.0, -dz))

    body = grid(rows, columns, surface)
    # Sides and bottom: strips with the vertices of the edge, so that the body is closed.
    last = rows * (columns + 1)
    edge = list(range(0, columns)) + [columns + i * (columns + 1) for i in range(rows)]
    edge += [last + columns - i for i in range(columns)] + [last - i * (columns + 1) for i in range(rows)]
    ring = [body.points[i] for i in edge]
    bottom = -depth - reach
    for a, b in zip(ring, ring[1:] + ring[:1]):
        body.add(quad((a[0], bottom, a[2]), (b[0], bottom, b[2]), b, a))
    fan = [(p[0], bottom, p[2]) for p in ring]
    body.add(Mesh([(0.0, bottom, 0.0)] + fan, [(0.0, -1.0, 0.0)] * (len(fan) + 1),
                  [(0, (i + 1) % len(fan) + 1, i + 1) for i in range(len(fan))]))
    scene.object("water", body, water)

    toward_sun = direction(azimuth=-50, elevation=58)
    scene.sun("sun", toward_sun, (1, 0.93, 0.82), lux=4, angle_degrees=0.53, translation=mul(toward_sun, 3))
    scene.camera("camera", (0.9, 1.5, 2.1), (-0.05, -0.62, -0.05), yfov_degrees=38)
    return scene


def bulb():
    """A filament ball of 8 mm in a glass envelope of 6 cm lights a small closed room: all light comes through the glass."""
    scene = SceneWriter("bulb", "All light of the room comes through the glass of a bulb.")
    plaster = scene.material("plaster", (0.75, 0.73, 0.7), lambertian=True)
    terracotta = scene.material("terracotta", (0.7, 0.32, 0.2), lambertian=True)
    glass = scene.material("glass", CLEAR, roughness=0, transmission=1, ior=1.5)
    shine = scene.material("filament", (0, 0, 0), lambertian=True, emission=(6000, 4700, 3300))
    brass = scene.material("brass", (0.85, 0.65, 0.35), metallic=1, roughness=0.4)
    room = Mesh()
    w, h = 0.8, 1.1
    for corners in (((-w, 0, w), (w, 0, w), (w, 0, -w), (-w, 0, -w)), ((-w, h, -w), (w, h, -w), (w, h, w), (-w, h, w)),
                    ((-w, 0, -w), (w, 0, -w), (w, h, -w), (-w, h, -w)), ((w, 0, w), (-w, 0, w), (-w, h, w), (w, h, w)),
                    ((w, 0, -w), (w, 0, w), (w, h, w), (w, h, -w))):
        room.add(quad(*corners))
    scene.object("room", room, plaster, "sheet")
    scene.object("coloured wall", quad((-w, 0, w), (-w, 0, -w), (-w, h, -w), (-w, h, w)), terracotta, "sheet")
    bulb_node = scene.node("bulb", translation=(-0.12, 0.62, -0.1))
    inside = sphere((0, 0, 0), 0.029, 32, 64)
    inside = Mesh(inside.points, [mul(n, -1) for n in inside.normals], [(a, c, b) for a, b, c in inside.triangles])
    scene.object("envelope", sphere((0, 0, 0), 0.030, 32, 64).add(inside), glass, parent=bulb_node)
    scene.object("filament", sphere((0, 0, 0), 0.004, 12, 24), shine, parent=bulb_node)
    scene.object("holder", lathe(rounded([(0, 0.0305, 0), (0.012, 0.0305, 0.001), (0.012, 0.07, 0.002), (0.002, 0.08, 0.001),
                                          (0.002, 0.475, 0.0005), (0, 0.475, 0)], 4), 32), brass, parent=bulb_node)
    block = [(-0.1, 0.1), (0.14, 0.16), (0.2, -0.08), (-0.04, -0.14)]
    scene.object("block", prism([(x + 0.25, z - 0.05) for x, z in block], 0.3), plaster, "standing")
    scene.object("ball", sphere((0, 0, 0), 0.13, 32, 64), plaster, translation=(-0.3, 0.1301, 0.15))
    scene.camera("camera", (0.28, 0.62, 0.76), (-0.05, 0.36, -0.1), yfov_degrees=58)
    return scene


def metal_ring():
    """A polished ring of 20 cm, 6 cm high, under a small lamp: the cardioid of the coffee cup."""
    scene = SceneWriter("metal-ring", "A polished ring focuses the light of a lamp: the caustic of the coffee cup.",
                        environment={"kind": "constant", "color": [0.75, 0.85, 1], "intensity": 0.05})
    table = scene.material("table", (0.6, 0.58, 0.55), lambertian=True)
    gold = scene.material("gold", (0.95, 0.75, 0.42), roughness=0, metallic=1)
    profile = rounded([(0.096, 0.03, 0), (0.096, 0.0004, 0.002), (0.104, 0.0004, 0.002), (0.104, 0.06, 0.002), (0.096, 0.06, 0.002),
                       (0.096, 0.03, 0)], arc_steps=4)
    scene.object("table", box((-0.6, -0.03, -0.6), (0.6, 0, 0.6)), table)
    scene.object("ring", lathe(profile, columns=160), gold)
    lamp(scene, (-0.4, 0.32, -0.1), 0.04, 400)
    scene.camera("camera", (0.05, 0.44, 0.42), (0.0, 0.0, 0.01), yfov_degrees=32)
    return scene


def glass_prism():
    """A prism behind a slit that the sun shines through. Its dispersion is ten times that of flint glass, so that a short way is enough."""
    scene = SceneWriter("prism", "A prism spreads the light of a slit into its colours.",
                        environment={"kind": "constant", "color": [0.8, 0.9, 1], "intensity": 0.12})
    paper = scene.material("paper", (0.8, 0.8, 0.8), lambertian=True)
    dark = scene.material("dark screen", (0.05, 0.05, 0.05), lambertian=True)
    glass = scene.material("flint glass", CLEAR, roughness=0, transmission=1, ior=1.62, attenuation=(CLEAR, 1), dispersion=3)
    scene.object("table", box((-0.3, -0.02, -0.5), (0.6, 0, 0.3)), paper)
    side = 0.05
    base = [(0, side), (side * 0.866, -side / 2), (-side * 0.866, -side / 2)]
    down = [(x, 0.0, z) for x, z in base]
    top = Mesh([(x, 0.08, z) for x, z in base], [(0, 1, 0)] * 3, [(0, 1, 2)])
    body = Mesh(top.points, top.normals, top.triangles)
    for i in range(3):
        (ax, az), (bx, bz) = base[i], base[(i + 1) % 3]
        body.add(quad((ax, 0, az), (bx, 0, bz), (bx, 0.08, bz), (ax, 0.08, az)))
    body.add(Mesh(list(reversed(down)), [(0, -1, 0)] * 3, [(0, 1, 2)]))
    scene.object("prism", body, glass, translation=(0, 0.0004, 0), rotation=about_y(24))  # about the least deviation
    gap, height = 0.006, 0.2
    scene.object("left half of the slit", box((-0.14, 0.0004, -0.6), (-0.135, height, -gap / 2)), dark)
    scene.object("right half of the slit", box((-0.14, 0.0004, gap / 2), (-0.135, height, 0.6)), dark)
    toward_sun = direction(azimuth=-90, elevation=14)
    scene.sun("sun", toward_sun, (1, 1, 1), lux=60, angle_degrees=0.53, translation=mul(toward_sun, 0.3))
    scene.camera("camera", (0.20, 0.48, 0.36), (0.08, 0.0, -0.09), yfov_degrees=40)
    return scene


SCENES = (wine_glass, pool, bulb, metal_ring, glass_prism)
