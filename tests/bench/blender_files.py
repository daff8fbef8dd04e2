# Writes typical glTF files with Blender and its exporter: models without light, rooms and suns at Blender's default strengths.
# tests/bench/opened_files opens them.
#   blender -b --python tests/bench/blender_files.py -- FOLDER
import math
import sys

import bpy
import mathutils

folder = sys.argv[sys.argv.index("--") + 1]


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def material(name, color, roughness=0.5, metallic=0.0, emission=None, strength=1):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    inputs = m.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (*color, 1)
    inputs["Roughness"].default_value = roughness
    inputs["Metallic"].default_value = metallic
    if emission:
        inputs["Emission"].default_value = (*emission, 1)
        inputs["Emission Strength"].default_value = strength
    return m


def give(m):
    data = bpy.context.object.data
    data.materials.clear()
    data.materials.append(m)


def camera(location, target):
    bpy.ops.object.camera_add(location=location)
    c = bpy.context.object
    c.rotation_euler = (mathutils.Vector(target) - mathutils.Vector(location)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.camera = c


def export(name, cameras=True):
    bpy.ops.export_scene.gltf(filepath=f"{folder}/{name}.glb", export_format="GLB", export_cameras=cameras, export_lights=True)


def suzanne(location=(0, 0, 1), m=None, scale=1):
    bpy.ops.mesh.primitive_monkey_add(location=location)
    o = bpy.context.object
    o.modifiers.new("Subdivision", "SUBSURF").levels = 2
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    bpy.ops.object.shade_smooth()
    o.scale = (scale,) * 3
    give(m or material("Skin", (0.6, 0.3, 0.2)))


def lamp(kind, energy, location, rotation=(0, 0, 0)):
    bpy.ops.object.light_add(type=kind, location=location, rotation=rotation)
    bpy.context.object.data.energy = energy


def room():
    white, red, wood = material("Wall", (0.8,) * 3, 0.9), material("Red", (0.7, 0.1, 0.1)), material("Wood", (0.35, 0.2, 0.1))
    quarter = math.pi / 2
    for location, rotation, m in [((0, 0, 0), (0, 0, 0), wood), ((0, 0, 3), (math.pi, 0, 0), white), ((0, 3, 1.5), (quarter, 0, 0), white),
                                  ((-3, 0, 1.5), (0, quarter, 0), red), ((3, 0, 1.5), (0, -quarter, 0), white)]:
        bpy.ops.mesh.primitive_plane_add(size=6, location=location, rotation=rotation)
        give(m)
    bpy.ops.mesh.primitive_cube_add(size=0.8, location=(1, 0.5, 0.4))
    give(material("Table", (0.5, 0.4, 0.3)))
    suzanne((0, 0, 0.6), scale=0.5)
    camera((0, -5, 1.6), (0, 0, 1.2))


def outdoors():
    bpy.ops.mesh.primitive_plane_add(size=20)
    give(material("Ground", (0.4, 0.4, 0.35), 0.9))
    suzanne(m=material("Gold", (1, 0.77, 0.34), 0.3, 1.0))
    bpy.ops.mesh.primitive_cube_add(location=(2.5, 1, 1))
    give(material("Blue", (0.1, 0.2, 0.6)))
    camera((0, -7, 3), (0.5, 0, 1))


clear()
suzanne()
export("model", cameras=False)

clear()
suzanne(m=material("Black paint", (0.02,) * 3, 0.2), scale=0.01)
export("tiny-dark-model", cameras=False)

clear()
room()
lamp("POINT", 1000, (0, -0.5, 2.5))
export("room-point-1000-watts")

clear()
room()
lamp("AREA", 100, (0, -0.5, 2.5))  # not exported
export("room-area-light-dropped")

clear()
room()
lamp("SPOT", 500, (0, -0.5, 2.5))
bpy.ops.mesh.primitive_uv_sphere_add(radius=0.1, location=(-1.5, 1, 1.8))
give(material("Bulb", (1, 1, 1), emission=(1, 0.8, 0.5), strength=10))
export("room-spot-and-bulb")

for strength in (1, 1000):
    clear()
    outdoors()
    lamp("SUN", strength, (4, -4, 6), (0.8, 0.2, 0.5))
    export(f"sun-{strength}")

bpy.ops.wm.read_factory_settings()
export("blenders-own-cube")
