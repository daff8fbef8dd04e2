#include "scene/animation/deform.h"

#include "core/math.h"
#include "scene/affine.h"
#include "scene/animation/pose.h"
#include "scene/geometry/arena_geometry.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

bool is_zero(float weight) { return weight == 0; }

// Morphing: adds each target's offsets, scaled by its weight.
void morph(std::vector<Vec3d>& vectors, const Geometry& g, const std::vector<float>& weights, std::vector<Vec3> MorphTarget::*offsets) {
    for (size_t t = 0; t < std::min(g.targets.size(), weights.size()); ++t) {
        const std::vector<Vec3>& by = (*g.targets[t]).*offsets;
        if (is_zero(weights[t]) || by.size() != vectors.size()) continue;
        for (size_t i = 0; i < vectors.size(); ++i) vectors[i] = vectors[i] + to_double(by[i]) * double(weights[t]);
    }
}

std::vector<Vec3d> in_double(const GeometryArray<Vec3>& vectors) {
    std::vector<Vec3d> result;
    result.reserve(vectors.size());
    for (const Vec3& v : vectors) result.push_back(to_double(v));
    return result;
}

// Linear blend skinning: the joint matrices, weighted by their influences on the vertex.
Affined blended(const Geometry& g, const Deformation& bend, size_t vertex) {
    const size_t per_vertex = g.influences.size() / g.positions.size();
    Affined sum{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    for (size_t k = 0; k < per_vertex; ++k) {
        const Influence& by = g.influences[vertex * per_vertex + k];
        if (is_zero(by.weight)) continue;
        const Affined& m = by.joint < bend.joints.size() ? bend.joints[by.joint] : bend.rigid;
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

// Face normals, for vertices that belong to one triangle each.
void face_normals(Geometry& g) {
    for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
        const Vec3d a = to_double(g.positions[g.indices[i]]);
        const Vec3d n = cross(to_double(g.positions[g.indices[i + 1]]) - a, to_double(g.positions[g.indices[i + 2]]) - a);
        for (size_t k = 0; k < 3; ++k) g.normals[g.indices[i + k]] = unit(n, g.normals[g.indices[i + k]]);
    }
}

// From mesh space to the space around the first joint.
std::vector<Affined> joint_maps(const Skin& skin, WorldTransforms& placements, const Vec3d& origin) {
    std::vector<Affined> maps;
    maps.reserve(skin.joints.size());
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        Affined m = placements(skin.joints[j]).world_from_node * to_double(skin.joint_from_mesh[j]);
        m.t = m.t - origin;
        maps.push_back(m);
    }
    return maps;
}

bool has(const Mesh& mesh, auto Geometry::*what) {
    return std::ranges::any_of(mesh.parts, [&](const MeshPart& part) { return part.geometry && !((*part.geometry).*what).empty(); });
}

} // namespace

std::optional<Deformation> deformation_of(const Scene& scene, WorldTransforms& placements, Id<Node> id, const Node& node) {
    const Skin* skin = node.skin ? scene.skins.find(node.skin) : nullptr;
    std::vector<float> weights = posed_morph_weights(scene, id, node);
    if (std::ranges::all_of(weights, is_zero)) weights.clear();
    const Mesh* mesh = skin || !weights.empty() ? scene.meshes.find(node.mesh) : nullptr;
    if (!mesh) return {};
    const bool skinned = skin && !skin->joints.empty() && has(*mesh, &Geometry::influences);
    if (!skinned && (weights.empty() || !has(*mesh, &Geometry::targets))) return {};
    Deformation bend;
    bend.weights = std::move(weights);
    if (skinned) {
        bend.origin = placements(skin->joints.front()).world_from_node.t;
        bend.joints = joint_maps(*skin, placements, bend.origin);
        bend.rigid = placements(id).world_from_node;
        bend.rigid.t = bend.rigid.t - bend.origin;
    }
    return bend;
}

GeometryPtr deformed(const Geometry& rest, const Deformation& bend) {
    auto result = std::make_shared<Geometry>(rest);
    Geometry& g = *result;
    g.serial = next_payload_serial();
    g.targets.clear();
    g.influences.clear();
    std::vector<Vec3d> positions = in_double(rest.positions), normals = in_double(rest.normals), tangents;
    for (const Vec4& t : rest.tangents) tangents.push_back({t.x, t.y, t.z});
    morph(positions, rest, bend.weights, &MorphTarget::positions);
    morph(normals, rest, bend.weights, &MorphTarget::normals);
    morph(tangents, rest, bend.weights, &MorphTarget::tangents);
    for (size_t i = 0; i < positions.size(); ++i) {
        Affined map;
        if (!bend.joints.empty()) map = rest.influences.empty() ? bend.rigid : blended(rest, bend, i);
        Vec3 place = to_float(transform_point(map, positions[i]));
        if (!finite(place)) place = to_float(transform_point(bend.rigid, to_double(rest.positions[i])));
        g.positions[i] = finite(place) ? place : Vec3{0, 0, 0};
        if (!normals.empty()) {
            const double sign = determinant(map) < 0 ? -1 : 1;
            g.normals[i] = unit(transform_vector(cofactor(map), normals[i]) * sign, rest.normals[i]);
        }
        if (!tangents.empty()) {
            const Vec4& old = rest.tangents[i];
            const Vec3 t = unit(transform_vector(map, tangents[i]), {old.x, old.y, old.z});
            g.tangents[i] = {t.x, t.y, t.z, old.w};
        }
    }
    if (g.flat) face_normals(g);
    move_to_arena(g);
    return result;
}

DeformedMesh deformed_mesh(const Scene& scene, WorldTransforms& placements, Id<Node> id, const Node& node) {
    const Mesh* mesh = node.mesh ? scene.meshes.find(node.mesh) : nullptr;
    if (!mesh) return {};
    DeformedMesh placed{mesh->parts, placements(id).world_from_node};
    const std::optional<Deformation> bend = deformation_of(scene, placements, id, node);
    if (!bend) return placed;
    placed.world_from_mesh = world_from_deformed(*bend, placed.world_from_mesh);
    for (MeshPart& part : placed.parts)
        if (part.geometry) part.geometry = deformed(*part.geometry, *bend);
    return placed;
}

} // namespace blush
