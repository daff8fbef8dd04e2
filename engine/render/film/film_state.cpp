#include "render/film/film_state.h"

#include "render/compile/expanded_lights.h"
#include "render/error/reuse_covariance.h"
#include "render/film/film_planes.h"
#include "render/light_mix/light_groups.h"
#include "render/pilots/reuse_choice.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <type_traits>
#include <utility>

namespace blush {
namespace {

template <class At> using ValueOf = std::remove_cvref_t<std::invoke_result_t<At, size_t>>;

// Depth is stored like a sum: every float is exact as a double.
template <class T> constexpr bool is_exact = std::is_same_v<T, ExactSum>;
template <class T> constexpr bool is_sum = std::is_floating_point_v<T> || is_exact<T>;

void add(ExactSum& sum, const ExactSum& more) { sum.add(more); }
template <class T> void add(T& sum, T more) { sum += more; }

// A pixel's value in a plane of the right size. Films of older versions have sums without low bins.
template <class T> T value_in(const LosslessPlane& plane, size_t pixel) {
    if constexpr (is_exact<T>)
        return plane.low.empty() ? ExactSum::of(plane.sums[pixel]) : ExactSum::of(plane.sums[pixel], plane.low[pixel]);
    else if constexpr (is_sum<T>)
        return T(plane.sums[pixel]);
    else
        return T(plane.words[pixel]);
}

template <class T> void set_value(LosslessPlane& plane, size_t pixel, const T& value) {
    if constexpr (is_exact<T>) {
        plane.sums[pixel] = value.high();
        plane.low[pixel] = value.biased_low();
    } else if constexpr (is_sum<T>)
        plane.sums[pixel] = double(value);
    else
        plane.words[pixel] = uint32_t(value);
}

template <class T> LosslessPlane empty_plane(const std::string& name, size_t pixels) {
    LosslessPlane plane{name};
    if constexpr (is_sum<T>)
        plane.sums.resize(pixels);
    else
        plane.words.resize(pixels);
    if constexpr (is_exact<T>) plane.low.resize(pixels, ExactSum().biased_low());
    return plane;
}

const LosslessPlane* find_plane(const std::vector<LosslessPlane>& planes, std::string_view name) {
    const auto it = std::ranges::find(planes, name, &LosslessPlane::name);
    return it == planes.end() ? nullptr : &*it;
}

bool has_light_paths(const FilmState& state) { return find_plane(state.planes, FilmPlanes::splat_name(0) + ".R") != nullptr; }

// Error if the state lacks a plane of the film or has another size.
std::optional<Error> find_mismatch(const Film& film, const FilmState& state) {
    if (state.width != film.width() || state.height != film.height())
        return Error{"",
                     fmt::format("saved samples of {} x {} pixels do not fit an image of {} x {}", state.width, state.height, film.width(),
                                 film.height()),
                     ""};
    if (has_light_paths(state) != film.has_light_paths())
        return Error{"",
                     fmt::format("saved samples {} light paths do not fit an image {} them", has_light_paths(state) ? "with" : "without",
                                 film.has_light_paths() ? "with" : "without"),
                     ""};
    const size_t pixels = size_t(state.width) * size_t(state.height);
    std::optional<Error> error;
    FilmPlanes::visit(film, [&](const std::string& name, Combine, const auto& at) {
        const LosslessPlane* plane = find_plane(state.planes, name);
        const bool there = plane && (is_sum<ValueOf<decltype(at)>> ? plane->sums.size() : plane->words.size()) == pixels &&
                           (plane->low.empty() || plane->low.size() == pixels);
        if (!there && !error) error = Error{"", fmt::format("the saved samples lack the plane \"{}\"", name), ""};
    });
    return error;
}

// take(old value, value in the state, pixel, combine) for each number of the film.
template <class Take> void for_each_value(Film& film, const FilmState& state, const Take& take) {
    const size_t pixels = size_t(state.width) * size_t(state.height);
    FilmPlanes::visit(film, [&](const std::string& name, Combine combine, const auto& at) {
        using T = ValueOf<decltype(at)>;
        const LosslessPlane& plane = *find_plane(state.planes, name);
        for (size_t i = 0; i < pixels; ++i) take(at(i), value_in<T>(plane, i), i, combine);
    });
}

} // namespace

const LosslessPlane* FilmState::find(std::string_view name) const { return find_plane(planes, name); }
LosslessPlane* FilmState::find(std::string_view name) { return const_cast<LosslessPlane*>(find_plane(planes, name)); }

FilmState save_film(const Film& film) {
    FilmState state;
    state.width = film.width();
    state.height = film.height();
    const size_t pixels = size_t(state.width) * size_t(state.height);
    FilmPlanes::visit(film, [&](const std::string& name, Combine, const auto& at) {
        LosslessPlane plane = empty_plane<ValueOf<decltype(at)>>(name, pixels);
        for (size_t i = 0; i < pixels; ++i) set_value(plane, i, at(i));
        state.planes.push_back(std::move(plane));
    });
    state.passes = film.passes();
    state.health = film.health();
    return state;
}

Result<void> load_film(Film& film, const FilmState& state) {
    if (const auto error = find_mismatch(film, state)) return *error;
    for_each_value(film, state, [](auto& number, auto value, size_t, Combine) { number = value; });
    film.set_passes(state.passes);
    film.restore_health(state.health);
    return {};
}

Result<void> add_film(Film& film, const FilmState& more) {
    if (const auto error = find_mismatch(film, more)) return *error;
    std::vector<bool> seen(size_t(more.width) * size_t(more.height));
    for (size_t i = 0; i < seen.size(); ++i) seen[i] = film.has_samples(i);
    for_each_value(film, more, [&](auto& number, auto value, size_t pixel, Combine combine) {
        if (combine == Combine::add)
            add(number, value);
        else if (!seen[pixel])
            number = value;
    });
    film.set_passes({film.passes()[0] + more.passes[0], film.passes()[1] + more.passes[1]});
    film.restore_health(HealthRecorder::merged(film.health(), more.health));
    return {};
}

namespace {

// Scales the planes of groups, and makes the plane of their sum `whole` anew.
template <class GroupName>
void scale_planes(FilmState& state, std::span<const Vec3> factors, const std::string& whole, const GroupName& group_name) {
    const std::array<std::pair<const char*, float Vec3::*>, 3> channels{{{".R", &Vec3::x}, {".G", &Vec3::y}, {".B", &Vec3::z}}};
    for (const auto& [name, channel] : channels) {
        LosslessPlane& plane = *state.find(whole + name);
        const size_t pixels = plane.sums.size();
        plane = empty_plane<ExactSum>(plane.name, pixels);
        for (size_t k = 0; k < factors.size(); ++k) {
            LosslessPlane& group = *state.find(group_name(k) + name);
            const LosslessPlane before = std::exchange(group, empty_plane<ExactSum>(group.name, pixels));
            for (size_t i = 0; i < pixels; ++i) {
                const auto scaled = ExactSum::of(value_in<ExactSum>(before, i).value() * double(factors[k].*channel));
                set_value(group, i, scaled);
                ExactSum sum = value_in<ExactSum>(plane, i);
                sum.add(scaled);
                set_value(plane, i, sum);
            }
        }
    }
}

} // namespace

void scale_groups(FilmState& state, std::span<const Vec3> factors) {
    for (int half = 0; half < 2; ++half) {
        scale_planes(state, factors, FilmPlanes::half_name(half), [&](size_t k) { return FilmPlanes::group_name(k, half); });
        if (has_light_paths(state))
            scale_planes(state, factors, FilmPlanes::splat_name(half), [&](size_t k) { return FilmPlanes::splat_group_name(k, half); });
    }
}

FilmSize film_size(const FilmState& state) {
    FilmSize size{.width = state.width, .height = state.height};
    const auto has = [&](const std::string& name) { return state.find(name) || state.find("even." + name); };
    size.planes.albedo = size.planes.normal = has("albedo.R");
    size.planes.depth = has("depth");
    size.planes.ids = has("object");
    size.planes.roulette = has("paths.R");
    size.planes.strategies = has(FilmPlanes::strategy_name(0, 0) + ".R");
    while (size.planes.bounces < max_bounce_planes && has(fmt::format("bounce.{}.R", size.planes.bounces))) ++size.planes.bounces;
    while (size.groups < max_light_groups && has(FilmPlanes::group_name(size_t(size.groups), 0) + ".R")) ++size.groups;
    size.transparent = has("covered");
    size.catches = has("caught.unoccluded");
    size.light_paths = has_light_paths(state);
    return size;
}

Result<void> load_new_film(Film& film, const FilmState& state, const RenderSettings& settings, bool half_difference) {
    if (state.width < 1 || state.height < 1 || state.samples < 1) return Error{"", "there are no samples", ""};
    FilmSize size = film_size(state);
    size.adaptive = settings.adaptive;
    size.planes.half_difference = half_difference;
    try {
        film.reset(size, settings.clamp);
    } catch (const std::exception& e) { return Error{"", e.what(), ""}; }
    return load_film(film, state);
}

Result<ResolvedFilm> resolve_film(const FilmState& state, const RenderSettings& settings, unsigned threads, bool half_difference) {
    Film film;
    if (const auto loaded = load_new_film(film, state, settings, half_difference); !loaded) return loaded.error();
    // Saved ids are ids; a frame stores table indices + 1.
    ResolvedFilm resolved;
    Frame& frame = resolved.frame;
    if (int(state.mix.size()) == film.needs_groups()) {
        std::vector<Vec3> gains;
        for (const FilmState::MixedGroup& group : state.mix) {
            frame.group_names.push_back(group.name);
            gains.push_back(group.gain);
        }
        film.set_gains(gains);
    }
    const Workers workers(threads);
    film.resolve(frame, workers);
    for (uint32_t& id : frame.object_id) id &= ~expanded_id_bit;
    for (uint32_t& id : frame.material_id) id = (id - 1) & expanded_id_bit ? 0 : id - 1;
    frame.samples = state.samples;
    frame.seconds = state.seconds;
    frame.rays = state.rays;
    frame.path_counts = state.path_counts;
    frame.health.truncated = state.truncated;
    // Images with light paths have no path reuse.
    frame.error = estimate_error(film, film_size(state).light_paths ? 1 : reuse_group_size(settings, state.reuse_pilot), workers);
    if (state.highlights) include_small_highlights(frame.error, *state.highlights, double(state.samples), state.width, state.height);
    frame.error_samples = frame.samples;
    frame.error_at = frame.seconds;
    resolved.error = film.standard_error();
    return resolved;
}

} // namespace blush
