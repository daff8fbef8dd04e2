"""Builds a scene of peer_scenes.py in Blender for Cycles, and renders it. Runs in Blender:

blender -b -noaudio --python cycles_scene.py -- SCENE SPP SEED FILE.exr [WIDTHxHEIGHT] [PANORAMAS]
"""
import math
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy  # noqa: E402
import mathutils  # noqa: E402
import peer_scenes  # noqa: E402

BOUNCES, THREADS = 64, 2


def z_up(p):
    return (p[0], -p[2], p[1])


def cycles_material(m):
    material = bpy.data.materials.new(m.kind)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    kind = {"lambert": "ShaderNodeBsdfDiffuse", "glass": "ShaderNodeBsdfGlass", "metal": "ShaderNodeBsdfPrincipled", "emitter": "ShaderNodeEmission"}
    node = tree.nodes.new(kind[m.kind])
    if m.kind == "lambert":
        node.inputs["Color"].default_value = (*m.color, 1)
    elif m.kind == "glass":
        node.distribution = "SHARP"
        node.inputs["IOR"].default_value = 1.5
        node.inputs["Color"].default_value = (1, 1, 1, 1)
    elif m.kind == "metal":
        node.distribution = "GGX"
        node.inputs["Base Color"].default_value = (*m.color, 1)
        node.inputs["Metallic"].default_value = 1
        node.inputs["Roughness"].default_value = m.roughness
    else:
        strength = max(m.emission)
        node.inputs["Color"].default_value = (*(e / strength for e in m.emission), 1)
        node.inputs["Strength"].default_value = strength
    shader = node.outputs[0]
    if m.alpha < 1:
        mix = tree.nodes.new("ShaderNodeMixShader")
        mix.inputs[0].default_value = m.alpha
        tree.links.new(tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[1])
        tree.links.new(shader, mix.inputs[2])
        shader = mix.outputs[0]
    tree.links.new(shader, tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return material


def place(name, data, position, direction=None):
    o = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(o)
    o.location = z_up(position)
    if direction is not None:
        o.rotation_euler = mathutils.Vector(z_up(direction)).to_track_quat("-Z", "Y").to_euler()
    return o


def world(scene, panoramas):
    w = bpy.data.worlds.new("world")
    bpy.context.scene.world = w
    w.use_nodes = True
    background = w.node_tree.nodes["Background"]
    background.inputs[0].default_value = (*(scene.sky or (0, 0, 0)), 1)
    if scene.environment:
        tree = w.node_tree
        texture = tree.nodes.new("ShaderNodeTexEnvironment")
        texture.image = bpy.data.images.load(os.path.join(panoramas, scene.environment + ".exr"))
        mapping = tree.nodes.new("ShaderNodeMapping")
        mapping.inputs["Rotation"].default_value = (0, 0, math.radians(-90))
        tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs[0])
        tree.links.new(mapping.outputs[0], texture.inputs[0])
        tree.links.new(texture.outputs[0], background.inputs[0])


def build(scene, panoramas):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for o in scene.objects:
        mesh = bpy.data.meshes.new("mesh")
        mesh.from_pydata([z_up(p) for p in o.points.tolist()], [], o.triangles.tolist())
        mesh.polygons.foreach_set("use_smooth", [o.smooth] * len(mesh.polygons))
        mesh.materials.append(cycles_material(o.material))
        place("object", mesh, (0, 0, 0))
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle = math.radians(scene.yfov_degrees)
    camera.clip_start = 0.001
    bpy.context.scene.camera = place("camera", camera, scene.eye, [t - e for t, e in zip(scene.target, scene.eye)])
    if scene.sun:
        direction, lux, degrees = scene.sun
        sun = bpy.data.lights.new("sun", "SUN")
        sun.energy, sun.angle = lux, math.radians(degrees)
        place("sun", sun, (0, 0, 0), [-x for x in direction])
    if scene.point_light:
        position, candela = scene.point_light
        point = bpy.data.lights.new("point", "POINT")
        point.energy, point.shadow_soft_size = 4 * math.pi * candela, 0
        place("point", point, position)
    world(scene, panoramas)
    for light in bpy.data.lights:
        light.cycles.max_bounces = 1024
    return bpy.context.scene


def settings(scene, spp, seed, width, height):
    """Nothing that changes the expected value, and no adaptive sampling."""
    scene.render.engine = "CYCLES"
    c = scene.cycles
    c.device, c.samples, c.seed = "CPU", spp, seed
    c.use_adaptive_sampling = c.use_denoising = False
    c.sample_clamp_direct = c.sample_clamp_indirect = c.blur_glossy = c.light_sampling_threshold = 0
    c.caustics_reflective = c.caustics_refractive = True
    for bounces in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "transparent_max_bounces"):
        setattr(c, bounces, BOUNCES)
    c.pixel_filter_type, c.filter_width = "BOX", 1.0
    r = scene.render
    r.threads_mode, r.threads = "FIXED", THREADS
    r.resolution_x, r.resolution_y, r.resolution_percentage = width, height, 100
    image = r.image_settings
    image.file_format, image.color_depth, image.exr_codec, image.color_mode = "OPEN_EXR", "32", "ZIP", "RGB"
    r.use_compositing = r.use_sequencer = r.film_transparent = False
    c.film_exposure = 1.0


def main():
    name, spp, seed, file, *rest = sys.argv[sys.argv.index("--") + 1 :]
    width, height = (int(n) for n in rest[0].split("x")) if rest else (512, 512)
    scene = build(peer_scenes.SCENES[name](), rest[1] if len(rest) > 1 else ".")
    settings(scene, int(spp), int(seed), width, height)
    scene.render.filepath = file
    begin, begin_cores = time.time(), time.process_time()
    bpy.ops.render.render(write_still=True)
    print("RENDER_SECONDS", time.time() - begin, time.process_time() - begin_cores)


if __name__ == "__main__":
    main()
