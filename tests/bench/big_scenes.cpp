// Large realistic scenes: time from program start to the first image of 1280 x 720 at one sample per pixel, and peak memory
// compared with the size of the file's geometry.
#include "tests/bench/bench.h"

#include "core/files.h"
#include "io/gltf/read/json.h"
#include "tests/support/process.h"

#include <cmath>
#include <cstring>

namespace blush::bench {
namespace {

struct Glb {
    Json json{{"asset", {{"version", "2.0"}}}};
    std::vector<uint8_t> bytes;

    // `type`: "VEC3", ...; 5126 are floats, 5125 unsigned integers.
    template <class T> size_t accessor(const std::vector<T>& values, size_t components, const char* type) {
        const size_t offset = bytes.size(), size = values.size() * sizeof(T);
        bytes.resize(offset + size);
        std::memcpy(bytes.data() + offset, values.data(), size);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", std::is_same_v<T, float> ? 5126 : 5125},
                                     {"count", values.size() / components},
                                     {"type", type}});
        return json["accessors"].size() - 1;
    }
    // A grid of n x n squares over [-1, 1]^2 as a landscape, with normals and texture coordinates.
    size_t landscape(uint32_t n) {
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
        const Json attributes{{"POSITION", accessor(positions, 3, "VEC3")},
                              {"NORMAL", accessor(normals, 3, "VEC3")},
                              {"TEXCOORD_0", accessor(uv, 2, "VEC2")}};
        const Json primitive{{"attributes", attributes}, {"indices", accessor(indices, 1, "SCALAR")}};
        json["meshes"].push_back({{"primitives", Json::array({primitive})}});
        return json["meshes"].size() - 1;
    }
    Result<void> write(const std::string& file) {
        json["buffers"] = Json::array({{{"byteLength", bytes.size()}}});
        json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing"};
        json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "directional"}, {"intensity", 1000}}});
        json["nodes"].push_back({{"rotation", {-0.5, 0, 0, 0.8660254}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        return write_file(file, glb_bytes(json.dump(), std::move(bytes)));
    }
};

Json first_image(const std::string& file, size_t raw_bytes, const test::TemporaryFolder& folder, const Options& options) {
    std::vector<double> seconds;
    double peak_mb = 0;
    for (int round = 0; round < std::min(options.rounds, 3); ++round) {
        const Clock::time_point begin = Clock::now();
        const test::Finished finished =
            test::run({BLUSH_BINARY, "render", file, "-o", folder / "out.exr", "--spp", "1", "--size", "1280x720", "--threads",
                       std::to_string(options.threads), "--quiet", "--json", folder / "render.json"});
        seconds.push_back(seconds_since(begin));
        const auto report = read_file(folder / "render.json", 1 << 20);
        if (finished.exit_code != 0 || !report) return {{"failed", finished.err}};
        peak_mb = std::max(peak_mb, Json::parse(report->begin(), report->end()).value("peak_memory_mb", 0.0));
    }
    return {{"to_first_image_s", rounded(median(seconds))},
            {"peak_memory_mb", rounded(peak_mb)},
            {"raw_geometry_mb", rounded(1e-6 * double(raw_bytes))},
            {"peak_over_raw", rounded(1e6 * peak_mb / double(raw_bytes))}};
}

Json landscape(uint32_t n, const test::TemporaryFolder& folder, const Options& options) {
    Glb glb;
    const size_t mesh = glb.landscape(n);
    glb.json["nodes"].push_back({{"mesh", mesh}});
    const size_t raw = glb.bytes.size();
    const std::string file = folder / "landscape.glb";
    if (const auto written = glb.write(file); !written) return {{"failed", written.error().text()}};
    Json figures = first_image(file, raw, folder, options);
    figures["triangles"] = 2 * size_t(n) * n;
    return figures;
}

// One tree of 20,000 triangles, with many instances.
Json orchard(size_t instances, const test::TemporaryFolder& folder, const Options& options) {
    Glb glb;
    const size_t tree = glb.landscape(100);
    std::vector<float> places;
    const auto side = size_t(std::sqrt(double(instances)));
    for (size_t i = 0; i < instances; ++i) places.insert(places.end(), {2.5f * float(i % side), 0.f, 2.5f * float(i / side)});
    const size_t translation = glb.accessor(places, 3, "VEC3");
    glb.json["nodes"].push_back(
        {{"mesh", tree}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", translation}}}}}}}});
    const size_t raw = glb.bytes.size();
    const std::string file = folder / "orchard.glb";
    if (const auto written = glb.write(file); !written) return {{"failed", written.error().text()}};
    Json figures = first_image(file, raw, folder, options);
    figures["instances"] = instances;
    return figures;
}

} // namespace

Json run_big_scenes(const Options& options) {
    const test::TemporaryFolder folder;
    Json figures;
    figures["nothing"] = landscape(1, folder, options); // base memory of the program
    figures["triangles_1m"] = landscape(708, folder, options);
    figures["triangles_10m"] = landscape(2237, folder, options);
    figures["instances_1m"] = orchard(1'000'000, folder, options);
    const auto mb = [&](const char* which) {
        return figures[which].value("peak_memory_mb", 0.0) - figures["nothing"].value("peak_memory_mb", 0.0);
    };
    figures["bytes_per_triangle"] = rounded(1e6 * (mb("triangles_10m") - mb("triangles_1m")) / 9e6);
    figures["bytes_per_instance"] = rounded(mb("instances_1m"));
    return figures;
}

} // namespace blush::bench
