#include "render/diagnostics/vertex_recorder.h"

#include "render/compile/expanded_lights.h"
#include "scene/affine.h"
#include "scene/node_name.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush {
namespace {

constexpr Features replayed_features = all_features.with(Feature::light_paths);

Vec3 quotient(const Vec3& a, const Vec3& b) {
    const auto by = [](float x, float y) { return y != 0 ? x / y : 0.f; };
    return {by(a.x, b.x), by(a.y, b.y), by(a.z, b.z)};
}

} // namespace

// The BSDF of a vertex, as scatter() makes it (estimator.h).
struct VertexRecorder::Shaded {
    bool valid = false; // a surface with a material
    Surface<float> surface{};
    Bsdf<float> bsdf{};
    ShadingFrame<float> shading{};
    bool lambertian = false;
    Vec3 albedo{0, 0, 0};
};

struct VertexRecorder::Blocker {
    bool found = false;
    float distance = 0;
    int32_t object = 0;
};

VertexRecorder::VertexRecorder(const Scene& expanded, const RenderScene& compiled, const KernelContext& context)
    : scene_(expanded), compiled_(compiled), context_(context), far_(std::max(compiled.bounding_sphere().radius, 1e-3f)),
      rays_(std::make_unique<ShadowQueue>()), hits_(std::make_unique<HitColumns>()) {}

Vec3d VertexRecorder::world(const Vec3& position) const { return to_double(position) + compiled_.origin(); }

std::string VertexRecorder::name_of(Id<Node> node) const {
    const Id<Node> id{node.value & ~expanded_id_bit};
    const Node* found = scene_.nodes.find(id);
    return found ? node_name(scene_, id, *found) : "environment";
}

VertexRecorder::Shaded VertexRecorder::shade(const ReplayedVertex& replayed) const {
    constexpr Features s = replayed_features;
    Shaded shaded;
    const Hit<float>& hit = replayed.hit;
    shaded.valid = hit.geometry >= 0 && hit.instance != sphere_instance;
    if (!shaded.valid) return shaded;
    const SceneTables& scene = *context_.scene;
    const Path<float>& path = replayed.path;
    const float cone = cone_width<float>(scene.camera, context_.settings, path, hit.t);
    shaded.surface = surface_at<s, float>(scene, hit, true, filter_width<s, float>(scene, hit, cone, replayed.bounce, true));
    const Surface<float>& at = shaded.surface;
    MaterialPoint<float> material = material_at<s, float>(scene.materials, at.material, at.texture, at.color, true);
    const HitSide<float> side = hit_side<s, float>(at, material, path.ray.direction);
    shaded.shading = shading_frame_at<s, float>(at, material, side.wo, side.front, side.solid);
    Vec3 beta{1, 1, 1};
    disperse<s, float>(path, material.dispersion, side, true, material.bsdf.ior, beta);
    shaded.bsdf = make_bsdf<s, float>(material.bsdf, shaded.shading.wo, context_.settings.energy);
    shaded.lambertian = is_lambertian<s, float>(shaded.bsdf);
    shaded.albedo = albedo<s, float>(shaded.bsdf, shaded.shading.wo);
    return shaded;
}

Step<float> VertexRecorder::unit_step(const ReplayedVertex& replayed, Strategy strategy) const {
    EstimatorSettings settings = context_.settings;
    settings.mis.strategy = strategy;
    settings.roulette.rule = Roulette::Rule::off;
    Path<float> path = replayed.path;
    path.beta = {1, 1, 1};
    return scatter<replayed_features, float>(*context_.scene, settings, path, replayed.hit, replayed.bounce, true);
}

void VertexRecorder::record_place(const ReplayedVertex& replayed, PathVertex& v) const {
    const Ray<float>& ray = replayed.path.ray;
    const Hit<float>& hit = replayed.hit;
    v.direction = ray.direction;
    if (hit.geometry < 0) {
        v.met = Met::background;
        v.object = "environment";
        v.distance = std::numeric_limits<float>::infinity();
        v.position = world(ray.origin + ray.direction * far_);
        return;
    }
    v.distance = hit.t;
    v.position = world(ray.origin + ray.direction * hit.t);
    if (hit.instance == sphere_instance) {
        const LightTables& lights = compiled_.tables().lights;
        v.met = Met::sphere_light;
        v.object = object_name(lights.lights[lights.first_sphere + hit.triangle].object);
        return;
    }
    v.met = Met::surface;
}

void VertexRecorder::record_emission(const ReplayedVertex& replayed, const PathVertex* before, PathVertex& v) const {
    const Step<float>& step = replayed.step;
    v.arriving = step.weights.arriving;
    v.passed = before ? quotient(v.arriving, before->beta) : v.arriving;
    v.panes = replayed.panes;
    v.past = replayed.past;
    v.chains = replayed.chains;
    v.light_vertices = replayed.light_vertices;
    if (!step.emits) return;
    v.emits = true;
    v.emission = step.emitted;
    v.emission_mis = step.weights.emission;
    const Step<float> alone = unit_step(replayed, Strategy::bsdf);
    const float weight = alone.weights.emission;
    // Beside light paths the weight is not 1.
    v.radiance = weight > 0 ? quotient(alone.emitted, alone.weights.arriving) / weight : Vec3{0, 0, 0};
    if (is_black(v.color)) v.color = v.radiance;
}

void VertexRecorder::record_scattering(const ReplayedVertex& replayed, const Shaded& shaded, PathVertex& v) const {
    const Step<float>& step = replayed.step;
    const bool delta = std::isinf(step.next.pdf);
    const bool rolled = step.weights.rr_applied, goes_on = step.continues;
    if (goes_on || rolled || step.non_finite) {
        const Step<float> alone = unit_step(replayed, context_.settings.mis.strategy);
        v.factor = quotient(alone.next.beta, alone.weights.arriving);
        v.pdf = step.next.pdf;
        v.roulette = rolled;
        v.survival = rolled ? step.weights.survival : 1;
        v.beta = step.next.beta;
        v.scatters = delta               ? (step.crosses ? ScatterKind::delta_transmission : ScatterKind::delta_reflection)
                     : step.crosses      ? ScatterKind::transmission
                     : shaded.lambertian ? ScatterKind::diffuse
                                         : ScatterKind::glossy;
    }
    if (goes_on) return;
    if (v.met == Met::background)
        v.end = PathEnd::escaped;
    else if (step.non_finite)
        v.end = PathEnd::invalid;
    else if (rolled)
        v.end = PathEnd::roulette;
    else if (v.emits && is_black(shaded.albedo))
        v.end = PathEnd::light;
    else
        v.end = replayed.bounce >= context_.settings.max_bounces ? PathEnd::max_length : PathEnd::absorbed;
}

// The nearest thing on the shadow ray that is no pane. Blended surfaces dim the light and block none.
VertexRecorder::Blocker VertexRecorder::find_blocker(const ReplayedVertex& replayed) {
    constexpr int most_panes = 64;
    const Step<float>& step = replayed.step;
    Vec3 from = step.shadow.origin;
    const Vec3 direction = step.shadow.direction;
    float travelled = 0;
    for (int k = 0; k <= most_panes; ++k) {
        ShadowQueue& q = *rays_;
        q.ox[0] = from.x;
        q.oy[0] = from.y;
        q.oz[0] = from.z;
        q.dx[0] = direction.x;
        q.dy[0] = direction.y;
        q.dz[0] = direction.z;
        q.distance[0] = step.shadow_distance - travelled;
        q.random[0] = opacity_random<float>(replayed.path.key, replayed.path.index, uint32_t(2 * replayed.bounce + 1));
        q.mask[0] = step.shadow_mask;
        HitColumns& h = *hits_;
        const HitArrays hits{h.t, h.u, h.v, h.geometry, h.instance, h.triangle};
        if (context_.scene->blends)
            context_.accel->intersect_unblended(shadow_rays_of(context_, q), 1, false, hits);
        else
            trace_closest<float>(*context_.accel, shadow_rays_of(context_, q), 1, false, hits);
        const Hit<float> hit = load_hit<float>(h, 0);
        if (hit.geometry < 0) return {};
        if (hit.instance == sphere_instance) {
            const LightTables& lights = compiled_.tables().lights;
            return {true, travelled + hit.t, lights.lights[lights.first_sphere + hit.triangle].object};
        }
        const Surface<float> s = surface_at<replayed_features, float>(*context_.scene, hit, true);
        if (!context_.scene->panes || !is_pane<replayed_features, float>(*context_.scene, hit, true))
            return {true, travelled + hit.t, context_.scene->parts[s.part].object};
        travelled += hit.t;
        from = offset_origin<float>(s.position, s.error, s.ng, dot(s.ng, direction) > 0);
    }
    return {};
}

NextEvent VertexRecorder::next_event(const ReplayedVertex& replayed, const Shaded& shaded) {
    const Step<float>& step = replayed.step;
    const Vec3& wi = step.shadow.direction;
    NextEvent e;
    e.light = name_of(compiled_.light_node(step.light));
    e.from = world(step.shadow.origin);
    e.infinite = std::isinf(step.shadow_distance);
    e.light_pdf = step.weights.light_pdf;
    e.bsdf_pdf = step.weights.light_bsdf_pdf;
    e.mis = step.weights.light;
    e.sent = step.direct;
    e.arrived = replayed.arrived;
    e.f_cos = eval<replayed_features, float>(shaded.bsdf, shaded.shading.wo, shaded.shading.frame.to_local(wi)).f_cos;
    const Step<float> alone = unit_step(replayed, Strategy::light);
    const Vec3 through = alone.weights.arriving;
    const float over = alone.weights.light > 0 ? e.light_pdf / alone.weights.light : 0;
    e.radiance = quotient(quotient(alone.direct, through) * over, e.f_cos);
    e.blocked = !has_light<float>(e.arrived);
    float length = e.infinite ? far_ : step.shadow_distance;
    if (e.blocked)
        if (const Blocker blocker = find_blocker(replayed); blocker.found) {
            e.blocker = object_name(blocker.object);
            length = blocker.distance;
        }
    e.to = world(step.shadow.origin + wi * length);
    return e;
}

PathVertex VertexRecorder::record(const ReplayedVertex& replayed, const PathVertex* before) {
    PathVertex v;
    v.bounce = replayed.bounce;
    if (!before) guided_ = 0;
    v.guided = guided_;
    record_place(replayed, v);
    const Shaded shaded = shade(replayed);
    if (shaded.valid) {
        v.position = world(shaded.surface.position);
        v.normal = shaded.surface.ng;
        v.ns = shaded.surface.ns;
        v.color = shaded.albedo;
        v.object = object_name(context_.scene->parts[shaded.surface.part].object);
        const Id<Material> id = compiled_.material_id(shaded.surface.material);
        const Material* material = scene_.materials.find(id);
        v.material = !material ? "default material" : material->name.empty() ? "Material " + std::to_string(id.value) : material->name;
    }
    record_emission(replayed, before, v);
    record_scattering(replayed, shaded, v);
    if (shaded.valid && replayed.step.connects) v.next_event = next_event(replayed, shaded);
    // A delta lobe keeps the share of the direction before.
    if (replayed.step.continues && !std::isinf(replayed.step.next.pdf)) guided_ = replayed.step.weights.guided;
    return v;
}

} // namespace blush
