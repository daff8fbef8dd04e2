#include "app/editor_snapshot.h"

#include "app/commands/denoising.h"
#include "app/commands/picture.h"
#include "app/free_name.h"
#include "app/scene_overrides.h"
#include "io/displayed.h"
#include "io/scene_edits_json.h"
#include "io/scene_hash.h"
#include "render/coverage.h"

#include <fmt/format.h>

namespace blush {
namespace {

// `denoised`: what the picture shows of it; null: nothing.
SnapshotMetadata metadata_of(const SnapshotJob& job, const DenoisedPicture* denoised) {
    const Frame& f = *job.pictures.frame;
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
    if (denoised) m.denoised = fmt::format("{}, {} spp", denoised_by(denoised->denoised), denoised->samples);
    return m;
}

} // namespace

Result<std::filesystem::path> write_snapshot_exr(const SnapshotJob& job) {
    const auto file = free_name(job.folder, job.scene_file.stem().string(), ".exr");
    if (!file) return file;
    const Layers layers{.albedo = true, .normal = true, .depth = true, .samples = true, .ids = true};
    // A coarse one, of the moment after an edit, is no layer.
    const DenoisedPicture* denoised = job.pictures.denoised.get();
    if (denoised && denoised->divider != 1) denoised = nullptr;
    ExtraLayers extra;
    if (denoised) extra.denoised = denoised->denoised.rgb;
    const auto written = write_exr_picture(*file, *job.pictures.frame, extra, layers, metadata_of(job, denoised));
    if (!written) return written.error();
    return file;
}

Result<std::filesystem::path> write_snapshot_png(const SnapshotJob& job, const ColorManagement& color) {
    const auto file = free_name(job.folder, job.scene_file.stem().string(), ".png");
    if (!file) return file;
    const Frame& frame = *job.pictures.frame;
    const DenoisedPicture* denoised = job.view.wants_denoised() ? job.pictures.denoised.get() : nullptr;
    std::vector<float> shown = mixed_picture(frame, denoised, mix_of(job.view, denoised != nullptr));
    const ViewSettings& view = job.project.view;
    const std::vector<float> coverage = coverage_of(frame);
    const ViewSettings as_shown = settled(view, metered_exposure(view.auto_exposure, frame.rgba, 4));
    const auto written = write_display_picture(*file, frame.width, frame.height, std::move(shown), color, as_shown,
                                               display_metadata(metadata_of(job, denoised)), {frame.albedo, coverage});
    if (!written) return written.error();
    return file;
}

} // namespace blush
