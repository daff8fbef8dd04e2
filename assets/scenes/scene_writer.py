"""A small glTF 2.0 writer: meshes in, .gltf text and .bin out, the same bytes on every machine."""
import json
import math
import re
import struct

from shapes import cross, dot, sub, unit

FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


def to_float32(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def short_float(x):
    """The shortest decimal text that parses to the same float32."""
    for digits in range(1, 10):
        text = float(f"{x:.{digits}g}")
        if to_float32(text) == to_float32(x):
            return int(text) if text == int(text) and abs(text) < 1e6 else text
    return x


def numbers(values):
    return [short_float(v) for v in values]


def check(name, mesh, kind):
    """Checks unit normals, triangle areas and winding. A "solid" is closed and not inside
    out; a "standing" mesh may be open at y = 0; a "sheet" may be open anywhere."""
    for n in mesh.normals:
        assert abs(dot(n, n) - 1) < 1e-9, f"{name}: a normal is not of unit length"
    edges = {}
    volume = 0.0
    for t in mesh.triangles:
        a, b, c = (mesh.points[i] for i in t)
        area = cross(sub(b, a), sub(c, a))
        assert dot(area, area) > 1e-24, f"{name}: a triangle without area"
        for i in t:
            assert dot(unit(area), mesh.normals[i]) > 0.2, f"{name}: a triangle that faces away from its normals"
        volume += dot(a, cross(b, c)) / 6
        keys = [tuple(round(x * 1e7) for x in p) for p in (a, b, c)]
        for i in range(3):
            edge, reverse = (keys[i], keys[(i + 1) % 3]), (keys[(i + 1) % 3], keys[i])
            if edges.get(reverse, 0) == 1:
                del edges[reverse]
            else:
                edges[edge] = edges.get(edge, 0) + 1
    if kind == "sheet":
        return
    if kind == "standing":
        edges = [edge for edge in edges if any(point[1] != 0 for point in edge)]
    assert not edges, f"{name}: {len(edges)} open edges"
    assert volume > 0, f"{name}: inside out"


class SceneWriter:
    def __init__(self, name, description, environment=None):
        scene = {"name": name, "nodes": []}
        if environment:
            scene["extras"] = {"blush": {"environment": environment}}
        self.name = name
        self.json = {
            "asset": {"version": "2.0", "generator": "make_scenes.py", "extras": {"description": description}},
            "extensionsUsed": [],
            "scene": 0,
            "scenes": [scene],
            "nodes": [],
            "cameras": [],
            "materials": [],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
            "buffers": [],
        }
        self.bytes = bytearray()

    def uses(self, extension):
        if extension not in self.json["extensionsUsed"]:
            self.json["extensionsUsed"] = sorted(self.json["extensionsUsed"] + [extension])

    def append(self, key, value):
        self.json[key].append(value)
        return len(self.json[key]) - 1

    def material(self, name, color, roughness=1.0, metallic=0.0, lambertian=False, emission=None, double_sided=False,
                 transmission=0.0, ior=None, attenuation=None, dispersion=0.0):
        """color: linear reflectance. emission: nits. lambertian: without the specular layer of glTF's dielectrics.
        attenuation: colour that white light has after a distance in metres, of a solid that transmits. dispersion: 20 / Abbe number."""
        m = {
            "name": name,
            "pbrMetallicRoughness": {
                "baseColorFactor": numbers([*color, 1]),
                "metallicFactor": short_float(metallic),
                "roughnessFactor": short_float(roughness),
            },
        }
        extensions = {}
        if lambertian:
            extensions["KHR_materials_specular"] = {"specularFactor": 0}
        if emission:
            strength = max(emission)
            m["emissiveFactor"] = numbers(e / strength for e in emission)
            extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": short_float(strength)}
        if transmission:
            extensions["KHR_materials_transmission"] = {"transmissionFactor": short_float(transmission)}
            color, distance = attenuation or ((1, 1, 1), 1)
            extensions["KHR_materials_volume"] = {
                "thicknessFactor": 0.01, "attenuationColor": numbers(color), "attenuationDistance": short_float(distance)
            }
        if ior:
            extensions["KHR_materials_ior"] = {"ior": short_float(ior)}
        if dispersion:
            extensions["KHR_materials_dispersion"] = {"dispersion": short_float(dispersion)}
        if double_sided:
            m["doubleSided"] = True
        if extensions:
            m["extensions"] = extensions
            for extension in extensions:
                self.uses(extension)
        return self.append("materials", m)

    def accessor(self, values, component, kind, target, bounds=False):
        width = {"SCALAR": 1, "VEC3": 3}[kind]
        code = {FLOAT: "f", UNSIGNED_SHORT: "H", UNSIGNED_INT: "I"}[component]
        flat = [x for v in values for x in v] if width > 1 else list(values)
        self.bytes += bytes(-len(self.bytes) % 4)
        data = struct.pack(f"<{len(flat)}{code}", *flat)
        view = self.append("bufferViews", {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data), "target": target})
        self.bytes += data
        a = {"bufferView": view, "componentType": component, "count": len(values), "type": kind}
        if bounds:
            a["min"] = numbers(min(v[i] for v in values) for i in range(width))
            a["max"] = numbers(max(v[i] for v in values) for i in range(width))
        return self.append("accessors", a)

    def mesh(self, name, mesh, material, kind="solid"):
        check(f"{self.name}/{name}", mesh, kind)
        index_type = UNSIGNED_SHORT if len(mesh.points) < 65535 else UNSIGNED_INT
        # Adding zero turns -0.0 into 0.0, which avoids meaningless differences in the files.
        primitive = {
            "attributes": {
                "POSITION": self.accessor([tuple(x + 0.0 for x in p) for p in mesh.points], FLOAT, "VEC3", ARRAY_BUFFER, bounds=True),
                "NORMAL": self.accessor([tuple(x + 0.0 for x in n) for n in mesh.normals], FLOAT, "VEC3", ARRAY_BUFFER),
            },
            "indices": self.accessor([i for t in mesh.triangles for i in t], index_type, "SCALAR", ELEMENT_ARRAY_BUFFER),
            "material": material,
        }
        return self.append("meshes", {"name": name, "primitives": [primitive]})

    def node(self, name, parent=None, translation=None, rotation=None, **what):
        n = {"name": name, **what}
        if translation:
            n["translation"] = numbers(translation)
        if rotation:
            n["rotation"] = numbers(rotation)
        index = self.append("nodes", n)
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def object(self, name, mesh, material, kind="solid", **where):
        return self.node(name, mesh=self.mesh(name, mesh, material, kind), **where)

    def camera(self, name, eye, target, yfov_degrees, aspect=16 / 9):
        camera = {
            "name": name,
            "type": "perspective",
            "perspective": {
                "yfov": short_float(math.radians(yfov_degrees)), "aspectRatio": short_float(aspect), "znear": 0.01, "zfar": 1000
            },
        }
        return self.node(name, camera=self.append("cameras", camera), translation=eye, rotation=looking_along(sub(target, eye)))

    def sun(self, name, toward_sun, color, lux, angle_degrees, translation=None):
        """A directional light from the direction toward_sun. The position of its node only matters in editors."""
        self.uses("KHR_lights_punctual")
        lights = self.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({
            "name": name, "type": "directional", "color": numbers(color), "intensity": short_float(lux),
            "extras": {"blush": {"angle_degrees": angle_degrees}},
        })
        rotation = looking_along(tuple(-x for x in toward_sun))
        return self.node(name, translation=translation, rotation=rotation, extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})

    def files(self):
        """Maps the names of the two files to their content."""
        self.json["buffers"] = [{"uri": f"{self.name}.bin", "byteLength": len(self.bytes)}]
        text = json.dumps({k: v for k, v in self.json.items() if v != []}, indent=2)
        # Number arrays on one line each.
        text = re.sub(r"\[\s+([-\d.,\se+]+?)\s+\]", lambda m: "[" + re.sub(r"\s+", " ", m[1]) + "]", text)
        return {f"{self.name}.gltf": (text + "\n").encode(), f"{self.name}.bin": bytes(self.bytes)}


def looking_along(direction, up=(0, 1, 0)):
    """Quaternion (x, y, z, w) that rotates -Z to the direction and keeps +Y up."""
    z = unit(tuple(-x for x in direction))
    x = unit(cross(up, z))
    y = cross(z, x)
    m = [(x[i], y[i], z[i]) for i in range(3)]
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0:
        s = 2 * math.sqrt(trace + 1)
        return ((m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4)
    i = max(range(3), key=lambda k: m[k][k])
    j, k = (i + 1) % 3, (i + 2) % 3
    s = 2 * math.sqrt(1 + m[i][i] - m[j][j] - m[k][k])
    q = [0.0] * 4
    q[i], q[j], q[k], q[3] = s / 4, (m[i][j] + m[j][i]) / s, (m[i][k] + m[k][i]) / s, (m[k][j] - m[j][k]) / s
    return tuple(q)
