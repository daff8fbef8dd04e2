#include "render/pilots/edges/highlight_location.h"

#include "core/math.h"
#include "render/film/edges/edge_pixels.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

namespace blush {
namespace {

constexpr size_t most_walks = 2048, chains_per_task = tile_capacity / most_copies / 3; // three chains a walk
constexpr int most_iterations = 12, most_cell_iterations = 6;
constexpr double difference = 5e-5, longest_step = 1.0 / 16;         // of the film's width
constexpr double converged = 0.25;                                   // of the image's half axes
constexpr int cells = 3;                                             // of a lamp, along each axis
constexpr double nearly_met = 1.5;                                   // of a lamp's half axes
constexpr double margin = 1.25, thinnest = 1.0 / 512, largest = 0.5; // of half axes; pixels; square pixels
constexpr double longest_piece = 0.75;                               // half axis of a place, pixels
constexpr int most_pieces = 16;                                      // of an axis
static_assert(longest_highlight_chain * ChainLobeCodes::bits_per_lobe <= 32);

struct Point {
    double x, y;
};
Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
Point operator*(const Point& a, double s) { return {a.x * s, a.y * s}; }
double length(const Point& a) { return std::hypot(a.x, a.y); }
double cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
// p with p.x a + p.y b = v.
Point solve(const Point& a, const Point& b, const Point& v) { return Point{cross(v, b), cross(a, v)} * (1 / cross(a, b)); }

// A parallelogram that contains a lamp, or a ball, as seen from far away.
struct Lamp {
    bool infinite, round;
    Vec3d centre; // infinite: a unit direction
    Vec3d a, b;   // half axes; if round those across the last ray that was followed
    double radius;
};
Lamp lamp_of(const SceneTables& scene, const ChainSighting& seen) {
    const LightRecord& light = scene.lights.lights[seen.light_index];
    switch (LightKind(light.kind)) {
    case LightKind::triangle: {
        // Its longest side is a diagonal of the parallelogram: of half of a rectangle this is the rectangle.
        const std::array corners{Vec3d{0, 0, 0}, to_double(light.edge1), to_double(light.edge2)};
        const auto side = [&](size_t k) { return corners[(k + 2) % 3] - corners[(k + 1) % 3]; }; // opposite of a corner
        size_t at = 0;
        for (const size_t k : {1u, 2u})
            if (length(side(k)) > length(side(at))) at = k;
        const Vec3d a = (corners[(at + 1) % 3] - corners[at]) * 0.5, b = (corners[(at + 2) % 3] - corners[at]) * 0.5;
        return {false, false, to_double(light.position) + corners[at] + a + b, a, b, std::max(length(a), length(b))};
    }
    case LightKind::sun: {
        const double cosine = 1 - double(light.cone_height);
        return {true, true, to_double(light.position), {}, {}, std::sqrt(std::max(0.0, 1 - cosine * cosine)) / cosine};
    }
    case LightKind::environment:
        return {true, true, to_double(seen.target), {}, {}, std::sqrt(1 / (std::numbers::pi * double(seen.target_density)))};
    default: return {false, true, to_double(light.position), {}, {}, double(light.radius)};
    }
}

// Where the rays of a walk pass the plane through its lamp across the first ray.
struct Plane {
    Vec3d forward, s, t, origin;
    bool infinite;

    Plane(const Lamp& lamp, const FollowedEnd& first) : forward(to_double(first.direction)), origin(lamp.centre), infinite(lamp.infinite) {
        s = normalize(std::abs(forward.x) > 0.5 ? cross(forward, Vec3d{0, 1, 0}) : cross(forward, Vec3d{1, 0, 0}));
        t = cross(forward, s);
        if (infinite) origin = origin * (1 / dot(origin, forward));
    }
    Point in_plane(const Vec3d& v) const { return {dot(v, s), dot(v, t)}; }
    // Relative to the middle of the lamp.
    Point passed(const FollowedEnd& end) const {
        const Vec3d o = to_double(end.origin), d = to_double(end.direction);
        if (infinite) return in_plane(d * (1 / dot(d, forward)) - origin);
        return in_plane(o + d * (dot(origin - o, forward) / dot(d, forward)) - origin);
    }
    bool is_ahead(const FollowedEnd& first) const { return dot(infinite ? origin : origin - to_double(first.origin), forward) > 0; }
};

struct Walk {
    const Sighting* from;
    Lamp lamp;
    Point at, best, step{0, 0}; // on the film, pixels
    double best_error = std::numeric_limits<double>::infinity();
    bool ended = false, found = false;
    HighlightPlace place{};

    Walk(const Sighting& sighting, const Lamp& of, const Point& begin) : from(&sighting), lamp(of), at(begin), best(begin) {}
    bool is_small_image() const { return found && place.area() <= largest; }
};

// The step of the walk was too long.
void retreat(Walk& walk) {
    walk.step = walk.step * 0.5;
    walk.ended = walk.ended || length(walk.step) < thinnest / 4;
    walk.at = walk.best + walk.step;
}

// Newton's step from the ends of the chains at walk.at and beside it, `h` pixels to the right and down.
void advance(Walk& walk, std::span<const FollowedEnd, 3> ends, double h, double width) {
    if (!ends[0].valid || !ends[1].valid || !ends[2].valid) return retreat(walk);
    const Plane plane(walk.lamp, ends[0]);
    if (!plane.is_ahead(ends[0])) return retreat(walk);
    const Point off = plane.passed(ends[0]);
    const double error = length(off);
    if (!(error < walk.best_error)) return retreat(walk);
    const Point u = (plane.passed(ends[1]) - off) * (1 / h), v = (plane.passed(ends[2]) - off) * (1 / h);
    walk.best = walk.at;
    walk.best_error = error;
    if (walk.lamp.round) walk.lamp.a = plane.s * walk.lamp.radius, walk.lamp.b = plane.t * walk.lamp.radius;
    const Point a = solve(u, v, plane.in_plane(walk.lamp.a)), b = solve(u, v, plane.in_plane(walk.lamp.b)), step = solve(u, v, off) * -1;
    if (!std::isfinite(a.x + a.y + b.x + b.y + step.x + step.y)) {
        walk.ended = true;
        return;
    }
    walk.step = step * std::min(1.0, longest_step * width / std::max(length(step), 1e-12));
    walk.at = walk.best + walk.step;
    const Point left = solve(a, b, step);
    if (!(std::abs(left.x) < converged && std::abs(left.y) < converged)) return;
    walk.ended = walk.found = true;
    walk.place = {walk.at.x, walk.at.y, a.x, a.y, b.x, b.y, luminance(walk.from->chain.light)};
}

// Not thinner than samples resolve.
HighlightPlace with_margin(HighlightPlace p) {
    for (double* axis : {&p.ax, &p.ay, &p.bx, &p.by}) *axis *= margin;
    Point a{p.ax, p.ay}, b{p.bx, p.by};
    if (length(a) < length(b)) std::swap(a, b);
    if (length(a) < thinnest) a = {thinnest, 0};
    if (std::abs(cross(a, b)) < thinnest * length(a)) b = Point{-a.y, a.x} * (thinnest / length(a));
    return {p.x, p.y, a.x, a.y, b.x, b.y, p.light};
}

// So that a pixel aims at its part of a long image.
void add_pieces(const HighlightPlace& p, std::vector<HighlightPlace>& to) {
    const auto pieces = [](double axis_x, double axis_y) { return std::ceil(std::hypot(axis_x, axis_y) / longest_piece); };
    if (!(std::max(pieces(p.ax, p.ay), pieces(p.bx, p.by)) <= most_pieces)) return;
    const int across = int(pieces(p.ax, p.ay)), down = int(pieces(p.bx, p.by));
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) {
            const double s = (2 * i + 1.0) / across - 1, t = (2 * j + 1.0) / down - 1;
            to.push_back(
                {p.x + s * p.ax + t * p.bx, p.y + s * p.ay + t * p.by, p.ax / across, p.ay / across, p.bx / down, p.by / down, p.light});
        }
}

class Locator {
public:
    Locator(const KernelContext& context, const Kernel& kernel, const Workers& workers, std::vector<std::unique_ptr<TileScratch>>& scratch,
            const std::function<bool()>& wanted)
        : context_(context), kernel_(kernel), workers_(workers), scratch_(scratch), wanted_(wanted) {}

    std::optional<HighlightsLocated> locate(std::span<const Sighting> sightings, double spacing) const;

private:
    bool solve_all(std::vector<Walk>& walks, int most) const;
    double width() const { return double(context_.settings.width); }

    const KernelContext& context_;
    const Kernel& kernel_;
    const Workers& workers_;
    std::vector<std::unique_ptr<TileScratch>>& scratch_;
    const std::function<bool()>& wanted_;
};

bool Locator::solve_all(std::vector<Walk>& walks, int most) const {
    const double h = difference * width();
    for (int iteration = 0; iteration < most; ++iteration) {
        std::vector<Walk*> open;
        for (Walk& walk : walks)
            if (!walk.ended) open.push_back(&walk);
        if (open.empty()) break;
        const auto follow = [&](int64_t task, unsigned worker) {
            TileScratch& s = *scratch_[worker];
            if (!s.chains) s.chains = std::make_unique<ChainColumns>();
            ChainColumns& chains = *s.chains;
            chains.task = ChainTask::follow;
            chains.followed.clear();
            const size_t first = size_t(task) * chains_per_task, end = std::min(first + chains_per_task, open.size());
            for (size_t k = first; k < end; ++k)
                for (const Point& beside : {Point{0, 0}, Point{h, 0}, Point{0, h}}) {
                    const Walk& w = *open[k];
                    chains.followed.push_back({w.from->sample, float(w.at.x + beside.x), float(w.at.y + beside.y), w.from->chain.lobes});
                }
            chains.ends.resize(chains.followed.size());
            kernel_.trace_chains(context_, {}, s);
            chains.task = ChainTask::emission;
            for (size_t k = first; k < end; ++k)
                advance(*open[k], std::span<const FollowedEnd, 3>(chains.ends.data() + 3 * (k - first), 3), h, width());
        };
        if (!workers_.for_each(int64_t((open.size() + chains_per_task - 1) / chains_per_task), wanted_, follow)) return false;
    }
    return true;
}

// The walks to the cells of a lamp, from the image of its middle or from where the chain came nearest to it.
void add_cell_walks(const Walk& whole, std::vector<Walk>& to) {
    const HighlightPlace& p = whole.place;
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const double s = (2 * i + 1.0) / cells - 1, t = (2 * j + 1.0) / cells - 1;
            Lamp cell = whole.lamp;
            cell.round = false;
            cell.centre = cell.centre + cell.a * s + cell.b * t;
            cell.a = cell.a * (1.0 / cells);
            cell.b = cell.b * (1.0 / cells);
            const Point image{p.x + s * p.ax + t * p.bx, p.y + s * p.ay + t * p.by};
            to.emplace_back(*whole.from, cell, whole.found ? image : whole.best);
        }
}

// The distinct images of walks, for each the first.
class Images {
public:
    bool add(const Walk& walk) {
        const HighlightPlace place = with_margin(walk.place);
        const auto known = std::ranges::find_if(
            places_, [&](const HighlightPlace& p) { return p.contains(place.x, place.y) && place.contains(p.x, p.y); });
        if (known != places_.end()) {
            known->light = std::max(known->light, place.light);
            return false;
        }
        places_.push_back(place);
        return true;
    }
    const std::vector<HighlightPlace>& places() const { return places_; }

private:
    std::vector<HighlightPlace> places_;
};

// Where walks begin: one for each lamp, sequence of lobes and square of pixels.
class WalkStarts {
public:
    explicit WalkStarts(double spacing) : spacing_(spacing) {}

    // The walk of a sighting: an earlier one, or a new one if there are not too many.
    std::optional<size_t> walk_of(const SceneTables& scene, const Sighting& s) {
        const ChainSighting& seen = s.chain;
        const double x = double(seen.film_x), y = double(seen.film_y);
        const auto key = std::tuple(seen.light_index, seen.lobes.codes, seen.lobes.count, int(x / spacing_), int(y / spacing_));
        if (const auto begun = begun_.find(key); begun != begun_.end()) return begun->second;
        if (walks.size() == most_walks) return std::nullopt;
        begun_.emplace(key, walks.size());
        walks.emplace_back(s, lamp_of(scene, seen), Point{x, y});
        return walks.size() - 1;
    }
    std::vector<Walk> walks;

private:
    double spacing_;
    std::map<std::tuple<int32_t, uint32_t, int32_t, int, int>, size_t> begun_;
};

std::optional<HighlightsLocated> Locator::locate(std::span<const Sighting> sightings, double spacing) const {
    WalkStarts starts(spacing);
    std::vector<std::optional<size_t>> walk_of;
    for (const Sighting& s : sightings) walk_of.push_back(starts.walk_of(*context_.scene, s));
    std::vector<Walk>& walks = starts.walks;
    std::vector<Walk> of_cells;
    if (!solve_all(walks, most_iterations)) return std::nullopt;
    // A lamp of which a part is seen may have a middle that is not.
    Images wholes, parts;
    for (const Walk& walk : walks) {
        const bool near = walk.best_error < nearly_met * std::hypot(length(walk.lamp.a), length(walk.lamp.b));
        if (walk.found ? walk.is_small_image() && wholes.add(walk) : near) add_cell_walks(walk, of_cells);
    }
    if (!solve_all(of_cells, most_cell_iterations)) return std::nullopt;
    for (const Walk& walk : of_cells)
        if (walk.is_small_image()) parts.add(walk);
    HighlightsLocated located;
    for (const HighlightPlace& part : parts.places()) add_pieces(part, located.places);
    for (const auto& walk : walk_of) located.by_sighting.push_back(walk && walks[*walk].is_small_image());
    return located;
}

} // namespace

std::optional<HighlightsLocated> locate_highlights(const KernelContext& context, const Kernel& kernel, std::span<const Sighting> sightings,
                                                   double spacing, const Workers& workers,
                                                   std::vector<std::unique_ptr<TileScratch>>& scratch,
                                                   const std::function<bool()>& wanted) {
    if (context.scene->camera.aperture_radius > 0) return HighlightsLocated{{}, std::vector<bool>(sightings.size())};
    return Locator(context, kernel, workers, scratch, wanted).locate(sightings, spacing);
}

} // namespace blush
