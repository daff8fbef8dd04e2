#include "tests/bench/big/glb.h"

#include "core/files.h"

#include <cmath>

namespace blush::bench {

size_t Glb::landscape(uint32_t n, int material) {
    std::vector<float> positions, normals, uv;
    std::vector<uint32_t> indices;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const double u = double(i) / n, v = double(j) / n, dx = 0.9 * std::cos(9 * u) * std::cos(7 * v),
                         dz = -0.7 * std::sin(9 * u) * std::sin(7 * v);
            const double size = std::sqrt(dx * dx / 4 + 1 + dz * dz / 4);
            positions.insert(positions.end(), {float(2 * u - 1), float(0.1 * std::sin(9 * u) * std::cos(7 * v)), float(2 * v - 1)});
            normals.insert(normals.end(), {float(-dx / 2 / size), float(1 / size), float(-dz / 2 / size)});
            uv.insert(uv.end(), {float(u), float(v)});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            indices.insert(indices.end(), {a, d, b, a, c, d});
        }
    const Json attributes{
        {"POSITION", accessor(positions, 3, "VEC3")}, {"NORMAL", accessor(normals, 3, "VEC3")}, {"TEXCOORD_0", accessor(uv, 2, "VEC2")}};
    Json primitive{{"attributes", attributes}, {"indices", accessor(indices, 1, "SCALAR")}};
    if (material >= 0) primitive["material"] = material;
    json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    return json["meshes"].size() - 1;
}

Result<void> Glb::write(const std::string& file) {
    json["buffers"] = Json::array({{{"byteLength", bytes.size()}}});
    json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing"};
    json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "directional"}, {"intensity", 1000}}});
    json["nodes"].push_back({{"rotation", {-0.5, 0, 0, 0.8660254}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return write_file(file, glb_bytes(json.dump(), std::move(bytes)));
}

} // namespace blush::bench
