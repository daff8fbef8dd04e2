#include "render/pilots/kept_field.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "render/lights/caustic_caster_table.h"
#include "scene/affine.h"
#include "scene/changed_records.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr double half_angle = 4 * std::numbers::pi / 180; // of a light's move: learned directions are worth half
constexpr double half_shift = 1.0 / 8;                    // of a caster's move, in its radii
constexpr double reshaped_factor = 0.5;                   // of another shape of the emission
constexpr size_t max_places = 32;                         // read after an edit; an edit of more is worth a fresh start

double factor_of(double moved, double half) { return std::exp2(-moved / half); }

double angle_between(const Vec3d& a, const Vec3d& b) {
    const double lengths = std::sqrt(dot(a, a) * dot(b, b));
    return lengths > 0 ? std::acos(std::clamp(dot(a, b) / lengths, -1.0, 1.0)) : 0;
}

// The largest angle between two points as the casters see them.
double angle_moved(const Vec3d& from, const Vec3d& to, const CausticCasterTables& casters, const Vec3d& origin) {
    double angle = 0;
    for (int k = 0; k < casters.count; ++k) {
        const Vec3d center = to_double(casters.spheres[k].center) + origin;
        angle = std::max(angle, angle_between(from - center, to - center));
    }
    return angle;
}

bool same_emission_shape(const Light& a, const Light& b) {
    return a.kind == b.kind && a.radius == b.radius && a.angle_radians == b.angle_radians && a.inner_cone_radians == b.inner_cone_radians &&
           a.outer_cone_radians == b.outer_cone_radians && a.width == b.width && a.height == b.height && a.two_sided == b.two_sided &&
           a.spread_radians == b.spread_radians && a.ies == b.ies;
}

bool emits(const Material& m) { return std::max({m.emissive.x, m.emissive.y, m.emissive.z}) * m.emissive_strength > 0; }

// True if one of the mesh's materials satisfies the predicate.
template <class Predicate> bool has_material(const Scene& scene, Id<Node> id, const Predicate& predicate) {
    const Node* node = scene.nodes.find(id);
    const Mesh* mesh = node ? scene.meshes.find(node->mesh) : nullptr;
    return mesh && std::ranges::any_of(mesh->parts, [&](const MeshPart& part) {
               const Material* material = scene.materials.find(part.material);
               return material && predicate(*material);
           });
}

FieldEffect dropped_field() {
    FieldEffect effect;
    effect.dropped = true;
    return effect;
}

// True if no light and no caster is new, and those that changed shine and focus as before but for place, intensity and colour.
bool keeps_chains(const Scene& before, const Scene& after, const Changes& changes) {
    if (changes.integrator || changes.resolution || !changes.structure.empty() || !changes.meshes.empty() || !changes.textures.empty())
        return false;
    const auto shines_alike = [](const Light& a, const Light& b) {
        return same_emission_shape(a, b) && a.enabled == b.enabled && (a.intensity > 0) == (b.intensity > 0);
    };
    const auto focuses_alike = [](const Material& a, const Material& b) {
        return emits(a) == emits(b) && !may_cast_caustics(a) && !may_cast_caustics(b);
    };
    return all_keep(before.lights, after.lights, changes.lights, shines_alike) &&
           all_keep(before.materials, after.materials, changes.materials, focuses_alike);
}

struct EffectOfEdit {
    const Scene &before, &after;
    const CausticCasterTables& casters;
    const Vec3d& origin;
    FieldEffect effect = {};

    void decay(double factor) { effect.factor *= factor; }

    void on_object(Id<Node> id) {
        const auto bounds_of = [&](const Scene& scene) { return scene.nodes.find(id) ? world_bounds(scene, id) : Bounds{}; };
        const Bounds was = bounds_of(before), is = bounds_of(after);
        for (const Bounds& box : {was, is})
            if (!box.empty) effect.cleared.push_back(box);
        const bool both = !was.empty && !is.empty;
        if (has_material(before, id, emits) || has_material(after, id, emits))
            decay(both ? factor_of(angle_moved(was.center(), is.center(), casters, origin), half_angle) : reshaped_factor);
        if (!has_material(before, id, may_cast_caustics) && !has_material(after, id, may_cast_caustics)) return;
        if (!both) return decay(reshaped_factor);
        const Vec3d shift = is.center() - was.center();
        decay(factor_of(std::sqrt(dot(shift, shift)) / std::max(1e-6, is.radius()), half_shift));
    }
    void on_light_node(Id<Node> id) {
        const Light* light = after.lights.find(after.nodes.find(id)->light);
        if (!light || !before.nodes.find(id)) return decay(reshaped_factor);
        const Affined was = world_from_node(before, id), is = world_from_node(after, id);
        // Points do not shine in a direction; of the others a turn changes how bright they are, not where they are.
        const double angle = light->kind == Light::Kind::sun ? angle_between(was.z, is.z) : angle_moved(was.t, is.t, casters, origin);
        decay(factor_of(angle, half_angle));
    }
    void on_light(Id<Light> id) {
        const Light *was = before.lights.find(id), *is = after.lights.find(id);
        if (!was || !is || !same_emission_shape(*was, *is)) decay(reshaped_factor);
    }
    void on_environment() {
        const double turned = std::abs(double(after.environment.rotation_degrees) - double(before.environment.rotation_degrees));
        decay(factor_of(std::min(turned, 180.0) * std::numbers::pi / 180, half_angle));
    }
};

} // namespace

FieldEffect effect_on_field(const Scene& before, const Scene& after, const Changes& changes, const CausticCasterTables& casters,
                            const Vec3d& origin) {
    EffectOfEdit edit{before, after, casters, origin};
    const size_t places = changes.structure.size() + changes.moved_meshes.size() + changes.transforms.size() + changes.lights.size();
    if (changes.motion || changes.environment_image || places > max_places) return dropped_field();
    std::vector<Id<Node>> objects = changes.structure;
    objects.insert(objects.end(), changes.moved_meshes.begin(), changes.moved_meshes.end());
    if (!changes.meshes.empty())
        for (const auto& [id, node] : after.nodes)
            if (std::ranges::find(changes.meshes, node.mesh) != changes.meshes.end()) objects.push_back(id);
    std::ranges::sort(objects);
    objects.erase(std::ranges::unique(objects).begin(), objects.end());
    if (objects.size() > max_places) return dropped_field();
    for (const Id<Node> id : objects) edit.on_object(id);
    if (!changes.transforms.empty())
        for (const Id<Node> id : nodes_with_lights(after)) edit.on_light_node(id);
    for (const Id<Light> id : changes.lights) edit.on_light(id);
    if (changes.environment_parameters) edit.on_environment();
    edit.effect.edits = changes.affects_image() ? 1 : 0;
    edit.effect.same_chains = keeps_chains(before, after, changes);
    return std::move(edit.effect);
}

bool KeptField::follow(const FieldEffect& effect, const Vec3d& origin) {
    if (effect.dropped || origin != origin_) return false;
    edits_ += effect.edits;
    if (effect.factor < 1) field_.weaken(effect.factor);
    for (const Bounds& box : effect.cleared) field_.forget(to_float(box.low - origin), to_float(box.high - origin));
    return !field_.empty();
}

} // namespace blush
