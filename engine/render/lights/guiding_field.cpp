#include "render/lights/guiding_field.h"

#include "render/lights/receiver_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace blush {
namespace {

constexpr size_t min_photons = 128;                    // of a region; else a larger one is taken,
constexpr size_t min_photons_of_largest = 16;          // and so many of the largest
constexpr size_t min_photons_to_split = 12;            // of a node that is split
constexpr double even_share = 0.02;                    // of a node's samples, spread over its quadrants
constexpr double caustic_weight = 4;                   // k
constexpr double min_guided = 1.0 / 32;                // share of samples
constexpr double min_weakened = 1.0 / 64;              // after edits; below, nothing is left
constexpr double dropped_estimates = 0.02;             // of a region's largest: the caustic itself
constexpr size_t max_measured_photons = 64;            // of a region, at most
constexpr int coarse_side = 64;                        // cells along the longest side of the grid; or one of
constexpr std::array<int, 3> fine_sides{192, 128, 96}; // these, if it then has no more than
constexpr double max_cells = 1.0 * coarse_side * coarse_side * coarse_side;
constexpr std::array<int32_t, 4> region_sides{1, 2, 4, 8}; // in cells

// A photon on the unit square of directions.
struct GuidingPoint {
    float x, y;
    double flux;
    const GuidingTrial* photon;
};
using GuidingPoints = std::span<GuidingPoint>;

bool is_usable(const GuidingTrial& t) {
    return is_finite_position(t.position) && is_finite_position(t.direction) && std::isfinite(t.value) && t.value >= 0 &&
           dot(t.normal, t.normal) > 0;
}
bool has_flux(const GuidingTrial& t) { return is_usable(t) && t.value > 0; }

ReceiverGrid make_grid(const std::vector<Vec3>& positions) {
    const ReceiverGrid coarse = make_receiver_grid(positions, coarse_side);
    for (const int side : fine_sides) {
        double cells = 1;
        for (const int32_t along : coarse.cells) cells *= along > 1 ? double(along) * side / coarse_side : 1; // a floor stays one cell high
        if (cells <= max_cells) return make_receiver_grid(positions, side);
    }
    return coarse;
}

// A quadtree as in GuidingTables, with node numbers from 0.
struct GuidingQuadtree {
    std::vector<int32_t> nodes;
    std::vector<float> shares;

    // The number of the node, -1: a leaf.
    int32_t build(GuidingPoints points, int level = 0) {
        if (level == guiding_levels || (level > 0 && points.size() < min_photons_to_split)) return -1;
        const size_t node = nodes.size() / 4;
        nodes.resize(nodes.size() + 4);
        shares.resize(shares.size() + 4);
        std::array<double, 4> flux{};
        const auto upper = std::stable_partition(points.begin(), points.end(), [](const GuidingPoint& p) { return p.y < 0.5f; });
        for (size_t half = 0; half < 2; ++half) {
            const auto begin = half ? upper : points.begin(), end = half ? points.end() : upper;
            const auto right = std::stable_partition(begin, end, [](const GuidingPoint& p) { return p.x < 0.5f; });
            for (size_t side = 0; side < 2; ++side) {
                const GuidingPoints quadrant(side ? right : begin, side ? end : right);
                for (GuidingPoint& p : quadrant) {
                    p = {2 * p.x - float(side), 2 * p.y - float(half), p.flux, p.photon};
                    flux[2 * half + side] += p.flux;
                }
                nodes[4 * node + 2 * half + side] = build(quadrant, level + 1);
            }
        }
        const double all = flux[0] + flux[1] + flux[2] + flux[3];
        for (size_t k = 0; k < 4; ++k) shares[4 * node + k] = float(all > 0 ? (1 - even_share) * (flux[k] / all) + even_share / 4 : 0.25);
        return int32_t(node);
    }
};

// By cell and side.
template <class T, class Wanted, class Make>
ByKey<T> by_cell(std::span<const GuidingTrial> trials, const ReceiverGrid& grid, const Wanted& wanted, const Make& make) {
    std::vector<std::pair<int32_t, T>> entries;
    for (const GuidingTrial& t : trials)
        if (wanted(t)) entries.emplace_back(guiding_cell<float>(grid, t.position, t.normal), make(t));
    return ByKey<T>(std::move(entries));
}
template <class T> std::vector<T> values_of_all(const ByKey<T>& by_cell, std::span<const int32_t> cells) {
    std::vector<T> all;
    for (const int32_t cell : cells) {
        const std::span<const T> some = by_cell.values_of(cell);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

// Moments of estimates of the irradiance at a vertex.
struct Estimates {
    double irradiance = 0, moment = 0;
};
// `values`: of light other than the caustic, but for some of the largest, which are the caustic itself.
Estimates estimates_of(std::vector<double> values) {
    const auto kept = std::ptrdiff_t(double(values.size()) * (1 - dropped_estimates));
    if (kept < 1) return {};
    std::ranges::nth_element(values, values.begin() + kept - 1);
    Estimates e;
    for (std::ptrdiff_t k = 0; k < kept; ++k) {
        e.irradiance += values[size_t(k)] / double(kept);
        e.moment += values[size_t(k)] * values[size_t(k)] / double(kept);
    }
    return e;
}

// Cells of a cube of side^3 cells that a surface crosses, when `photons` fell into `occupied` of them: as many as are expected to be
// occupied by photons spread evenly, and at most those of a plane.
double surface_cells(double photons, double occupied, int32_t side) {
    const double plane = double(side) * double(side);
    double cells = occupied;
    for (int i = 0; i < 16; ++i) cells = std::min(plane, occupied / -std::expm1(-photons / cells));
    return std::max(cells, occupied);
}

struct GuidingRegion {
    std::vector<int32_t> cells; // and side: with photons
    int32_t side;               // of the cube, in cells
    GuidingQuadtree tree = {};
    double guided = 0;                              // share of samples
    double paths = 0;                               // vertices of paths in it
    double squared_mean = 0, with = 0, without = 0; // of estimates of the irradiance: squared mean, variances

    // Variances with a tree of half of the photons, estimated by the other half: its own would find it too good. `caustic`: irradiance.
    void compare(const std::vector<GuidingPoint>& all, double caustic, const Estimates& other, const CausticCasterTables& casters) {
        std::vector<GuidingPoint> half, points;
        for (size_t k = 0; k < all.size(); ++k) (k % 2 == 0 ? half : points).push_back(all[k]);
        GuidingQuadtree of_half;
        of_half.build(half);
        const int32_t root = 0;
        const GuidingTables own{&root, nullptr, of_half.shares.data(), of_half.nodes.data(), {}};
        double weight = 0, moment_with = 0, moment_without = 0, cast = 0;
        const size_t step = points.size() / max_measured_photons + 1;
        for (size_t k = 0; k < points.size(); k += step) {
            const GuidingTrial& photon = *points[k].photon;
            const float cosine = cosine_hemisphere_pdf(dot(photon.normal, photon.direction));
            const double learned = double(learned_density<float>(own, root, photon.direction, true)) * double(0.25f * inv_pi);
            const auto by_caster = direction_guide_at<float>({casters, {}}, photon.position, photon.normal, true);
            const double plain = double(guided_pdf<float>({casters, {}}, by_caster, photon.direction, cosine));
            if (!(plain > 0)) continue;
            weight += points[k].flux;
            cast += points[k].flux * double(by_caster.share);
            moment_with += points[k].flux * learned / ((1 - guided) * double(cosine) + guided * learned);
            moment_without += points[k].flux * learned / plain;
        }
        if (!(weight > 0)) return;
        const double mean = caustic + other.irradiance, squared = caustic * caustic / weight;
        squared_mean = mean * mean;
        without = std::max(0.0, other.moment + squared * moment_without - squared_mean);
        with = std::max(0.0, other.moment * (1 - cast / weight) / (1 - guided) + squared * moment_with - squared_mean);
    }
};

// A cell's region is the smallest with enough photons.
struct GuidingRegions {
    std::vector<GuidingRegion> all; // in the order of their first cells
    std::vector<int32_t> of_cell;   // and side; -1: none

    GuidingRegions(const ByKey<GuidingPoint>& photons, const ReceiverGrid& grid) : of_cell(size_t(grid.count()) * guiding_sides, -1) {
        std::vector<GuidingRegion> found;
        for (size_t size = region_sides.size(); size-- > 0;) {
            const CellBlocks blocks{grid, region_sides[size]};
            const ByKey<size_t> of_block = occupied_cells(photons, blocks);
            for (size_t b = 0; b < of_block.keys().size(); ++b) {
                GuidingRegion region{.cells = {}, .side = region_sides[size]};
                size_t count = 0;
                for (const size_t k : of_block.values_at(b)) {
                    region.cells.push_back(photons.keys()[k]);
                    count += photons.values_at(k).size();
                }
                if (count < (size + 1 < region_sides.size() ? min_photons : min_photons_of_largest)) continue;
                const int32_t block = of_block.keys()[b] / guiding_sides, face = of_block.keys()[b] % guiding_sides;
                blocks.for_each_cell(block, [&](int32_t cell) { of_cell[size_t(cell * guiding_sides + face)] = int32_t(found.size()); });
                found.push_back(std::move(region));
            }
        }
        keep_used(std::move(found));
    }

private:
    // Indices of cells with photons, by block and side.
    static ByKey<size_t> occupied_cells(const ByKey<GuidingPoint>& photons, const CellBlocks& blocks) {
        std::vector<std::pair<int32_t, size_t>> entries;
        for (size_t k = 0; k < photons.keys().size(); ++k) {
            const int32_t cell = photons.keys()[k];
            entries.emplace_back(blocks.of(cell / guiding_sides) * guiding_sides + cell % guiding_sides, k);
        }
        return ByKey<size_t>(std::move(entries));
    }
    // Smaller regions may have taken all cells of a larger one.
    void keep_used(std::vector<GuidingRegion> found) {
        std::vector<int32_t> number(found.size(), -1);
        for (int32_t& region : of_cell) {
            if (region < 0) continue;
            int32_t& kept = number[size_t(region)];
            if (kept < 0) {
                kept = int32_t(all.size());
                all.push_back(std::move(found[size_t(region)]));
            }
            region = kept;
        }
    }
};

// Over the regions, weighted by their vertices of paths.
std::optional<PilotFigures> figures_of(const std::vector<GuidingRegion>& regions) {
    double with = 0, without = 0, relative_with = 0, relative_without = 0, log_ratios = 0, paths = 0;
    for (const GuidingRegion& r : regions) {
        if (!(r.paths > 0 && r.with > 0 && r.without > 0)) continue;
        paths += r.paths;
        with += r.paths * r.with;
        without += r.paths * r.without;
        relative_with += r.paths * r.with / r.squared_mean;
        relative_without += r.paths * r.without / r.squared_mean;
        log_ratios += r.paths * std::log(r.with / r.without);
    }
    if (!(paths > 0)) return std::nullopt;
    return PilotFigures{.mse = with / without, .relmse = relative_with / relative_without, .typical = std::exp(log_ratios / paths)};
}

} // namespace

std::optional<GuidingField> GuidingField::learn(std::span<const GuidingTrial> photons, int64_t emitted, std::span<const GuidingTrial> paths,
                                                const CausticCasterTables& casters, const Workers& workers,
                                                const std::function<bool()>& wanted) {
    GuidingField field;
    if (!field.build(photons, emitted, paths, casters, workers, wanted)) return std::nullopt;
    return field;
}

bool GuidingField::build(std::span<const GuidingTrial> photons, int64_t emitted, std::span<const GuidingTrial> paths,
                         const CausticCasterTables& casters, const Workers& workers, const std::function<bool()>& wanted) {
    std::vector<Vec3> positions;
    for (const GuidingTrial& t : photons)
        if (has_flux(t)) positions.push_back(t.position);
    grid_ = make_grid(positions);
    if (grid_.cells_per_metre == 0) return true;
    const ByKey<GuidingPoint> arrived = by_cell<GuidingPoint>(photons, grid_, has_flux, [](const GuidingTrial& t) {
        const Vec2T<float> at = guiding_point<float>(t.direction);
        return GuidingPoint{at.x, at.y, double(t.value), &t};
    });
    const auto is_unwanted = [&] { return wanted && !wanted(); };
    if (is_unwanted()) return false;
    const ByKey<double> found = by_cell<double>(paths, grid_, is_usable, [](const GuidingTrial& t) { return double(t.value); });

    if (is_unwanted()) return false;
    GuidingRegions regions(arrived, grid_);
    const double cell_area = 1 / (double(grid_.cells_per_metre) * double(grid_.cells_per_metre));
    const bool all = workers.for_each(int64_t(regions.all.size()), wanted, [&](int64_t i, unsigned) {
        GuidingRegion& region = regions.all[size_t(i)];
        std::vector<GuidingPoint> points = values_of_all(arrived, region.cells);
        double flux = 0;
        for (const GuidingPoint& p : points) flux += p.flux;
        const double area = cell_area * surface_cells(double(points.size()), double(region.cells.size()), region.side);
        const double caustic = flux / (double(emitted) * area);
        std::vector<double> values = values_of_all(found, region.cells);
        region.paths = double(values.size());
        const Estimates other = estimates_of(std::move(values));
        const double weighted = caustic_weight * caustic;
        region.guided = std::clamp(weighted / (weighted + std::sqrt(other.moment)), min_guided, double(max_guided_share));
        region.compare(points, caustic, other, casters);
        region.tree.build(points);
    });
    if (!all) return false;
    figures_ = figures_of(regions.all);

    std::vector<int32_t> root_of;
    for (const GuidingRegion& region : regions.all) {
        const auto first = int32_t(nodes_.size() / 4);
        root_of.push_back(first);
        for (const int32_t node : region.tree.nodes) nodes_.push_back(node < 0 ? -1 : node + first);
        shares_.insert(shares_.end(), region.tree.shares.begin(), region.tree.shares.end());
        guided_.resize(nodes_.size() / 4, float(region.guided));
    }
    if (regions.all.empty()) return true;
    roots_ = std::move(regions.of_cell);
    for (int32_t& root : roots_) {
        if (root < 0) continue;
        root = root_of[size_t(root)];
        ++regions_;
    }
    return true;
}

void GuidingField::forget_cell(size_t cell) {
    if (roots_[cell] < 0) return;
    roots_[cell] = -1;
    --regions_;
}

void GuidingField::weaken(double factor) {
    for (float& guided : guided_) guided *= float(factor);
    for (size_t k = 0; k < roots_.size(); ++k)
        if (roots_[k] >= 0 && guided_[size_t(roots_[k])] < float(min_weakened)) forget_cell(k);
}

void GuidingField::forget(const Vec3& low, const Vec3& high) {
    if (roots_.empty()) return;
    // Receivers outside of the grid take its outermost cells.
    const auto cell_along = [&](int axis, float x, float from) {
        return int32_t(std::clamp(std::floor(double(x - from) * double(grid_.cells_per_metre)), 0.0, double(grid_.cells[axis] - 1)));
    };
    const auto cells_of = [&](const Vec3& at) {
        return std::array{cell_along(0, at.x, grid_.low.x), cell_along(1, at.y, grid_.low.y), cell_along(2, at.z, grid_.low.z)};
    };
    const std::array<int32_t, 3> first = cells_of(low), last = cells_of(high);
    for (int32_t z = first[2]; z <= last[2]; ++z)
        for (int32_t y = first[1]; y <= last[1]; ++y)
            for (int32_t x = first[0]; x <= last[0]; ++x) {
                const auto cell = size_t((z * grid_.cells[1] + y) * grid_.cells[0] + x);
                for (size_t side = 0; side < guiding_sides; ++side) forget_cell(cell * guiding_sides + side);
            }
}

void GuidingField::release() {
    GuidingField empty;
    empty.figures_ = figures_;
    *this = std::move(empty);
}

GuidingTables GuidingField::tables() const {
    if (roots_.empty()) return {};
    return {roots_.data(), guided_.data(), shares_.data(), nodes_.data(), grid_};
}

} // namespace blush
