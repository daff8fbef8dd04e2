"""Builds a glTF scene of Blush in Blender for Cycles: Blender's own importer, then the nodes that Cycles renders fastest.

Handles what the shipped scenes and those of the peer comparison use: emissive meshes, suns, a constant environment, Lambertian
and Principled surfaces, smooth glass with absorption. Other lights and environments are refused, not left out.
"""
import json
import math
import struct

import bpy
import numpy

numpy.bool = bool  # the importer of Blender 3.4 uses the alias that NumPy 1.24 removed


def document_of(file):
    with open(file, "rb") as f:
        data = f.read()
    if data[:4] == b"glTF":
        length = struct.unpack("<I", data[12:16])[0]
        data = data[20 : 20 + length]
    return json.loads(data)


def replace_surface(tree, kind, **inputs):
    output = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeOutputMaterial")
    node = tree.nodes.new(kind)
    for name, value in inputs.items():
        node.inputs[name].default_value = value
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return node


def simplify(material, described):
    """Lambertian, purely emissive and smooth glass surfaces without the Principled BSDF, whose other lobes cost time."""
    pbr, extensions = described.get("pbrMetallicRoughness", {}), described.get("extensions", {})
    tree, textured = material.node_tree, "baseColorTexture" in pbr
    color = pbr.get("baseColorFactor", [1, 1, 1, 1])
    metallic, roughness = pbr.get("metallicFactor", 1), pbr.get("roughnessFactor", 1)
    specular = extensions.get("KHR_materials_specular", {}).get("specularFactor", 1)
    emission = described.get("emissiveFactor", [0, 0, 0])
    if extensions.get("KHR_materials_transmission", {}).get("transmissionFactor", 0) == 1 and roughness == 0 and not textured:
        ior = extensions.get("KHR_materials_ior", {}).get("ior", 1.5)
        replace_surface(tree, "ShaderNodeBsdfGlass", Color=color, IOR=ior).distribution = "SHARP"
    elif any(emission) and metallic == 0 and specular == 0 and not any(color[:3]):
        strength = extensions.get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
        replace_surface(tree, "ShaderNodeEmission", Color=[*emission, 1], Strength=strength)
    elif not any(emission) and metallic == 0 and specular == 0 and not textured:
        replace_surface(tree, "ShaderNodeBsdfDiffuse", Color=color)
    volume = extensions.get("KHR_materials_volume", {})
    for node in [n for n in tree.nodes if n.bl_idname == "ShaderNodeVolumeAbsorption"]:
        distance = volume.get("attenuationDistance", math.inf)
        sigma = [-math.log(max(c, 1e-6)) / distance for c in volume.get("attenuationColor", [1, 1, 1])]
        if max(sigma) == 0:
            tree.nodes.remove(node)
            continue
        node.inputs["Density"].default_value = max(sigma)
        node.inputs["Color"].default_value = [*(1 - s / max(sigma) for s in sigma), 1]
        material.cycles.homogeneous_volume = True


def build(file):
    document = document_of(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=file)
    described = {m["name"]: m for m in document.get("materials", []) if "name" in m}
    for material in bpy.data.materials:
        if material.name in described and material.node_tree:
            simplify(material, described[material.name])
    for light in document.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", []):
        if light["type"] != "directional":
            raise SystemExit(f"{file}: a light of type {light['type']}, only suns are handled")
        sun = bpy.data.lights[light["name"]]
        sun.energy = light.get("intensity", 1)  # the importer divides lux by 683
        sun.angle = math.radians(light.get("extras", {}).get("blush", {}).get("angle_degrees", 0))
    for light in bpy.data.lights:
        light.cycles.max_bounces = 1024
    environment = document["scenes"][0].get("extras", {}).get("blush", {}).get("environment", {"kind": "none"})
    if environment["kind"] not in ("none", "constant"):
        raise SystemExit(f"{file}: an environment of kind {environment['kind']}, only constant ones are handled")
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs[0].default_value = [*environment.get("color", [0, 0, 0]), 1]
    background.inputs[1].default_value = environment.get("intensity", 1)
    name = next(n["name"] for n in document["nodes"] if "camera" in n)
    camera = bpy.context.scene.camera = bpy.data.objects[name]
    camera.data.clip_start, camera.data.clip_end = 1e-3, 1e4
    return bpy.context.scene
