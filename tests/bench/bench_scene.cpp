#include "tests/bench/bench_scene.h"

#include "io/gltf/read/import.h"

#include <algorithm>

namespace blush::bench {
namespace {

Result<std::vector<BenchScene>> load_all(const std::vector<std::filesystem::path>& files, bool ours) {
    std::vector<BenchScene> scenes;
    for (const auto& file : files) {
        Result<ImportedScene> imported = import_gltf(file);
        if (!imported) return imported.error();
        scenes.push_back({file, std::move(imported->scene), ours});
    }
    return scenes;
}

} // namespace

Result<std::vector<BenchScene>> shipped_scenes() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(BLUSH_ASSETS) / "scenes"))
        if (entry.path().extension() == ".gltf") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return load_all(files, true);
}

Result<std::vector<BenchScene>> peer_scenes(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const char* name : {"cornell.glb", "cornell_spheres.glb", "dense_cornell.glb"})
        if (std::filesystem::exists(folder / name)) files.push_back(folder / name);
    return load_all(files, false);
}

RenderSettings rate_settings() {
    RenderSettings settings;
    settings.width = settings.height = 512;
    settings.filter = PixelFilter::box;
    return settings;
}

RenderSettings window_settings() {
    RenderSettings settings = recommended_settings();
    settings.width = 1280;
    settings.height = 720;
    settings.spp = 0;
    return settings;
}

} // namespace blush::bench
