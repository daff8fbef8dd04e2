#include "scene/animation/deform.h"

#include "core/math.h"
#include "core/parallel.h"
#include "scene/affine.h"
#include "scene/animation/pose.h"
#include "scene/geometry/arena_geometry.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace blush {
namespace {

bool is_zero(float weight) { return weight == 0; }

// Morphing: adds each target's offset to the vector of a vertex, scaled by its weight.
class Morph {
public:
    Morph(const Geometry& g, const std::vector<float>& weights, std::vector<Vec3> MorphTarget::*offsets, size_t vertices) {
        for (size_t t = 0; t < std::min(g.targets.size(), weights.size()); ++t) {
            const std::vector<Vec3>& by = (*g.targets[t]).*offsets;
            if (!is_zero(weights[t]) && by.size() == vertices) terms_.push_back({by.data(), double(weights[t])});
        }
    }
    Vec3d operator()(const Vec3& rest, size_t vertex) const {
        Vec3d sum = to_double(rest);
        for (const Term& term : terms_) sum = sum + to_double(term.offsets[vertex]) * term.weight;
        return sum;
    }

private:
    struct Term {
        const Vec3* offsets;
        double weight;
    };
    std::vector<Term> terms_;
};

// Linear blend skinning: the joint matrices, weighted by their influences on the vertex.
Affined blended(const Geometry& g, const Deformation& deformation, size_t vertex) {
    const size_t per_vertex = g.influences.size() / g.positions.size();
    Affined sum{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    for (size_t k = 0; k < per_vertex; ++k) {
        const Influence& by = g.influences[vertex * per_vertex + k];
        if (is_zero(by.weight)) continue;
        const Affined& m = by.joint < deformation.joints.size() ? deformation.joints[by.joint] : deformation.rigid;
        const double w = by.weight;
        sum = {sum.x + m.x * w, sum.y + m.y * w, sum.z + m.z * w, sum.t + m.t * w};
    }
    return sum;
}

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Normalised, as floats; `otherwise` if the vector has no direction.
Vec3 unit(const Vec3d& v, const Vec3& otherwise) {
    const double size = length(v);
    return size > 0 && std::isfinite(size) ? to_float(v * (1 / size)) : otherwise;
}

// Deforms ranges of vertices, each independent of the others.
class Deformer {
public:
    Deformer(const Geometry& rest, const Deformation& deformation, Geometry& result)
        : rest_(rest), deformation_(deformation), result_(result),
          positions_(rest, deformation.weights, &MorphTarget::positions, rest.positions.size()),
          normals_(rest, deformation.weights, &MorphTarget::normals, rest.normals.size()),
          tangents_(rest, deformation.weights, &MorphTarget::tangents, rest.tangents.size()) {}

    void vertices(size_t begin, size_t end) const {
        for (size_t i = begin; i < end; ++i) {
            Affined map;
            if (!deformation_.joints.empty()) map = rest_.influences.empty() ? deformation_.rigid : blended(rest_, deformation_, i);
            Vec3 place = to_float(transform_point(map, positions_(rest_.positions[i], i)));
            if (!finite(place)) place = to_float(transform_point(deformation_.rigid, to_double(rest_.positions[i])));
            result_.positions[i] = finite(place) ? place : Vec3{0, 0, 0};
            if (!rest_.normals.empty()) {
                const double sign = determinant(map) < 0 ? -1 : 1;
                const Vec3d normal = normals_(rest_.normals[i], i);
                result_.normals[i] = unit(transform_vector(cofactor(map), normal) * sign, rest_.normals[i]);
            }
            if (!rest_.tangents.empty()) {
                const Vec4& old = rest_.tangents[i];
                const Vec3 direction{old.x, old.y, old.z};
                const Vec3 t = unit(transform_vector(map, tangents_(direction, i)), direction);
                result_.tangents[i] = {t.x, t.y, t.z, old.w};
            }
        }
    }
    // Face normals, for vertices that belong to one triangle each.
    void face_normals(size_t first_triangle, size_t end) const {
        Geometry& g = result_;
        for (size_t i = 3 * first_triangle; i < 3 * end; i += 3) {
            const Vec3d a = to_double(g.positions[g.indices[i]]);
            const Vec3d n = cross(to_double(g.positions[g.indices[i + 1]]) - a, to_double(g.positions[g.indices[i + 2]]) - a);
            for (size_t k = 0; k < 3; ++k) g.normals[g.indices[i + k]] = unit(n, g.normals[g.indices[i + k]]);
        }
    }

private:
    const Geometry& rest_;
    const Deformation& deformation_;
    Geometry& result_;
    Morph positions_, normals_, tangents_;
};

// Calls work(begin, end) for ranges that cover [0, count), on all workers.
void in_ranges(size_t count, const Workers* workers, const std::function<void(size_t begin, size_t end)>& work) {
    constexpr size_t range = 4096;
    if (!workers || count <= range) return work(0, count);
    workers->for_each(int64_t((count + range - 1) / range), {},
                      [&](int64_t i, unsigned) { work(size_t(i) * range, std::min(count, size_t(i + 1) * range)); });
}

// From mesh space to the space around the first joint.
std::vector<Affined> joint_maps(const Skin& skin, WorldTransforms& transforms, const Vec3d& origin) {
    std::vector<Affined> maps;
    maps.reserve(skin.joints.size());
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        Affined m = transforms(skin.joints[j]).world_from_node * to_double(skin.joint_from_mesh[j]);
        m.t = m.t - origin;
        maps.push_back(m);
    }
    return maps;
}

bool has(const Mesh& mesh, auto Geometry::*what) {
    return std::ranges::any_of(mesh.parts, [&](const MeshPart& part) { return part.geometry && !((*part.geometry).*what).empty(); });
}

} // namespace

std::optional<Deformation> deformation_of(const Scene& scene, WorldTransforms& transforms, Id<Node> id, const Node& node) {
    const Skin* skin = node.skin ? scene.skins.find(node.skin) : nullptr;
    std::vector<float> weights = posed_morph_weights(scene, id, node);
    if (std::ranges::all_of(weights, is_zero)) weights.clear();
    const Mesh* mesh = skin || !weights.empty() ? scene.meshes.find(node.mesh) : nullptr;
    if (!mesh) return {};
    const bool skinned = skin && !skin->joints.empty() && has(*mesh, &Geometry::influences);
    if (!skinned && (weights.empty() || !has(*mesh, &Geometry::targets))) return {};
    Deformation deformation;
    deformation.weights = std::move(weights);
    if (skinned) {
        deformation.origin = transforms(skin->joints.front()).world_from_node.t;
        deformation.joints = joint_maps(*skin, transforms, deformation.origin);
        deformation.rigid = transforms(id).world_from_node;
        deformation.rigid.t = deformation.rigid.t - deformation.origin;
    }
    return deformation;
}

GeometryPtr deformed(const Geometry& rest, const Deformation& deformation, const Workers* workers) {
    auto result = std::make_shared<Geometry>();
    Geometry& g = *result;
    copy_arrays(rest, g);
    g.generated_tangents = rest.generated_tangents;
    g.flat = rest.flat;
    const Deformer deformer(rest, deformation, g);
    in_ranges(g.positions.size(), workers, [&](size_t begin, size_t end) { deformer.vertices(begin, end); });
    if (g.flat) in_ranges(g.triangle_count(), workers, [&](size_t begin, size_t end) { deformer.face_normals(begin, end); });
    return result;
}

DeformedMesh deformed_mesh(const Scene& scene, WorldTransforms& transforms, Id<Node> id, const Node& node) {
    const Mesh* mesh = node.mesh ? scene.meshes.find(node.mesh) : nullptr;
    if (!mesh) return {};
    DeformedMesh placed{mesh->parts, transforms(id).world_from_node};
    const std::optional<Deformation> deformation = deformation_of(scene, transforms, id, node);
    if (!deformation) return placed;
    placed.world_from_mesh = world_from_deformed(*deformation, placed.world_from_mesh);
    for (MeshPart& part : placed.parts)
        if (part.geometry) part.geometry = deformed(*part.geometry, *deformation);
    return placed;
}

} // namespace blush
