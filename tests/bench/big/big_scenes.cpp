// Large realistic scenes: time from program start to the first image of 1280 x 720 at one sample per pixel, and peak memory
// compared with the size of the file's geometry.
#include "tests/bench/big/glb.h"
#include "tests/bench/big/whole_process.h"

#include "core/files.h"

#include <cmath>

namespace blush::bench {
namespace {

Json first_image(const std::string& file, size_t raw_bytes, const test::TemporaryFolder& folder, const Options& options) {
    Json figures = measure_process({file}, folder, options);
    if (figures.contains("failed")) return figures;
    figures["raw_geometry_mb"] = rounded(1e-6 * double(raw_bytes));
    figures["peak_over_raw"] = rounded(1e6 * figures.value("peak_memory_mb", 0.0) / double(raw_bytes));
    return figures;
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

// Meshes of 200 triangles, each with a material of its own.
Json many_meshes(size_t count, const test::TemporaryFolder& folder, const Options& options) {
    Glb glb;
    const auto side = size_t(std::sqrt(double(count)));
    for (size_t i = 0; i < count; ++i) {
        const float shade = 0.2f + 0.6f * float(i) / float(count);
        glb.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorFactor", {shade, 0.5, 1 - shade, 1}}}}});
        const size_t mesh = glb.landscape(10, int(i));
        glb.json["nodes"].push_back({{"mesh", mesh}, {"translation", {2.5f * float(i % side), 0, 2.5f * float(i / side)}}});
    }
    const size_t raw = glb.bytes.size();
    const std::string file = folder / "meshes.glb";
    if (const auto written = glb.write(file); !written) return {{"failed", written.error().text()}};
    Json figures = first_image(file, raw, folder, options);
    figures["meshes"] = count;
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
    figures["meshes_and_materials_2000"] = many_meshes(2000, folder, options);
    const auto mb = [&](const char* which) {
        return figures[which].value("peak_memory_mb", 0.0) - figures["nothing"].value("peak_memory_mb", 0.0);
    };
    figures["bytes_per_triangle"] = rounded(1e6 * (mb("triangles_10m") - mb("triangles_1m")) / 9e6);
    figures["bytes_per_instance"] = rounded(mb("instances_1m"));
    return figures;
}

} // namespace blush::bench
