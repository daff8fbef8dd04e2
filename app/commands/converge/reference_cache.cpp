#include "app/commands/converge/reference_cache.h"

#include "core/files.h"
#include "io/image/snapshot.h"
#include "io/project/scene_hash.h"
#include "io/project/settings_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr const char* key_attribute = "blush:reference";

// 64-bit FNV-1a (Fowler, Noll, Vo) for the file name; the key itself is stored in the file.
std::string short_name(const std::string& key) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (const unsigned char c : key) hash = (hash ^ c) * 0x100000001b3u;
    return fmt::format("{:016x}.exr", hash);
}

std::vector<Vec3> vectors(const LayeredImage& image, const std::string& layer) {
    const auto [r, g, b] = image.find_color(layer);
    std::vector<Vec3> values;
    if (!r) return values;
    for (size_t i = 0; i < r->values.size(); ++i) values.push_back({r->values[i], g->values[i], b->values[i]});
    return values;
}

bool all_finite(const std::vector<Vec3>& values) {
    return std::ranges::all_of(values, [](const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); });
}

// Without an error layer, the reference's own error is assumed to be zero.
Reference reference_of(const LayeredImage& image) {
    Reference r;
    r.measured.image = {image.width, image.height, vectors(image, "")};
    r.measured.error = vectors(image, "error");
    r.measured.error.resize(r.measured.image.pixels.size(), {0, 0, 0});
    r.measured.samples = 1;
    if (const Result<SnapshotMetadata> m = read_snapshot_metadata(image.metadata)) {
        r.measured.samples = std::max<int64_t>(1, m->spp);
        r.first_sample = m->first_sample;
        r.seed = m->seed;
        r.seconds = m->seconds;
    }
    return r;
}

void remove_oldest(const std::filesystem::path& folder, uint64_t max_bytes) {
    struct Entry {
        std::filesystem::path path;
        std::filesystem::file_time_type used;
        uint64_t bytes;
    };
    std::vector<Entry> entries;
    std::error_code code;
    for (const auto& file : std::filesystem::directory_iterator(folder, code))
        if (file.path().extension() == ".exr" && file.is_regular_file(code))
            entries.push_back({file.path(), file.last_write_time(code), file.file_size(code)});
    std::ranges::sort(entries, std::greater(), &Entry::used);
    uint64_t total = 0;
    for (const Entry& e : entries)
        if ((total += e.bytes) > max_bytes) std::filesystem::remove(e.path, code);
}

} // namespace

std::filesystem::path reference_folder() {
    const auto folder = user_folder("XDG_CACHE_HOME", ".cache");
    return folder.empty() ? folder : folder / "blush" / "references";
}

std::string reference_key(const Scene& scene, const RenderSettings& settings) {
    const View& v = scene.view;
    const Quat& q = v.rotation;
    const Lens& l = v.lens;
    return fmt::format("{} view {} {} {} {} {} {} {} lens {} {} {} {} {} settings {}", scene_hash(scene), v.position.x, v.position.y,
                       v.position.z, q.x, q.y, q.z, q.w, l.orthographic, l.yfov_radians, l.ymag, l.aperture_radius, l.focus_distance,
                       render_settings_json(reference_settings(settings)));
}

std::optional<Reference> cached_reference(const std::filesystem::path& folder, const std::string& key, std::span<const uint32_t> compared) {
    if (folder.empty()) return std::nullopt;
    const std::filesystem::path file = folder / short_name(key);
    std::error_code code;
    if (!std::filesystem::exists(file, code)) return std::nullopt;
    const Result<LayeredImage> image = read_layers(file);
    if (!image) return std::nullopt;
    const auto stored = image->metadata.find(key_attribute);
    if (stored == image->metadata.end() || stored->second != key) return std::nullopt;
    Reference r = reference_of(*image);
    const bool whole =
        image->find("error.R") && !r.measured.image.pixels.empty() && all_finite(r.measured.image.pixels) && all_finite(r.measured.error);
    if (!whole || std::ranges::find(compared, r.seed) != compared.end()) return std::nullopt;
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), code);
    return r;
}

Result<void> cache_reference(const std::filesystem::path& folder, const std::string& key, const Reference& reference, uint64_t max_bytes) {
    if (folder.empty()) return {};
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (code) return Error{.file = folder.string(), .what = "cannot be created: " + code.message()};
    const MeasuredImage& m = reference.measured;
    std::vector<float> rgba;
    rgba.reserve(4 * m.image.pixels.size());
    for (const Vec3& p : m.image.pixels) rgba.insert(rgba.end(), {p.x, p.y, p.z, 1.f});
    SnapshotInput input;
    input.width = m.image.width;
    input.height = m.image.height;
    input.rgba = rgba;
    input.error = m.error;
    input.metadata.version = BLUSH_VERSION;
    input.metadata.spp = m.samples;
    input.metadata.first_sample = reference.first_sample;
    input.metadata.last_sample = reference.first_sample + m.samples;
    input.metadata.seed = reference.seed;
    input.metadata.seconds = reference.seconds;
    Result<LayeredImage> image = make_snapshot(input);
    if (!image) return image.error();
    image->metadata[key_attribute] = key;
    if (Result<void> written = write_exr(folder / short_name(key), *image); !written) return written;
    remove_oldest(folder, max_bytes);
    return {};
}

Result<Reference> read_reference_file(const std::filesystem::path& file, int width, int height) {
    const Result<LayeredImage> image = read_layers(file);
    if (!image) return image.error();
    Reference r = reference_of(*image);
    if (r.measured.image.pixels.empty()) return Error{.file = file.string(), .what = "a reference must be an EXR with channels R, G and B"};
    if (image->width != width || image->height != height)
        return Error{
            .file = file.string(),
            .what = fmt::format("the reference has {}x{} pixels, but the images have {}x{}", image->width, image->height, width, height)};
    if (!all_finite(r.measured.image.pixels) || !all_finite(r.measured.error))
        return Error{.file = file.string(), .what = "the reference has non-finite values"};
    return r;
}

} // namespace blush
