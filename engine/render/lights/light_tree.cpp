#include "render/lights/light_tree.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr int splits_per_level = tree_branch_bits;
constexpr int max_splits = 32 / tree_branch_bits * tree_branch_bits; // levels above a leaf; limited by the bits of a trail

double component(const Vec3d& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
Vec3d lower(const Vec3d& a, const Vec3d& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d upper(const Vec3d& a, const Vec3d& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

// The smallest cone that contains both (Pharr, Jakob, Humphreys, 3.8.4).
void unite_cones(LightBounds& a, const LightBounds& b) {
    if (a.theta_o >= std::numbers::pi) return;
    const double cosine = std::clamp(dot(a.axis, b.axis), -1.0, 1.0);
    // Surely inside: the margin is far above the rounding error of the arc cosine, which takes most of the time.
    if (b.theta_o == 0 && cosine > a.cos_o + 1e-9) return;
    const double between = std::acos(cosine);
    if (std::min(between + b.theta_o, std::numbers::pi) <= a.theta_o) return;
    if (std::min(between + a.theta_o, std::numbers::pi) <= b.theta_o) {
        a.axis = b.axis;
        a.theta_o = b.theta_o;
        a.cos_o = b.cos_o;
        return;
    }
    const double theta = 0.5 * (a.theta_o + between + b.theta_o), turn = theta - a.theta_o;
    const Vec3d about = cross(a.axis, b.axis);
    if (theta >= std::numbers::pi || !(dot(about, about) > 0)) {
        a.theta_o = std::numbers::pi;
        a.cos_o = -1;
        return;
    }
    const Vec3d aside = normalize(cross(about, a.axis));
    a.axis = normalize(a.axis * std::cos(turn) + aside * std::sin(turn));
    a.theta_o = theta;
    a.cos_o = std::cos(theta);
}

// Empty bounds have power 0.
void unite(LightBounds& a, const LightBounds& b) {
    if (b.power <= 0) return;
    if (a.power <= 0) {
        a = b;
        return;
    }
    a.low = lower(a.low, b.low);
    a.high = upper(a.high, b.high);
    unite_cones(a, b);
    a.theta_e = std::max(a.theta_e, b.theta_e);
    a.power += b.power;
    a.two_sided |= b.two_sided;
}

// Surface area orientation heuristic: power times the box's area times the integral of the cone's cosine bound.
double cost(const LightBounds& b) {
    if (b.power <= 0) return 0;
    const Vec3d size = b.high - b.low;
    const double area = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
    const double o = b.theta_o, w = std::min(o + b.theta_e, std::numbers::pi), cos_o = b.cos_o, sin_o = o == 0 ? 0 : std::sin(o);
    const double cone =
        2 * std::numbers::pi * (1 - cos_o) + std::numbers::pi / 2 * (2 * w * sin_o - std::cos(o - 2 * w) - 2 * o * sin_o + cos_o);
    return b.power * cone * (area + 1e-6 * dot(size, size));
}

struct TreeBuilder {
    std::vector<LightBounds>& lights;
    LightTreeTable& table;

    LightTreeNode node_of(const LightBounds& b) const {
        LightTreeNode node{};
        node.center = to_float((b.low + b.high) * 0.5);
        node.half = to_float((b.high - b.low) * (0.5 * (1 + 1e-6)));
        // Rounded up, so that the sphere contains the box.
        node.radius = float(0.5 * length(b.high - b.low) * (1 + 1e-6));
        node.axis = to_float(b.axis);
        node.sin_o = b.theta_o >= std::numbers::pi ? 0 : float(std::sin(b.theta_o));
        node.cos_o = b.theta_o >= std::numbers::pi ? -1 : float(std::cos(b.theta_o));
        node.cos_e = float(std::cos(b.theta_e));
        node.two_sided = b.two_sided;
        node.children = -1;
        return node;
    }

    // Index at which to split lights [begin, end): the median along the longest side, or the bucket boundary of least cost.
    size_t split(size_t begin, size_t end, int splits) const {
        const std::span<LightBounds> part(lights.data() + begin, end - begin);
        Vec3d low = part[0].low + part[0].high, high = low; // of centres, times 2
        for (const LightBounds& b : part) {
            low = lower(low, b.low + b.high);
            high = upper(high, b.low + b.high);
        }
        const Vec3d size = high - low;
        const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto position = [&](const LightBounds& b, int axis) { return component(b.low + b.high, axis); };
        const size_t middle = begin + part.size() / 2;
        // Use the median if the remaining trail bits require it.
        const bool must_halve = max_splits - splits <= int(std::bit_width(part.size())) + splits_per_level;
        if (!must_halve && component(size, longest) > 0)
            if (const size_t found = split_by_cost(part, begin, low, size, longest)) return found;
        std::ranges::nth_element(part, part.begin() + std::ptrdiff_t(part.size() / 2), {},
                                 [&](const LightBounds& b) { return position(b, longest); });
        return middle;
    }

    static constexpr int buckets = 12;
    static int bucket_of(const LightBounds& b, int axis, const Vec3d& low, const Vec3d& size) {
        const double along = (component(b.low + b.high, axis) - component(low, axis)) / component(size, axis);
        return std::clamp(int(along * buckets), 0, buckets - 1);
    }

    // 0: no split. Large ranges are split along their longest side, which is nearly always best.
    size_t split_by_cost(std::span<LightBounds> part, size_t begin, const Vec3d& low, const Vec3d& size, int longest) const {
        double best = 0;
        int best_axis = -1, best_bucket = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(component(size, axis) > 0) || (part.size() > 1024 && axis != longest)) continue;
            std::array<LightBounds, buckets> sums{};
            for (const LightBounds& b : part) unite(sums[size_t(bucket_of(b, axis, low, size))], b);
            std::array<LightBounds, buckets> from_right = sums;
            for (size_t k = buckets - 1; k-- > 0;) unite(from_right[k], from_right[k + 1]);
            LightBounds from_left{};
            const double stretch = component(size, longest) / component(size, axis);
            for (size_t k = 0; k + 1 < buckets; ++k) {
                if (sums[k].power <= 0) continue; // the split after the last bucket again
                unite(from_left, sums[k]);
                if (from_right[k + 1].power <= 0) break;
                const double total = stretch * (cost(from_left) + cost(from_right[k + 1]));
                if (best_axis >= 0 && total >= best) continue;
                best = total;
                best_axis = axis;
                best_bucket = int(k);
            }
        }
        if (best_axis < 0) return 0;
        const auto second =
            std::ranges::partition(part, [&](const LightBounds& b) { return bucket_of(b, best_axis, low, size) <= best_bucket; });
        return begin + size_t(second.begin() - part.begin());
    }

    // Builds nodes[index] for lights [begin, end).
    void build(size_t index, size_t begin, size_t end, uint32_t trail, int level) {
        LightBounds all = lights[begin];
        for (size_t i = begin + 1; i < end; ++i) unite(all, lights[i]);
        table.nodes[index] = node_of(all);
        if (end - begin == 1) {
            table.nodes[index].light = all.light;
            table.trails[size_t(all.light)] = trail;
            table.depths[size_t(all.light)] = level;
            return;
        }
        std::vector<size_t> borders{begin, end};
        for (int k = 0; k < splits_per_level; ++k) {
            std::vector<size_t> finer{begin};
            for (size_t i = 0; i + 1 < borders.size(); ++i) {
                if (borders[i + 1] - borders[i] > 1) finer.push_back(split(borders[i], borders[i + 1], splits_per_level * level + k));
                finer.push_back(borders[i + 1]);
            }
            borders = std::move(finer);
        }
        const size_t children = table.nodes.size(), count = borders.size() - 1;
        table.nodes[index].children = int32_t(children);
        table.nodes[index].child_count = int32_t(count);
        table.nodes.resize(children + count);
        for (size_t k = 0; k < count; ++k)
            build(children + k, borders[k], borders[k + 1], trail | uint32_t(k) << splits_per_level * level, level + 1);
    }
};

} // namespace

LightTreeTable build_light_tree(std::vector<LightBounds> lights, int32_t light_count) {
    LightTreeTable table;
    std::erase_if(lights, [](const LightBounds& b) {
        const Vec3d sum = b.low + b.high + b.axis;
        return !(b.power > 0) || !std::isfinite(sum.x + sum.y + sum.z);
    });
    for (LightBounds& b : lights) b.cos_o = std::cos(b.theta_o);
    table.trails.assign(size_t(light_count), 0);
    table.depths.assign(size_t(light_count), -1);
    if (lights.empty()) return table;
    table.nodes.reserve(2 * lights.size());
    table.nodes.resize(1);
    std::vector<double> powers(size_t(light_count), 0.0);
    for (const LightBounds& b : lights) powers[size_t(b.light)] = b.power;
    TreeBuilder{lights, table}.build(0, 0, lights.size(), 0, 0);
    set_light_tree_powers(table, powers);
    return table;
}

void set_light_tree_powers(LightTreeTable& table, std::span<const double> powers) {
    std::vector<double> below(table.nodes.size(), 0.0);
    // Children have larger indices than their parents.
    for (size_t i = table.nodes.size(); i-- > 0;) {
        LightTreeNode& node = table.nodes[i];
        if (node.children < 0)
            below[i] = powers[size_t(node.light)];
        else
            for (int32_t k = 0; k < node.child_count; ++k) below[i] += below[size_t(node.children + k)];
        node.power = float(below[i]);
    }
}

} // namespace blush
