#include "app/editor_snapshot.h"

#include "app/scene_overrides.h"
#include "io/scene_edits_json.h"
#include "io/scene_hash.h"
#include "io/snapshot.h"

#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

// FOLDER/SCENE-0001.exr with the first number that is free.
Result<std::filesystem::path> free_name(const SnapshotJob& job, const char* extension) {
    std::error_code error;
    const std::filesystem::path folder = job.folder.empty() ? std::filesystem::current_path(error) : job.folder;
    std::filesystem::create_directories(folder, error);
    if (error) return Error{folder.string(), "cannot make the folder: " + error.message(), ""};
    for (int number = 1; number < 100000; ++number) {
        const auto file = folder / fmt::format("{}-{:04}{}", job.scene_file.stem().string(), number, extension);
        if (!std::filesystem::exists(file, error)) return file;
    }
    return Error{folder.string(), "the folder is full of snapshots", ""};
}

SnapshotMetadata metadata_of(const SnapshotJob& job) {
    const Frame& f = *job.frame;
    SnapshotMetadata m;
    m.version = BLUSH_VERSION;
    m.scene = job.scene_file.filename().string();
    m.scene_hash = scene_hash(job.imported);
    m.camera = camera_name(job.project.scene);
    m.spp = f.samples;
    m.first_sample = job.settings.first_sample;
    m.last_sample = job.settings.first_sample + f.samples;
    m.seed = job.settings.seed;
    m.seconds = f.seconds;
    if (f.error.known) m.error = fmt::format("{:.6g}", f.error.relmse);
    m.settings = job.settings;
    m.edits = edits_json(job.imported, job.project.scene);
    m.partial = !f.complete;
    return m;
}

} // namespace

Result<std::filesystem::path> write_snapshot_exr(const SnapshotJob& job) {
    const Frame& f = *job.frame;
    const std::vector<float> samples(size_t(f.width) * size_t(f.height), float(f.samples));
    SnapshotInput input;
    input.width = f.width;
    input.height = f.height;
    input.rgba = f.rgba;
    input.albedo = f.albedo;
    input.normal = f.normal;
    input.depth = f.depth;
    input.samples = samples;
    input.object_id = f.object_id;
    input.material_id = f.material_id;
    input.metadata = metadata_of(job);
    const auto image = make_snapshot(input);
    if (!image) return image.error();
    const auto file = free_name(job, ".exr");
    if (!file) return file;
    if (const auto written = write_exr(*file, *image); !written) return written.error();
    return file;
}

Result<std::filesystem::path> write_snapshot_png(const SnapshotJob& job, const ColorManagement& color) {
    const Frame& f = *job.frame;
    const size_t pixels = size_t(f.width) * size_t(f.height);
    std::vector<float> rgb(pixels * 3);
    for (size_t i = 0; i < pixels; ++i) {
        for (size_t k = 0; k < 3; ++k) rgb[3 * i + k] = f.rgba[4 * i + k];
    }
    const ViewSettings& v = job.project.view;
    if (const auto done = color.apply_display(v.display, v.view, v.exposure_ev, v.gamma, rgb.data(), pixels); !done) return done.error();
    const auto file = free_name(job, ".png");
    if (!file) return file;
    if (const auto written = write_display_image(*file, f.width, f.height, rgb); !written) return written.error();
    return file;
}

} // namespace blush
