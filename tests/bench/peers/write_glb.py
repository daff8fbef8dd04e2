"""Writes a scene of peer_scenes.py as .glb, for Blush."""
import json
import struct
import sys

import numpy as np


def material_of(m):
    pbr = {"baseColorFactor": [*m.color, m.alpha], "metallicFactor": float(m.kind == "metal"), "roughnessFactor": m.roughness}
    out = {"pbrMetallicRoughness": pbr, "doubleSided": True, "extensions": {}}
    if m.kind in ("lambert", "emitter"):
        out["extensions"]["KHR_materials_specular"] = {"specularFactor": 0}
    if m.kind == "glass":
        out["extensions"]["KHR_materials_transmission"] = {"transmissionFactor": 1}
        out["extensions"]["KHR_materials_volume"] = {"thicknessFactor": 1}
        out["extensions"]["KHR_materials_ior"] = {"ior": 1.5}
    if m.kind == "emitter":
        strength = max(m.emission)
        pbr["baseColorFactor"] = [0, 0, 0, 1]
        out["emissiveFactor"] = [e / strength for e in m.emission]
        out["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
    if m.alpha < 1:
        out["alphaMode"] = "BLEND"
    return out


def vertex_normals(points, triangles):
    corners = points[triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], face)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def aimed(direction):
    """Quaternion x, y, z, w that rotates -Z to `direction`, with +Y up."""
    z = -np.asarray(direction, float) / np.linalg.norm(direction)
    x = np.cross((0, 1, 0), z)
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
    m = np.stack([x, y, z], 1)
    # The eigenvector of the largest eigenvalue (Bar-Itzhack 2000).
    k = np.array([
        [m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[2, 0] + m[0, 2], m[2, 1] - m[1, 2]],
        [m[1, 0] + m[0, 1], m[1, 1] - m[0, 0] - m[2, 2], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
        [m[2, 0] + m[0, 2], m[2, 1] + m[1, 2], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
        [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 0] + m[1, 1] + m[2, 2]],
    ])
    return np.linalg.eigh(k)[1][:, 3].tolist()


def write_glb(scene, file):
    data = bytearray()
    g = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [],
         "accessors": [], "bufferViews": [], "cameras": [{"type": "perspective", "perspective": {
             "yfov": np.radians(scene.yfov_degrees), "aspectRatio": 1, "znear": 0.001, "zfar": 1000}}]}

    def accessor(array, component, kind, bounds=False):
        g["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        data.extend(array.tobytes())
        a = {"bufferView": len(g["bufferViews"]) - 1, "componentType": component, "count": array.size // (3 if kind == "VEC3" else 1), "type": kind}
        if bounds:
            a |= {"min": array.min(0).tolist(), "max": array.max(0).tolist()}
        g["accessors"].append(a)
        return len(g["accessors"]) - 1

    def node(**properties):
        g["scenes"][0]["nodes"].append(len(g["nodes"]))
        g["nodes"].append(properties)

    for o in scene.objects:
        attributes = {"POSITION": accessor(o.points.astype("<f4"), 5126, "VEC3", bounds=True)}
        if o.smooth:
            attributes["NORMAL"] = accessor(vertex_normals(o.points, o.triangles).astype("<f4"), 5126, "VEC3")
        g["materials"].append(material_of(o.material))
        g["meshes"].append({"primitives": [{"attributes": attributes, "indices": accessor(o.triangles.astype("<u4").ravel(), 5125, "SCALAR"),
                                            "material": len(g["materials"]) - 1}]})
        node(mesh=len(g["meshes"]) - 1)
    node(camera=0, translation=list(scene.eye), rotation=aimed(np.subtract(scene.target, scene.eye)))
    lights = []
    if scene.sun:
        direction, lux, degrees = scene.sun
        lights.append({"type": "directional", "intensity": lux, "extras": {"blush": {"angle_degrees": degrees}}})
        node(rotation=aimed(np.negative(direction)), extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})
    if scene.point_light:
        position, candela = scene.point_light
        lights.append({"type": "point", "intensity": candela})
        node(translation=list(position), extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})
    if lights:
        g["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    g["extensionsUsed"] = sorted({e for m in g["materials"] for e in m["extensions"]} | ({"KHR_lights_punctual"} if lights else set()))
    g["buffers"] = [{"byteLength": len(data)}]
    text = json.dumps({k: v for k, v in g.items() if v != []}).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    with open(file, "wb") as out:
        out.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(data)) + struct.pack("<II", len(text), 0x4E4F534A) + text)
        out.write(struct.pack("<II", len(data), 0x004E4942) + data)


if __name__ == "__main__":
    import peer_scenes

    write_glb(peer_scenes.SCENES[sys.argv[1]](), sys.argv[2])
