#include "app/commands/opened_snapshot.h"

#include "app/commands/common.h"
#include "app/commands/render/film_json.h"
#include "io/project/scene_edits_json.h"
#include "io/project/scene_hash.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

std::vector<float> interleaved(const LayeredImage& image, const std::array<const char*, 3>& names) {
    std::vector<float> values;
    const LayeredImage::Channel* channels[3] = {image.find(names[0]), image.find(names[1]), image.find(names[2])};
    if (!channels[0] || !channels[1] || !channels[2]) return values;
    values.reserve(3 * channels[0]->values.size());
    for (size_t i = 0; i < channels[0]->values.size(); ++i)
        for (const LayeredImage::Channel* c : channels) values.push_back(c->values[i]);
    return values;
}

std::vector<Vec3> vectors(const LayeredImage& image, const std::array<const char*, 3>& names) {
    const std::vector<float> values = interleaved(image, names);
    std::vector<Vec3> result(values.size() / 3);
    for (size_t i = 0; i < result.size(); ++i) result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return result;
}

// From the float channels, if there are no exact sums.
Result<Frame> frame_from_layers(const LayeredImage& image, const SnapshotMetadata& m) {
    Frame f;
    f.width = image.width;
    f.height = image.height;
    const std::vector<float> rgb = interleaved(image, {"R", "G", "B"});
    if (rgb.empty()) return Error{.what = "the image has no channels R, G and B"};
    const LayeredImage::Channel* alpha = image.find("A");
    f.rgba.resize(rgb.size() / 3 * 4);
    for (size_t i = 0; i < rgb.size() / 3; ++i) {
        std::copy_n(&rgb[3 * i], 3, &f.rgba[4 * i]);
        f.rgba[4 * i + 3] = alpha ? alpha->values[i] : 1;
    }
    f.albedo = vectors(image, {"albedo.R", "albedo.G", "albedo.B"});
    f.normal = vectors(image, {"normal.X", "normal.Y", "normal.Z"});
    if (const auto* depth = image.find("depth.Z")) f.depth = depth->values;
    if (const auto* ids = image.find("id.object"); ids && ids->is_uint) f.object_id = ids->words;
    if (const auto* ids = image.find("id.material"); ids && ids->is_uint) f.material_id = ids->words;
    f.samples = m.spp;
    f.seconds = m.seconds;
    return f;
}

DenoisedPtr denoised_from_layer(const LayeredImage& image, const SnapshotMetadata& m, int64_t samples) {
    auto made = std::make_shared<DenoisedImage>();
    made->denoised.rgb = interleaved(image, {"denoised.R", "denoised.G", "denoised.B"});
    if (made->denoised.rgb.empty()) return nullptr;
    made->denoised.network = m.denoised;
    made->width = image.width;
    made->height = image.height;
    made->samples = samples;
    return made;
}

std::filesystem::path find_scene(const std::filesystem::path& file, const SnapshotMetadata& m, const std::filesystem::path& open_scene) {
    const std::filesystem::path folder = file.parent_path(), name = std::filesystem::path(m.scene).filename();
    std::error_code error;
    for (const std::filesystem::path& candidate : {folder / m.scene_file, folder / name, open_scene.filename() == name ? open_scene : ""})
        if (!candidate.empty() && std::filesystem::is_regular_file(candidate, error))
            return std::filesystem::weakly_canonical(candidate, error);
    return {};
}

} // namespace

Result<OpenedSnapshot> open_snapshot(const std::filesystem::path& file, const std::filesystem::path& open_scene) {
    Result<LayeredImage> image = read_layers(file);
    if (!image) return image.error();
    const Result<SnapshotMetadata> metadata = read_snapshot_metadata(image->metadata);
    if (!metadata) return in_file(metadata.error(), file.string());
    OpenedSnapshot opened{{}, *metadata};
    Snapshot& s = opened.snapshot;
    s.name = metadata->name.empty() ? file.stem().string() : metadata->name;
    s.note = metadata->note;
    s.settings = metadata->settings;
    s.file = file;
    if (const auto& frame = image->display_window)
        if (frame->x0 >= 0 && frame->y0 >= 0 && frame->x0 < frame->x1 && frame->y0 < frame->y1 && frame->x1 <= image->width &&
            frame->y1 <= image->height)
            s.frame = frame;
    s.scene_file = find_scene(file, *metadata, open_scene);
    Result<Frame> frame = frame_from_layers(*image, *metadata);
    if (Result<FilmState> film = film_in_file(*image, *metadata); film) {
        if (Result<ResolvedFilm> resolved = resolve_film(*film, s.settings); resolved) {
            frame = std::move(resolved->frame);
            s.error = std::move(resolved->error);
            s.film = std::make_shared<const FilmState>(*std::move(film));
        }
    }
    if (!frame) return in_file(frame.error(), file.string());
    s.images.denoised = denoised_from_layer(*image, *metadata, frame->samples);
    s.images.frame = std::make_shared<const Frame>(*std::move(frame));
    if (s.scene_file.empty())
        s.no_state = fmt::format("Its scene file {} was not found at its old path or beside the image.", metadata->scene);
    return opened;
}

Result<SnapshotState> state_of(const SnapshotMetadata& m, const Scene& imported, const std::filesystem::path& scene_file) {
    Result<Scene> scene = m.edits.empty() ? Result<Scene>(imported) : apply_edits_json(imported, m.edits, scene_file.parent_path());
    if (!scene) return scene.error();
    SnapshotState state{{*std::move(scene), m.settings, m.view.value_or(ViewSettings{})}, {}};
    if (scene_hash(imported) != m.scene_hash)
        state.warning =
            fmt::format("{} has changed since the snapshot: the edits were applied to the new file, and it is rendered from the start.",
                        scene_file.filename().string());
    else if (count_left_out(m.edits) > 0)
        state.warning = "Some edits, such as added objects, are not stored in the snapshot. The others were restored, and it is rendered "
                        "from the start.";
    return state;
}

} // namespace blush
