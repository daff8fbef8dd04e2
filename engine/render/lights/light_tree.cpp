#include "render/lights/light_tree.h"

#include "core/distribution.h"
#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

// Maximal number of nodes above a leaf. A trail has 32 bits; those of one level stay unused, so that no trail equals no_trail.
constexpr int max_levels = 32 / tree_branch_bits - 1;
// The children of the root are built in parallel for at least this many items.
constexpr size_t parallel_items = size_t(1) << 13;
constexpr int max_guide_bits = 20;
constexpr size_t leaves_in_guide_cell = 4; // at least, and up to twice as many, if all have the same power

float component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
Vec3 lower(const Vec3& a, const Vec3& b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 upper(const Vec3& a, const Vec3& b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

struct Item {
    LightBounds bounds;
    int32_t index = 0;
};

Vec3d center_of(const LightBounds& b) { return (to_double(b.low) + to_double(b.high)) * 0.5; }
// Upper bound of the distance of the lights in `b` from `center`.
double radius_around(const Vec3d& center, const LightBounds& b) {
    double farthest = 0;
    for (const Vec3& corner : b.corners) farthest = std::max(farthest, length(to_double(corner) - center));
    return farthest + b.margin;
}

// Bounds of several lights as sums, which need no trigonometry to extend, unlike LightBounds. The length of the mean axis determines
// the cone: for axes distributed uniformly over a cap of half angle o it is (1 + cos o) / 2.
struct Sum {
    Vec3 low{0, 0, 0}, high{0, 0, 0};
    Vec3d axis{0, 0, 0}; // times power
    double power = 0;
    float theta_o = 0, theta_e = 0;

    void add(const LightBounds& b, const Vec3& reference) {
        low = power > 0 ? lower(low, b.low) : b.low;
        high = power > 0 ? upper(high, b.high) : b.high;
        axis = axis + to_double(b.axis) * (b.two_sided && dot(b.axis, reference) < 0 ? -b.power : b.power);
        power += b.power;
        theta_o = std::max(theta_o, b.theta_o);
        theta_e = std::max(theta_e, b.theta_e);
    }
    void add(const Sum& s) {
        if (s.power <= 0) return;
        low = power > 0 ? lower(low, s.low) : s.low;
        high = power > 0 ? upper(high, s.high) : s.high;
        axis = axis + s.axis;
        power += s.power;
        theta_o = std::max(theta_o, s.theta_o);
        theta_e = std::max(theta_e, s.theta_e);
    }

    // Surface area orientation heuristic: power times the box's area times the integral of the cone's cosine bound.
    double cost() const {
        if (power <= 0) return 0;
        const Vec3d size = to_double(high) - to_double(low);
        const double area = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
        const double cap = std::acos(std::clamp(2 * length(axis) / power - 1, -1.0, 1.0));
        const double o = std::min(cap + double(theta_o), std::numbers::pi), w = std::min(o + double(theta_e), std::numbers::pi);
        const double sin_o = std::sin(o), cos_o = std::cos(o);
        const double cone =
            2 * std::numbers::pi * (1 - cos_o) + std::numbers::pi / 2 * (2 * w * sin_o - std::cos(o - 2 * w) - 2 * o * sin_o + cos_o);
        return power * cone * (area + 1e-6 * dot(size, size));
    }
};

// Bounds of all items. The axis of a two-sided item counts in both directions.
LightBounds bounds_of(std::span<const Item> items) {
    LightBounds all = items[0].bounds;
    if (items.size() == 1) return all;
    const Vec3 reference = all.axis;
    Sum sum;
    for (const Item& item : items) {
        sum.add(item.bounds, reference);
        all.two_sided |= item.bounds.two_sided;
    }
    all.low = sum.low;
    all.high = sum.high;
    const Vec3 center = to_float(center_of(all));
    all.corners = {center, center, center};
    all.margin = 0;
    for (const Item& item : items) all.margin = std::max(all.margin, radius_around(to_double(center), item.bounds));
    all.power = sum.power;
    all.theta_e = sum.theta_e;
    all.theta_o = std::numbers::pi_v<float>;
    if (sum.theta_o >= all.theta_o || !(length(sum.axis) > 1e-3 * sum.power)) return all;
    const Vec3d axis = normalize(sum.axis);
    double min_cosine = 1, max_angle = 0; // to the axes of items with theta_o = 0; to the far side of the other items' cones
    for (const Item& item : items) {
        const double cosine = dot(to_double(item.bounds.axis), axis);
        const double turned = item.bounds.two_sided ? std::abs(cosine) : cosine;
        if (item.bounds.theta_o > 0)
            max_angle = std::max(max_angle, std::acos(std::clamp(turned, -1.0, 1.0)) + double(item.bounds.theta_o));
        else
            min_cosine = std::min(min_cosine, turned);
    }
    constexpr double margin = 1e-5; // for rounding of the axis
    all.axis = to_float(axis);
    all.theta_o = float(std::min(std::max(max_angle, std::acos(std::max(min_cosine, -1.0))) + margin, std::numbers::pi));
    return all;
}

void set_child(LightTreeNode& node, int k, const LightBounds& b) {
    const Vec3 center = to_float(center_of(b));
    // Rounded up, so that the box and the sphere contain the lights.
    const Vec3d rounding = to_double(abs(center)) * 0x1p-24;
    const Vec3d half = (to_double(b.high) - to_double(b.low)) * (0.5 * (1 + 1e-6)) + rounding;
    for (int axis = 0; axis < 3; ++axis) {
        node.center[axis][k] = component(center, axis);
        node.half[axis][k] = component(to_float(half), axis);
        node.axis[axis][k] = component(b.axis, axis);
    }
    const bool everywhere = b.theta_o >= std::numbers::pi_v<float>;
    node.radius[k] = float(std::min(length(half), radius_around(to_double(center), b)) * (1 + 1e-6));
    node.sin_o[k] = everywhere ? 0 : std::sin(b.theta_o);
    node.cos_o[k] = everywhere ? -1 : std::cos(b.theta_o);
    node.cos_e[k] = std::cos(b.theta_e);
    node.power[k] = float(b.power);
    node.sides[k] = b.two_sided ? 0x7fffffff : -1;
}

struct TreeBuilder {
    std::vector<Item> items;
    LightTreeShape& shape;

    // Index at which to split items [begin, end): the bucket boundary of least cost, or the median along the longest side.
    size_t split(size_t begin, size_t end, bool by_cost) {
        const std::span<Item> part(items.data() + begin, end - begin);
        const auto position = [](const Item& item) { return item.bounds.low + item.bounds.high; }; // of the centre, times 2
        Vec3 low = position(part[0]), high = low;
        for (const Item& item : part) {
            low = lower(low, position(item));
            high = upper(high, position(item));
        }
        const Vec3 size = high - low;
        const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        if (by_cost && component(size, longest) > 0 && part.size() > 2)
            if (const size_t found = split_by_cost(part, begin, low, size, longest)) return found;
        std::ranges::nth_element(part, part.begin() + std::ptrdiff_t(part.size() / 2), {},
                                 [&](const Item& item) { return component(position(item), longest); });
        return begin + part.size() / 2;
    }

    static constexpr int buckets = 12;
    static int bucket_of(const Item& item, int axis, const Vec3& low, const Vec3& size) {
        const float along = (component(item.bounds.low + item.bounds.high, axis) - component(low, axis)) / component(size, axis);
        return std::clamp(int(along * buckets), 0, buckets - 1);
    }

    // 0: no split. Large ranges are split along their longest side, which is nearly always best.
    size_t split_by_cost(std::span<Item> part, size_t begin, const Vec3& low, const Vec3& size, int longest) const {
        double best = 0;
        int best_axis = -1, best_bucket = 0;
        const Vec3 reference = part[0].bounds.axis;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(component(size, axis) > 0) || (part.size() > 1024 && axis != longest)) continue;
            std::array<Sum, buckets> sums{};
            for (const Item& item : part) sums[size_t(bucket_of(item, axis, low, size))].add(item.bounds, reference);
            std::array<Sum, buckets> from_right = sums;
            for (size_t k = buckets - 1; k-- > 0;) from_right[k].add(from_right[k + 1]);
            Sum from_left{};
            const double stretch = double(component(size, longest) / component(size, axis));
            for (size_t k = 0; k + 1 < buckets; ++k) {
                if (sums[k].power <= 0) continue; // an empty bucket: the same split as the one before it
                from_left.add(sums[k]);
                if (from_right[k + 1].power <= 0) break;
                const double total = stretch * (from_left.cost() + from_right[k + 1].cost());
                if (best_axis >= 0 && total >= best) continue;
                best = total;
                best_axis = axis;
                best_bucket = int(k);
            }
        }
        if (best_axis < 0) return 0;
        const auto second = std::ranges::partition(part, [&](const Item& i) { return bucket_of(i, best_axis, low, size) <= best_bucket; });
        return begin + size_t(second.begin() - part.begin());
    }

    // The ranges of the children of a node for items [begin, end), as their borders. The largest range is split until there are enough;
    // but ranges that fit into one node are not split further, because half empty nodes waste memory.
    std::vector<size_t> split_into_children(size_t begin, size_t end, int level) {
        std::vector<size_t> borders{begin, end};
        const size_t small = end - begin <= size_t(max_tree_children) ? 1 : size_t(max_tree_children);
        // Use medians if the remaining levels require it.
        const bool by_cost = (uint64_t(end - begin) << 2) <= uint64_t(1) << (tree_branch_bits * (max_levels - level));
        while (borders.size() <= size_t(max_tree_children)) {
            size_t largest = 0;
            for (size_t k = 1; k + 1 < borders.size(); ++k)
                if (borders[k + 1] - borders[k] > borders[largest + 1] - borders[largest]) largest = k;
            const size_t low = borders[largest], high = borders[largest + 1];
            if (high - low <= small) break;
            borders.insert(borders.begin() + std::ptrdiff_t(largest) + 1, split(low, high, by_cost));
        }
        return borders;
    }

    // Appends the subtree of items [begin, end). `workers`: builds large ones in parallel; null: does not.
    void build(std::vector<LightTreeNode>& nodes, size_t begin, size_t end, uint32_t trail, int level, const Workers* workers) {
        const std::vector<size_t> borders = split_into_children(begin, end, level);
        const size_t count = borders.size() - 1, self = nodes.size();
        nodes.emplace_back();
        nodes[self].first_leaf = uint32_t(begin);
        const auto trail_of = [&](size_t k) { return trail | uint32_t(k) << tree_branch_bits * level; };
        for (size_t k = 0; k < size_t(max_tree_children); ++k) {
            nodes[self].leaf_end[k] = uint32_t(borders[std::min(k + 1, count)]);
            if (k >= count) continue;
            set_child(nodes[self], int(k), bounds_of(std::span(items).subspan(borders[k], borders[k + 1] - borders[k])));
            if (borders[k + 1] - borders[k] > 1) continue;
            nodes[self].child[k] = ~int32_t(borders[k]);
            shape.items[borders[k]] = items[borders[k]].index;
            shape.trails[size_t(items[borders[k]].index)] = trail_of(k);
        }
        if (!workers || end - begin < parallel_items) {
            for (size_t k = 0; k < count; ++k) {
                if (borders[k + 1] - borders[k] == 1) continue;
                nodes[self].child[k] = int32_t(nodes.size() - self);
                build(nodes, borders[k], borders[k + 1], trail_of(k), level + 1, nullptr);
            }
            return;
        }
        std::array<std::vector<LightTreeNode>, size_t(max_tree_children)> below;
        workers->for_each(
            int64_t(count), [] { return true; },
            [&](int64_t i, unsigned) {
                const auto k = size_t(i);
                if (borders[k + 1] - borders[k] > 1) build(below[k], borders[k], borders[k + 1], trail_of(k), level + 1, nullptr);
            });
        for (size_t k = 0; k < count; ++k) {
            if (below[k].empty()) continue;
            nodes[self].child[k] = int32_t(nodes.size() - self);
            nodes.insert(nodes.end(), below[k].begin(), below[k].end());
        }
    }
};

// Selection powers by leaf. One sample in 64 is distributed uniformly over the triangles (uniform_share).
std::vector<double> with_uniform_share(std::span<const LightBounds> triangles, const LightTreeShape& shape) {
    double total = 0;
    for (const int32_t i : shape.items) total += triangles[size_t(i)].power;
    std::vector<double> powers;
    for (const int32_t i : shape.items)
        powers.push_back((1 - uniform_share) * triangles[size_t(i)].power / total + uniform_share / double(shape.items.size()));
    return powers;
}

// The middle of a cell of the octahedral map (direction_cell).
Vec3d cell_direction(int cell) {
    const auto side = [](int i) { return (i + 0.5) * 2 / direction_cells - 1; };
    const double x = side(cell % direction_cells), y = side(cell / direction_cells), z = 1 - std::abs(x) - std::abs(y);
    if (z >= 0) return normalize(Vec3d{x, y, z});
    return normalize(Vec3d{std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), z});
}

// Mean of max(0, cosine) over the receivers of a direction cell. `cosine`: between the triangle's normal and the cell's direction. The
// mean is taken over cosines that differ by up to 0.3. At the least distance at which the table is used, the cosines of all receivers in
// a cell differ from it by less than 0.85: if one of them is positive, the result is at least 0.02, never 0.
float seen_share(float cosine) {
    constexpr float blur = 0.3f, max_difference = 0.85f, floor = 0.02f;
    if (cosine <= -max_difference) return 0;
    const float above = cosine + blur;
    return floor + (cosine >= blur ? cosine : above > 0 ? above * above / (4 * blur) : 0);
}

std::vector<Item> usable_items(std::span<const LightBounds> bounds) {
    std::vector<Item> items;
    items.reserve(bounds.size());
    for (size_t i = 0; i < bounds.size(); ++i) {
        const Vec3 sum = bounds[i].low + bounds[i].high + bounds[i].axis;
        if (bounds[i].power > 0 && std::isfinite(sum.x + sum.y + sum.z)) items.push_back({bounds[i], int32_t(i)});
    }
    return items;
}

} // namespace

LightTreeShape build_light_tree(std::span<const LightBounds> bounds, const Workers& workers) {
    LightTreeShape shape;
    shape.trails.assign(bounds.size(), no_trail);
    TreeBuilder builder{usable_items(bounds), shape};
    if (builder.items.empty()) return shape;
    shape.items.resize(builder.items.size());
    // In the arena even if serial: its threads flush denormals.
    workers.run([&] { builder.build(shape.nodes, 0, builder.items.size(), 0, 0, &workers); });
    return shape;
}

void set_light_tree_powers(std::vector<LightTreeNode>& nodes, std::span<const double> powers) {
    std::vector<double> below(nodes.size(), 0.0);
    // Children have larger indices than their parents.
    for (size_t i = nodes.size(); i-- > 0;)
        for (int k = 0; k < max_tree_children; ++k) {
            const int32_t child = nodes[i].child[k];
            if (child == 0) continue;
            const double power = child < 0 ? powers[size_t(~child)] : below[i + size_t(child)];
            below[i] += power;
            nodes[i].power[k] = float(power);
        }
}

MeshTree::MeshTree(std::span<const LightBounds> triangles, const Workers& workers) : shape_(build_light_tree(triangles, workers)) {
    if (empty()) return;
    const std::vector<double> powers = with_uniform_share(triangles, shape_);
    set_light_tree_powers(shape_.nodes, powers);
    const size_t count = shape_.items.size();
    thresholds_ = make_thresholds(powers);
    const int guide_bits = std::clamp(int(std::bit_width(count / leaves_in_guide_cell)), 1, max_guide_bits);
    guide_ = make_guide(thresholds_, guide_bits);
    thresholds_.insert(thresholds_.end(), threshold_padding, ~0u);
    leaves_.assign(triangles.size(), 0);
    for (size_t i = 0; i < count; ++i) leaves_[size_t(shape_.items[i])] = int32_t(i);
    bounds_ = bounds_of(usable_items(triangles));
    const bool everywhere = bounds_.theta_e >= 0.5f * std::numbers::pi_v<float>;
    if (everywhere && int64_t(count) >= min_triangles_for_patches) tabulate_directions(triangles, powers, workers);
    tables_ = {thresholds_.data(),          shape_.items.data(), guide_.data(),   patches_.get(),  shape_.nodes.data(),
               shape_.trails.data(),        leaves_.data(),      uint32_t(count), 32 - guide_bits, patches_ != nullptr,
               to_float(center_of(bounds_))};
}

// Computes for each direction cell how much each patch contributes to distant receivers in that direction: the sum over its triangles of
// power times mean cosine.
void MeshTree::tabulate_directions(std::span<const LightBounds> triangles, std::span<const double> powers, const Workers& workers) {
    const size_t leaf_count = shape_.items.size();
    patches_ = std::make_unique<MeshPatches>();
    uint32_t* const begins = patches_->begins;
    std::fill_n(begins, mesh_patches + 1, uint32_t(leaf_count));
    for (size_t leaf = leaf_count; leaf-- > 0;) begins[thresholds_[leaf] >> (32 - patch_bits)] = uint32_t(leaf);
    for (size_t k = mesh_patches; k-- > 0;) begins[k] = std::min(begins[k], begins[k + 1]);
    workers.for_each(
        int64_t(direction_cells) * direction_cells, [] { return true; },
        [&](int64_t cell, unsigned) {
            const Vec3 towards = to_float(cell_direction(int(cell)));
            std::vector<double> given(mesh_patches, 0.0);
            for (size_t k = 0; k < size_t(mesh_patches); ++k)
                for (uint32_t leaf = begins[k]; leaf < begins[k + 1]; ++leaf) {
                    const LightBounds& triangle = triangles[size_t(shape_.items[leaf])];
                    const float cosine = dot(triangle.axis, towards);
                    given[k] += powers[leaf] * double(seen_share(triangle.two_sided ? std::abs(cosine) : cosine));
                }
            std::ranges::copy(make_thresholds(given), patches_->thresholds[cell]);
        });
}

size_t MeshTree::memory_bytes() const {
    return sizeof *this + shape_.nodes.capacity() * sizeof(LightTreeNode) + (patches_ ? sizeof(MeshPatches) : 0) +
           4 * (shape_.items.capacity() + shape_.trails.capacity() + thresholds_.capacity() + leaves_.capacity() + guide_.capacity());
}

int32_t LightTreeTable::add_mesh(const std::shared_ptr<const MeshTree>& mesh) {
    meshes.push_back(mesh);
    mesh_tables.push_back(mesh->tables());
    return int32_t(meshes.size()) - 1;
}

void LightTreeTable::find_root_lights() {
    root_lights.clear();
    if (nodes.empty()) return;
    for (const int32_t child : nodes[0].child) {
        if (child == 0) break;
        root_lights.push_back(child < 0 && entries[size_t(~child)].mesh < 0 ? entries[size_t(~child)].light : -1);
    }
}

LightTree LightTreeTable::tables() const {
    return {nodes.data(),
            entries.data(),
            mesh_tables.data(),
            root_lights.data(),
            distant.data(),
            int32_t(root_lights.size()),
            int32_t(distant.size()),
            {}};
}

size_t LightTreeTable::memory_bytes() const {
    size_t bytes = nodes.capacity() * sizeof(LightTreeNode) + entries.capacity() * sizeof(LightTreeEntry);
    for (const auto& mesh : meshes) bytes += mesh->memory_bytes();
    return bytes;
}

} // namespace blush
