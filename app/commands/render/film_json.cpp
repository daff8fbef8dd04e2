#include "app/commands/render/film_json.h"

#include "core/hash64.h"
#include "io/image/lossless_channels.h"
#include "io/project/json_fields.h"
#include "render/diagnostics/health_recorder.h"
#include "render/light_mix/light_groups.h"
#include "render/pilots/reuse_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace blush {
namespace {

constexpr int64_t max_samples = int64_t(1) << 40; // per pixel; above any real render, and far below integer overflow
constexpr const char* dropped_plane = "dropped";
constexpr std::array pilot_planes{"pilot.even.R", "pilot.even.G", "pilot.even.B", "pilot.odd.R", "pilot.odd.G", "pilot.odd.B"};
constexpr double Vec3d::*channels[3] = {&Vec3d::x, &Vec3d::y, &Vec3d::z};

// Reads an array with exactly these numbers.
template <class... T> bool read_numbers(const Json& json, T&... numbers) {
    if (!json.is_array() || json.size() != sizeof...(T)) return false;
    size_t i = 0;
    return (read_json(json[i++], numbers) && ...);
}
template <class E> bool as_enum(int number, int count, E& value) {
    value = E(number);
    return number >= 0 && number < count;
}
const Json& member(const Json& object, const char* key) {
    static const Json null;
    const auto it = object.find(key);
    return it == object.end() ? null : *it;
}
// Calls read(item, value) for each item of an array, which must not have more than `most` items.
template <class T, class Read> bool read_list(const Json& json, size_t most, std::vector<T>& list, const Read& read) {
    if (!json.is_array() || json.size() > most) return false;
    list.resize(json.size());
    for (size_t i = 0; i < list.size(); ++i)
        if (!read(json[i], list[i])) return false;
    return true;
}

Json film_health_json(const Health& h) {
    Json faults = Json::array(), first = Json::array(), fireflies = Json::array();
    for (int kind = 0; kind < Fault::kinds; ++kind)
        for (int place = 0; place < Fault::places; ++place)
            if (const int64_t count = h.count(Fault::Kind(kind), Fault::Place(place)); count > 0) faults.push_back({kind, place, count});
    for (const BadSample& s : h.first)
        first.push_back({int(s.cause), s.x, s.y, s.sample, s.seed, int(s.fault.kind), int(s.fault.place), s.fault.vertex});
    for (const Firefly& s : h.fireflies) fireflies.push_back({s.excess, s.luminance, s.x, s.y, s.sample, s.seed});
    return {{"dropped", {h.nan, h.infinite, h.negative}}, {"faults", faults}, {"first", first}, {"fireflies", fireflies}};
}

bool read_health(const Json& json, const LayeredImage& image, Health& h) {
    const auto inside = [&](int x, int y) { return x >= 0 && x < image.width && y >= 0 && y < image.height; };
    struct Count {
        int kind = 0, place = 0;
        int64_t count = 0;
    };
    std::vector<Count> faults;
    const bool read = json.is_object() && read_numbers(member(json, "dropped"), h.nan, h.infinite, h.negative) &&
                      read_list(member(json, "faults"), size_t(Fault::kinds) * Fault::places, faults,
                                [](const Json& item, Count& c) {
                                    return read_numbers(item, c.kind, c.place, c.count) && c.kind >= 0 && c.kind < Fault::kinds &&
                                           c.place >= 0 && c.place < Fault::places;
                                }) &&
                      read_list(member(json, "first"), HealthRecorder::remembered, h.first,
                                [&](const Json& item, BadSample& s) {
                                    int cause = 0, kind = 0, place = 0;
                                    return read_numbers(item, cause, s.x, s.y, s.sample, s.seed, kind, place, s.fault.vertex) &&
                                           inside(s.x, s.y) && as_enum(cause, 3, s.cause) && as_enum(kind, Fault::kinds, s.fault.kind) &&
                                           as_enum(place, Fault::places, s.fault.place);
                                }) &&
                      read_list(member(json, "fireflies"), HealthRecorder::remembered, h.fireflies, [&](const Json& item, Firefly& s) {
                          return read_numbers(item, s.excess, s.luminance, s.x, s.y, s.sample, s.seed) && inside(s.x, s.y);
                      });
    for (const Count& c : faults) h.faults[size_t(c.kind)][size_t(c.place)] = c.count;
    return read;
}

bool in_range(int64_t n, int64_t least) { return n >= least && n <= max_samples; }

bool read_passes(const Json& json, std::array<int64_t, 2>& passes) {
    return read_numbers(json, passes[0], passes[1]) && in_range(passes[0], 0) && in_range(passes[1], 0) && passes[0] + passes[1] > 0;
}

bool read_mix(const Json& json, std::vector<FilmState::MixedGroup>& mix) {
    return read_list(json, max_light_groups, mix, [](const Json& item, FilmState::MixedGroup& g) {
        const auto is_gain = [](float v) { return std::isfinite(v) && v >= 0; };
        return read_numbers(item, g.name, g.gain.x, g.gain.y, g.gain.z) && is_gain(g.gain.x) && is_gain(g.gain.y) && is_gain(g.gain.z);
    });
}

bool read_highlights(const Json& json, SmallHighlights& highlights) {
    struct Saved {
        size_t band = 0;
        SmallHighlights::Band of;
    };
    std::vector<Saved> bands;
    const auto is_size = [](double v) { return std::isfinite(v) && v >= 0; };
    const bool read = read_list(json, highlights.bands.size(), bands, [&](const Json& item, Saved& s) {
        Vec3d& sum = s.of.sum;
        return read_numbers(item, s.band, s.of.rate, sum.x, sum.y, sum.z) && s.band < highlights.bands.size() && is_size(s.of.rate) &&
               is_size(sum.x) && is_size(sum.y) && is_size(sum.z);
    });
    for (const Saved& s : bands) highlights.bands[s.band] = s.of;
    return read;
}

// Extracts the planes that are not part of the film itself.
void take_health_map(FilmState& film, size_t pixels) {
    if (const LosslessPlane* dropped = film.find(dropped_plane)) film.health.dropped_map = dropped->words;
    if (!film.health.dropped_map.empty()) film.health.dropped_map.resize(pixels);
    std::erase_if(film.planes, [](const LosslessPlane& plane) { return plane.name == dropped_plane; });
}

void take_pilot(FilmState& film, size_t pixels) {
    std::vector<Vec3d> marked(2 * pixels);
    bool all = true;
    for (size_t k = 0; k < pilot_planes.size(); ++k) {
        const LosslessPlane* plane = film.find(pilot_planes[k]);
        all = all && plane && plane->sums.size() == pixels;
        for (size_t i = 0; all && i < pixels; ++i) marked[2 * i + k / 3].*channels[k % 3] = plane->sums[i];
    }
    if (all) film.marked = std::move(marked);
    std::erase_if(film.planes, [](const LosslessPlane& plane) { return plane.name.starts_with("pilot."); });
}

std::vector<LosslessPlane> planes_beside_film(const FilmState& film) {
    std::vector<LosslessPlane> planes;
    if (!film.health.dropped_map.empty()) planes.push_back({dropped_plane, {}, film.health.dropped_map});
    for (size_t k = 0; k < pilot_planes.size() && !film.marked.empty(); ++k) {
        LosslessPlane plane{pilot_planes[k]};
        for (size_t i = 0; i < film.marked.size() / 2; ++i) plane.sums.push_back(film.marked[2 * i + k / 3].*channels[k % 3]);
        planes.push_back(std::move(plane));
    }
    return planes;
}

// Of all samples: a flipped bit in a file changes it.
std::string checksum(const FilmState& film, std::span<const LosslessPlane> beside) {
    Hash64 hash;
    for (const int64_t number : {film.first_sample, film.samples, film.passes[0], film.passes[1]}) hash.word(uint64_t(number));
    std::vector<const LosslessPlane*> sorted; // channels of a file have another order
    for (const std::span<const LosslessPlane> planes : {std::span(film.planes), beside})
        for (const LosslessPlane& plane : planes) sorted.push_back(&plane);
    std::ranges::sort(sorted, {}, &LosslessPlane::name);
    for (const LosslessPlane* plane : sorted) {
        hash.array(plane->name);
        hash.array(plane->sums);
        hash.array(plane->words);
        hash.array(plane->low);
    }
    return fmt::format("{:016x}", hash.value());
}

} // namespace

std::vector<LosslessPlane> planes_in_file(const FilmState& film) {
    std::vector<LosslessPlane> planes = film.planes;
    for (LosslessPlane& plane : planes_beside_film(film)) planes.push_back(std::move(plane));
    return planes;
}

std::string film_json(const FilmState& film) {
    Json paths = Json::array(), highlights = Json::array();
    for (const PathCounts& c : film.path_counts) paths.push_back({c.alive, c.rr_applied, c.survived});
    Json json{{"first_sample", film.first_sample},
              {"samples", film.samples},
              {"seconds", film.seconds},
              {"rays", {film.rays.camera, film.rays.bounce, film.rays.shadow}},
              {"truncated", film.truncated},
              {"paths", paths},
              {"health", film_health_json(film.health)}};
    for (const FilmState::MixedGroup& g : film.mix) json["mix"].push_back({g.name, g.gain.x, g.gain.y, g.gain.z});
    if (!film.shares[0].empty()) json["shares"] = {film.shares[0], film.shares[1]};
    if (film_size(film).light_paths) json["passes"] = {film.passes[0], film.passes[1]};
    if (const auto& p = film.reuse_pilot) json["reuse_pilot"] = {p->mse, p->relmse, p->typical, p->work, p->group_size};
    if (film.highlights)
        for (size_t k = 0; k < film.highlights->bands.size(); ++k)
            if (const auto& [rate, sum] = film.highlights->bands[k]; rate > 0) highlights.push_back({k, rate, sum.x, sum.y, sum.z});
    if (film.highlights) json["highlights"] = std::move(highlights);
    if (film.first_sample == 0 && film.samples == 1 && !film.first_is_rough) json["first"] = "complete";
    json["checksum"] = checksum(film, planes_beside_film(film));
    return json_text(json);
}

Result<FilmState> film_in_file(LayeredImage& image, const SnapshotMetadata& metadata) {
    if (metadata.film.empty()) return Error{"", "the image was saved without the samples: it cannot be resumed", ""};
    const Result<Json> json = parse_json_object(metadata.film);
    if (!json) return Error{"", json.error().what, "blush:film"};
    const auto bad = [](const char* key) { return Error{"", "invalid film state", fmt::format("blush:film {}", key)}; };
    FilmState film;
    film.width = image.width;
    film.height = image.height;
    if (!read_json(member(*json, "first_sample"), film.first_sample) || !in_range(film.first_sample, 0)) return bad("first_sample");
    if (!read_json(member(*json, "samples"), film.samples) || !in_range(film.samples, 1)) return bad("samples");
    if (!read_json(member(*json, "seconds"), film.seconds) || film.seconds < 0) return bad("seconds");
    if (!read_numbers(member(*json, "rays"), film.rays.camera, film.rays.bounce, film.rays.shadow)) return bad("rays");
    if (!read_json(member(*json, "truncated"), film.truncated)) return bad("truncated");
    if (!read_list(member(*json, "paths"), max_counted_bounces, film.path_counts,
                   [](const Json& item, PathCounts& c) { return read_numbers(item, c.alive, c.rr_applied, c.survived); }))
        return bad("paths");
    if (!read_health(member(*json, "health"), image, film.health)) return bad("health");
    if (const Json& shares = member(*json, "shares"); !shares.is_null()) {
        const size_t pixels = size_t(image.width) * size_t(image.height); // upper bound of the number of tiles
        if (!shares.is_array() || shares.size() != 2) return bad("shares");
        for (size_t half = 0; half < 2; ++half)
            if (!read_list(shares[half], pixels, film.shares[half], [](const Json& item, double& share) { return read_json(item, share); }))
                return bad("shares");
    }
    if (const Json& pilot = member(*json, "reuse_pilot"); !pilot.is_null()) {
        PilotFigures& p = film.reuse_pilot.emplace();
        if (!read_numbers(pilot, p.mse, p.relmse, p.typical, p.work, p.group_size) ||
            !(std::min({p.mse, p.relmse, p.typical, p.work}) > 0) ||
            std::ranges::find(automatic_group_sizes, p.group_size) == automatic_group_sizes.end())
            return bad("reuse_pilot");
    }
    if (const Json& bands = member(*json, "highlights"); !bands.is_null() && !read_highlights(bands, film.highlights.emplace()))
        return bad("highlights");
    // Older versions do not say so: theirs always is.
    film.first_is_rough = film.first_sample == 0 && film.samples == 1 && member(*json, "first") != "complete";
    if (const Json& mix = member(*json, "mix"); !mix.is_null() && !read_mix(mix, film.mix)) return bad("mix");
    film.planes = take_lossless_planes(image, "film");
    // Without any pass the splats would be left out of the image.
    if (const Json& passes = member(*json, "passes");
        film_size(film).light_paths != !passes.is_null() || (!passes.is_null() && !read_passes(passes, film.passes)))
        return bad("passes");
    if (const Json& sum = member(*json, "checksum"); !sum.is_null() && sum != checksum(film, {}))
        return Error{"", "the samples are damaged: their checksum differs", "blush:film checksum"};
    const size_t pixels = size_t(image.width) * size_t(image.height);
    take_health_map(film, pixels);
    take_pilot(film, pixels);
    return film;
}

} // namespace blush
