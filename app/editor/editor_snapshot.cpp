#include "app/editor/editor_snapshot.h"

#include "app/commands/denoising.h"
#include "app/commands/render/film_json.h"
#include "app/commands/render/write_image.h"
#include "app/common/scene_overrides.h"
#include "app/common/unique_filename.h"
#include "io/image/display_image.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"
#include "render/film/coverage.h"
#include "render/film/crop.h"

#include <fmt/format.h>

namespace blush {
namespace {

// Relative to the image's folder, so that both can be moved together.
std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path relative = std::filesystem::relative(file, folder, error);
    return error || relative.empty() ? file.string() : relative.string();
}

// `denoised`: as displayed; null: none.
SnapshotMetadata metadata_of(const SnapshotJob& job, const std::filesystem::path& file, const DenoisedImage* denoised) {
    const Snapshot& s = job.snapshot;
    const Frame& f = *s.images.frame;
    SnapshotMetadata m;
    if (job.metadata) {
        m = *job.metadata;
        if (!s.scene_file.empty()) m.scene_file = seen_from(file.parent_path(), s.scene_file);
        m.name = s.name;
        m.note = s.note;
        m.film.clear();
        return m;
    }
    m.version = BLUSH_VERSION;
    m.scene = s.scene_file.filename().string();
    m.scene_file = seen_from(file.parent_path(), s.scene_file);
    m.scene_hash = scene_hash(s.imported);
    m.camera = camera_name(s.project.scene);
    m.spp = f.samples;
    m.first_sample = s.settings.first_sample;
    m.last_sample = s.settings.first_sample + f.samples;
    m.seed = s.settings.seed;
    m.seconds = f.seconds;
    m.error = error_text(f.error);
    m.settings = s.settings;
    m.edits = edits_json(s.imported, s.project.scene);
    m.view = s.project.view;
    m.name = s.name;
    m.note = s.note;
    m.partial = !f.complete;
    if (denoised) m.denoised = fmt::format("{}, {} spp", denoised_by(denoised->denoised), denoised->samples);
    return m;
}

// Crops to the camera's frame, without samples, which belong to the full size.
SnapshotJob cut_out(SnapshotJob job) {
    Snapshot& s = job.snapshot;
    const Frame& whole = *s.images.frame;
    s.error = cropped(s.error, whole.width, *s.frame);
    s.images.denoised = cropped(s.images.denoised, *s.frame);
    s.images.frame = std::make_shared<const Frame>(cropped(whole, *s.frame));
    s.film = nullptr;
    s.settings.width = s.images.frame->width;
    s.settings.height = s.images.frame->height;
    s.frame.reset();
    return job;
}

} // namespace

Result<SavedSnapshot> write_snapshot_exr(const SnapshotJob& job) {
    // With samples all pixels are saved; those outside the frame are overscan.
    if (job.snapshot.frame && !(job.film && job.snapshot.film)) return write_snapshot_exr(cut_out(job));
    const Result<std::filesystem::path> file =
        job.file.empty() ? unique_filename(job.folder, job.snapshot.scene_file.stem().string(), ".exr") : job.file;
    if (!file) return file.error();
    const Snapshot& s = job.snapshot;
    const Layers layers{.albedo = true, .normal = true, .depth = true, .error = true, .samples = true, .ids = true, .groups = true};
    const DenoisedImage* denoised = s.images.denoised.get();
    SnapshotMetadata metadata = metadata_of(job, *file, denoised);
    ExtraLayers extra{.error = s.error};
    extra.half = job.half;
    extra.display_window = s.frame;
    if (denoised) extra.denoised = denoised->denoised.rgb;
    std::vector<LosslessPlane> film;
    if (job.film && s.film) {
        film = planes_in_file(*s.film);
        metadata.film = film_json(*s.film);
    }
    extra.film = film;
    const Result<int64_t> count_beyond_half = write_exr_image(*file, *s.images.frame, extra, layers, metadata);
    if (!count_beyond_half) return count_beyond_half.error();
    return SavedSnapshot{*file, *count_beyond_half};
}

Result<SavedSnapshot> write_snapshot_png(const SnapshotJob& job, const ColorManagement& color) {
    if (job.snapshot.frame) return write_snapshot_png(cut_out(job), color);
    const auto file = unique_filename(job.folder, job.snapshot.scene_file.stem().string(), ".png");
    if (!file) return file.error();
    const Frame& frame = *job.snapshot.images.frame;
    const DenoisedImage* denoised = job.view.wants_denoised() ? job.snapshot.images.denoised.get() : nullptr;
    std::vector<float> shown = mixed_image(frame, denoised, mix_of(job.view, denoised != nullptr));
    const ViewSettings& view = job.snapshot.project.view;
    const std::vector<float> coverage = coverage_of(frame);
    const ViewSettings as_shown = settled(view, metered_exposure(view.auto_exposure, frame.rgba, 4));
    const auto written =
        write_through_view(*file, frame.width, frame.height, std::move(shown), color, as_shown,
                           display_metadata(metadata_of(job, *file, denoised)), {frame.albedo, coverage}, opacity_of(frame));
    if (!written) return written.error();
    return SavedSnapshot{*file, 0};
}

} // namespace blush
