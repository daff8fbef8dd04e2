#include "io/gltf/read/geometry/geometry.h"

#include "core/for_ranges.h"
#include "core/math.h"
#include "io/gltf/check/lint.h"
#include "io/gltf/read/extras.h"
#include "io/gltf/read/geometry/accessors.h"
#include "io/gltf/read/geometry/deform.h"
#include "io/gltf/read/geometry/points_lines.h"
#include "scene/affine.h"
#include "scene/geometry/arena_geometry.h"
#include "scene/geometry/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <span>
#include <type_traits>

namespace blush {
namespace {

bool finite(const Vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite(const Vec4& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w); }

// Reads an attribute as vectors, large meshes straight to where they stay; empty if the primitive does not have it.
template <class V> Result<GeometryArray<V>> read_attribute(const GltfContext& context, const tinygltf::Primitive& primitive,
                                                           const std::string& name, int min_components, const Geometry& g,
                                                           Attribute attribute, const std::string& where) {
    constexpr int floats = sizeof(V) / sizeof(float);
    GeometryArray<V> vectors;
    const auto it = primitive.attributes.find(name);
    if (it == primitive.attributes.end() || is_fallback(gltf_item(context.json(), "accessors", size_t(it->second)))) return vectors;
    int components = 0;
    const auto read = read_floats(context, it->second, min_components, floats, where + "." + name, [&](size_t count, int given) {
        components = given;
        vectors = unset_array<V>(g.storage, attribute, count);
        return FloatRoom{reinterpret_cast<float*>(vectors.data()), floats};
    });
    if (!read) return read.error();
    // COLOR_0 may have three components; alpha is then 1.
    if constexpr (std::is_same_v<V, Vec4>)
        if (components == 3)
            for (Vec4& v : vectors) v.w = 1;
    return vectors;
}

template <class V> void replace_non_finite(const GltfContext& context, GeometryArray<V>& values, V otherwise, const std::string& name,
                                           const std::string& where) {
    const size_t bad = count_in_ranges(values.size(), context.options.threads, [&](size_t i) {
        const bool is_bad = !finite(values[i]);
        if (is_bad) values[i] = otherwise;
        return is_bad;
    });
    if (bad) context.warn(fmt::format("{} non-finite values of {} replaced", bad, name), where);
}

std::string uv_attribute(int set) { return fmt::format("TEXCOORD_{}", set); }

Result<void> read_attributes(const GltfContext& context, const tinygltf::Primitive& primitive, const std::vector<int>& uv_sets, Geometry& g,
                             const std::string& where) {
    const auto take = [&](auto& target, const std::string& name, int min_components, Attribute attribute) -> Result<void> {
        using V = typename std::remove_reference_t<decltype(target)>::value_type;
        Result<GeometryArray<V>> values = read_attribute<V>(context, primitive, name, min_components, g, attribute, where);
        if (!values) return values.error();
        target = *std::move(values);
        if (!target.empty() && target.size() != g.positions.size())
            return context.error(fmt::format("{} has {} elements for {} positions", name, target.size(), g.positions.size()), where);
        return {};
    };
    if (auto ok = take(g.positions, "POSITION", 3, Attribute::positions); !ok) return ok;
    if (auto ok = take(g.normals, "NORMAL", 3, Attribute::normals); !ok) return ok;
    if (auto ok = take(g.tangents, "TANGENT", 4, Attribute::tangents); !ok) return ok;
    if (auto ok = take(g.colors, "COLOR_0", 3, Attribute::colors); !ok) return ok;
    for (const int set : uv_sets) {
        GeometryArray<Vec2> uv;
        if (auto ok = take(uv, uv_attribute(set), 2, uv_attribute_of(set)); !ok) return ok;
        if (uv.empty()) continue;
        replace_non_finite(context, uv, Vec2{0, 0}, uv_attribute(set), where);
        g.uv.resize(size_t(set) + 1);
        g.uv.back() = std::move(uv);
    }
    replace_non_finite(context, g.colors, Vec4{1, 1, 1, 1}, "COLOR_0", where);
    return {};
}

// Three indices per triangle from the vertex order of a list, strip or fan (glTF 2.0, 3.7.2.1), front faces counter-clockwise.
GeometryArray<uint32_t> triangulate(GeometryArray<uint32_t> order, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        order.resize(order.size() - order.size() % 3);
        return order;
    }
    GeometryArray<uint32_t> triangles;
    for (size_t i = 0; i + 2 < order.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            triangles.insert(triangles.end(), {order[i + 1], order[i + 2], order[0]});
        else
            triangles.insert(triangles.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
    }
    return triangles;
}

// The numbers 0, 1, 2, ...
void count_up(const GltfContext& context, GeometryArray<uint32_t>& numbers) {
    for_ranges(numbers.size(), context.options.threads, [&](size_t begin, size_t end) {
        std::iota(numbers.begin() + std::ptrdiff_t(begin), numbers.begin() + std::ptrdiff_t(end), uint32_t(begin));
    });
}

Result<GeometryArray<uint32_t>> vertex_order(const GltfContext& context, const tinygltf::Primitive& primitive, const Geometry& g,
                                             const std::string& where) {
    const size_t vertices = g.positions.size();
    if (primitive.indices < 0) {
        GeometryArray<uint32_t> order = unset_indices(g.storage, vertices);
        count_up(context, order);
        return order;
    }
    GeometryArray<uint32_t> order;
    const auto read = read_indices(context, primitive.indices, where + ".indices", [&](size_t count) {
        order = unset_indices(g.storage, count);
        return order.data();
    });
    if (!read) return read.error();
    const auto is_beyond = [&](uint32_t i) { return i >= vertices; };
    if (count_in_ranges(order.size(), context.options.threads, [&](size_t i) { return is_beyond(order[i]); }) > 0)
        return context.error(
            fmt::format("index {} is not below the number of vertices, {}", *std::ranges::find_if(order, is_beyond), vertices),
            where + ".indices");
    return order;
}

// Removes triangles with a non-finite corner, and sets the vertices that become unused to finite values.
Result<void> drop_non_finite_triangles(const GltfContext& context, Geometry& g, const std::string& where) {
    const auto is_bad = [&](size_t i) { return !finite(g.positions[i]); };
    if (count_in_ranges(g.positions.size(), context.options.threads, is_bad) == 0) return {};
    auto kept = g.indices.begin();
    for (auto corner = g.indices.begin(); corner != g.indices.end(); corner += 3)
        if (finite(g.positions[corner[0]]) && finite(g.positions[corner[1]]) && finite(g.positions[corner[2]]))
            for (int k = 0; k < 3; ++k) *kept++ = corner[k];
    const auto dropped = (g.indices.end() - kept) / 3;
    if (kept == g.indices.begin()) return context.error("every triangle has a NaN or infinite position", where);
    if (dropped) context.warn(fmt::format("{} triangles with a NaN or infinite position skipped", dropped), where);
    g.indices.erase(kept, g.indices.end());
    for (Vec3& p : g.positions)
        if (!finite(p)) p = {0, 0, 0};
    return {};
}

// Face normal scaled by twice the area.
Vec3d area_normal(const Geometry& g, size_t triangle) {
    const Vec3d a = to_double(g.positions[g.indices[3 * triangle]]);
    return cross(to_double(g.positions[g.indices[3 * triangle + 1]]) - a, to_double(g.positions[g.indices[3 * triangle + 2]]) - a);
}

Vec3 unit_or_up(const Vec3d& n) {
    const double size = length(n);
    return size > 0 && std::isfinite(size) ? to_float(n * (1 / size)) : Vec3{0, 0, 1};
}

// glTF 2.0, 3.7.2.1: flat normals if there are none; each triangle then gets its own vertices.
void make_flat(const GltfContext& context, Geometry& g) {
    const size_t corners = g.indices.size();
    const std::shared_ptr<const void> storage = reserve_in_arena(corners, corners);
    const auto for_corners = [&](const std::function<void(size_t, size_t)>& work) { for_ranges(corners, context.options.threads, work); };
    const auto unweld = [&](auto& values, Attribute attribute) {
        if (values.empty()) return;
        auto own = unset_array<typename std::remove_reference_t<decltype(values)>::value_type>(storage, attribute, corners);
        for_corners([&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) own[i] = values[g.indices[i]];
        });
        values = std::move(own);
    };
    unweld_deformation(g);
    unweld(g.positions, Attribute::positions);
    for (size_t set = 0; set < g.uv.size(); ++set) unweld(g.uv[set], uv_attribute_of(int(set)));
    unweld(g.colors, Attribute::colors);
    g.tangents.clear(); // the specification requires tangents without normals to be ignored
    g.indices = unset_indices(storage, corners);
    count_up(context, g.indices);
    g.normals = unset_array<Vec3>(storage, Attribute::normals, corners);
    g.flat = true;
    g.storage = storage;
    for_ranges(g.triangle_count(), context.options.threads, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) std::fill_n(g.normals.begin() + std::ptrdiff_t(3 * t), 3, unit_or_up(area_normal(g, t)));
    });
}

// Replaces zero and non-finite normals by the area-weighted mean of the adjacent face normals.
void repair_normals(const GltfContext& context, Geometry& g, const std::string& where) {
    const auto usable = [](const Vec3& n) { return finite(n) && length(to_double(n)) > 1e-12; };
    const size_t bad = count_in_ranges(g.normals.size(), context.options.threads, [&](size_t i) { return !usable(g.normals[i]); });
    if (!bad) return;
    std::vector<Vec3d> sums(g.normals.size(), Vec3d{0, 0, 0});
    for (size_t t = 0; t < g.triangle_count(); ++t)
        for (size_t corner = 0; corner < 3; ++corner) {
            Vec3d& sum = sums[g.indices[3 * t + corner]];
            sum = sum + area_normal(g, t);
        }
    for (size_t i = 0; i < sums.size(); ++i)
        if (!usable(g.normals[i])) g.normals[i] = unit_or_up(sums[i]);
    context.warn(fmt::format("{} zero or non-finite normals replaced by those of adjacent triangles", bad), where);
}

void provide_tangents(const GltfContext& context, Geometry& g, int uv_set, const std::string& where) {
    const bool usable = !g.tangents.empty() && std::all_of(g.tangents.begin(), g.tangents.end(), [](const Vec4& t) {
        return finite(t) && t.x * t.x + t.y * t.y + t.z * t.z > 0;
    });
    if (!usable && !g.tangents.empty()) context.warn("tangents of zero or non-finite length", where);
    if (!usable) g.tangents.clear();
    size_t sides = 0;
    for (Vec4& t : g.tangents) {
        if (std::abs(t.w) == 1) continue;
        t.w = t.w < 0 ? -1.0f : 1.0f;
        ++sides;
    }
    if (sides) context.warn(fmt::format("{} tangents have a handedness other than 1 or -1; its sign is used", sides), where);
    if (usable || uv_set < 0) return;
    if (!g.has_uv_set(uv_set)) {
        context.warn("the normal map has no effect: the primitive lacks its texture coordinates", where);
        return;
    }
    add_tangents(g, uv_set);
    context.note("tangents are missing: computed from texture coordinates as MikkTSpace does", where);
    if (!g.targets.empty() || !g.influences.empty())
        context.note("approximated: generated tangents are deformed with the mesh instead of being recomputed for each pose", where);
}

GeometryPtr solids(const GltfContext& context, const Geometry& vertices, std::span<const uint32_t> order, int mode,
                   const std::string& where) {
    Solids made = solids_of(vertices, order, mode);
    const char* what = mode == TINYGLTF_MODE_POINTS ? "points" : "lines";
    if (made.left_out > 0)
        context.warn(fmt::format("ignored: {} {} that are not finite, of zero length or beyond the limit", made.left_out, what), where);
    if (made.shown == 0) return {};
    context.note(fmt::format("approximated: {} {} shown as {} of radius {:.3g}, since they have no surface", made.shown, what,
                             mode == TINYGLTF_MODE_POINTS ? "balls" : "tubes", made.radius),
                 where);
    move_to_arena(made.geometry);
    return std::make_shared<const Geometry>(std::move(made.geometry));
}

// Room in the arena for a mesh of which no vertex is split. Others get theirs when their numbers are known.
std::shared_ptr<const void> room_for(const GltfContext& context, const tinygltf::Primitive& primitive) {
    const auto positions = primitive.attributes.find("POSITION");
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES || positions == primitive.attributes.end() || !primitive.attributes.contains("NORMAL"))
        return {};
    const uint64_t vertices = accessor_count(context, positions->second);
    return reserve_in_arena(vertices, primitive.indices < 0 ? vertices : accessor_count(context, primitive.indices));
}

void report_ignored(const GltfContext& context, const tinygltf::Primitive& primitive, const std::vector<int>& uv_sets,
                    const std::string& where) {
    constexpr std::array read = {"POSITION", "NORMAL", "TANGENT", "COLOR_0"};
    const auto is_read = [&](const std::string& name) {
        return std::ranges::find(read, name) != read.end() || std::ranges::find(uv_sets, name, uv_attribute) != uv_sets.end();
    };
    for (const auto& [name, accessor] : primitive.attributes) {
        if (is_read(name) || is_influence(name)) continue;
        const std::string what =
            "ignored: attribute " + name.substr(0, 100) + (name.starts_with("TEXCOORD_") ? ", which no texture uses" : "");
        if (name.starts_with("_") || name.starts_with("TEXCOORD_") || name.starts_with("COLOR_"))
            context.note(what, where);
        else
            context.warn(what + ", which is not a glTF attribute", where);
    }
}

} // namespace

Result<GeometryPtr> import_primitive(const GltfContext& context, const tinygltf::Primitive& primitive, const VertexNeeds& needs,
                                     const std::string& where) {
    report_ignored(context, primitive, needs.uv_sets, where);
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        context.warn(fmt::format("ignored: unknown primitive mode {}", primitive.mode), where);
        return GeometryPtr();
    }
    auto geometry = std::make_shared<Geometry>();
    Geometry& g = *geometry;
    g.storage = room_for(context, primitive);
    if (const auto ok = read_attributes(context, primitive, needs.uv_sets, g, where); !ok) return ok.error();
    if (const auto ok = read_deformation(context, primitive, g, where); !ok) return ok.error();
    auto order = vertex_order(context, primitive, g, where);
    if (!order) return order.error();
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) return solids(context, g, *order, primitive.mode, where);
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES && order->size() % 3 != 0)
        context.warn("the last triangle is incomplete and is skipped", where);
    g.indices = triangulate(*std::move(order), primitive.mode);
    if (g.indices.empty()) {
        context.warn("ignored: a primitive without triangles", where);
        return GeometryPtr();
    }
    if (const auto ok = drop_non_finite_triangles(context, g, where); !ok) return ok.error();
    report_geometry(context, g, where);
    if (g.normals.empty())
        make_flat(context, g);
    else
        repair_normals(context, g, where);
    provide_tangents(context, g, needs.tangent_uv_set, where);
    move_to_arena(g);
    return GeometryPtr(std::move(geometry));
}

} // namespace blush
