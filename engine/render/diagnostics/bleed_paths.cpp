#include "render/diagnostics/bleed_paths.h"

#include "render/compile/expanded_lights.h"
#include "render/integrator/wavefront.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace blush {
namespace {

constexpr Features probed = all_features;

// Who sent light to the probed surface, and from where.
struct Origin {
    BleedSender sender;
    Vec3d place{0, 0, 0};  // or the unit direction towards it
    bool infinite = false; // a direction
};

// Light of one sample.
struct Arrival {
    int slot;
    int32_t light; // its group
    int bounce;    // number of scatterings
    Vec3d rgb;
    Origin from;
};

class BleedPaths {
public:
    BleedPaths(const KernelContext& context, TileScratch& scratch) : context_(context), scene_(*context.scene), scratch_(scratch) {
        if (!scratch.trials) scratch.trials = std::make_unique<std::vector<ShadowTrial>>();
        for (Column<double>* c : {&scratch.r, &scratch.g, &scratch.b}) std::fill_n(c->data, bleed_batch_paths, 0.0);
        scratch.trials->clear();
    }

    void begin_pixels(const PixelRect& rect);
    void begin_outgoing(const Vec3& position, const Vec3& towards, float distance);
    // Traces the paths of the first queue; with `at_meter`, from the vertex behind the receiver on.
    void trace(bool at_meter);
    BleedSums sums(double factor) const;

private:
    // The light that a stage has added to a slot.
    Vec3d taken(int slot) {
        const Vec3d light{scratch_.r[slot], scratch_.g[slot], scratch_.b[slot]};
        scratch_.r[slot] = scratch_.g[slot] = scratch_.b[slot] = 0;
        return light;
    }
    static bool is_zero(const Vec3d& c) { return c.x == 0 && c.y == 0 && c.z == 0; }
    void note(int slot, int bounce, int32_t light, const Vec3d& rgb, const Origin& from) {
        if (!is_zero(rgb)) arrivals_.push_back({slot, light, bounce, rgb, from});
    }
    // Light that path k met by its ray: of the surface itself, of a light, or of the object before.
    void note_met(const PathQueue& now, int k, int bounce, int32_t light, const Vec3d& rgb) {
        const int slot = now.slot[k];
        if (bounce > 1) return note(slot, bounce, light, rgb, met_[size_t(slot)]);
        const bool escaped = scratch_.hits.geometry[k] < 0;
        const BleedSender sender = bounce == 0 ? BleedSender{} : BleedSender{SentBy::light, light};
        note(slot, bounce, light, rgb, {sender, escaped ? direction(now, k) : hit_point(now, k), escaped});
    }
    static Vec3d direction(const PathQueue& q, int k) { return {q.dx[k], q.dy[k], q.dz[k]}; }
    Vec3d hit_point(const PathQueue& q, int k) const {
        return Vec3d{q.ox[k], q.oy[k], q.oz[k]} + direction(q, k) * double(scratch_.hits.t[k]);
    }
    int32_t part_of_hit(int k) const {
        const int32_t instance = scratch_.hits.instance[k];
        return scratch_.hits.geometry[k] + (instance >= 0 ? scene_.instance_first_part[instance] : 0);
    }
    int32_t group_of_hit(int k) const {
        if (scratch_.hits.instance[k] == sphere_instance)
            return scene_.groups.of_light[scene_.lights.first_sphere + scratch_.hits.triangle[k]];
        return scene_.groups.of_part[part_of_hit(k)];
    }
    void note_places(const PathQueue& now, int bounce);
    void note_panes(const PathQueue& now, int bounce);
    void note_emission(const PathQueue& now, int bounce);
    Vec3d note_background(const PathQueue& now, int k, int bounce, double share, const Vec3d& found);
    void connect(int bounce);

    const KernelContext& context_;
    const SceneTables& scene_;
    TileScratch& scratch_;
    std::vector<Arrival> arrivals_;
    std::array<Origin, bleed_batch_paths> met_{}; // by slot: the object behind the probed surface
    Vec3d places_{0, 0, 0};
    int64_t hits_ = 0;
    std::vector<Arrival> shadows_; // of the bounce, before they are traced
};

// Path i takes its pixel by systematic sampling: equally spaced in the list of pixels, from a random offset on, so that each pixel is
// expected equally often. A pixel with several paths has its first samples.
void BleedPaths::begin_pixels(const PixelRect& rect) {
    const int64_t columns = rect.x1 - rect.x0, pixels = columns * (rect.y1 - rect.y0);
    const double offset = pixels > 1 ? double(pcg_hash(context_.seed ^ 0x2545f491u)) * 0x1p-32 : 0;
    const uint32_t half[2] = {randomisation(context_.seed, 0), randomisation(context_.seed, 1)};
    PathQueue& q = scratch_.paths[0];
    q.size = 0;
    int64_t before = -1;
    uint32_t sample = 0;
    for (int slot = 0; slot < bleed_batch_paths; ++slot) {
        const int64_t pixel = std::min(int64_t((double(slot) + offset) * double(pixels) / bleed_batch_paths) % pixels, pixels - 1);
        sample = pixel == before ? sample + 1 : 0;
        before = pixel;
        const uint32_t x = uint32_t(rect.x0 + pixel % columns), y = uint32_t(rect.y0 + pixel / columns);
        const bool random = context_.settings.sampler == SamplerType::random;
        const Sampler<float> sampler = random ? independent_sampler<float>(x, y, half[sample & 1], sample >> 1)
                                              : pixel_sampler<float>(x, y, half[sample & 1], sample >> 1);
        q.part[q.size] = from_camera;
        q.dispersed[q.size] = 0;
        append<probed, float>(q, begin_path<probed, float>(scene_, context_.settings, float(x), float(y), sampler, slot), true);
    }
}

// Rays that begin `distance` metres before the point, so that nothing between it and the camera blocks them. They see textures without a
// filter.
void BleedPaths::begin_outgoing(const Vec3& position, const Vec3& towards, float distance) {
    const uint32_t key = pixel_key<float>(0u, 0u, randomisation(context_.seed, 0));
    PathQueue& q = scratch_.paths[0];
    q.size = 0;
    for (int slot = 0; slot < bleed_batch_paths; ++slot) {
        Path<float> path = begin_path<probed, float>(scene_, context_.settings, 0.f, 0.f, Sampler<float>{key, uint32_t(slot)}, slot);
        path.ray = {position + towards * distance, -towards};
        path.cone = 0;
        q.part[q.size] = from_camera;
        q.dispersed[q.size] = 0;
        append<probed, float>(q, path, true);
    }
}

void BleedPaths::trace(bool at_meter) {
    PathQueue *now = &scratch_.paths[0], *next = &scratch_.paths[1];
    if (at_meter) connect(0);
    for (int bounce = at_meter ? 1 : 0; now->size > 0 && bounce <= max_path_length; ++bounce) {
        trace_paths<probed, float>(context_, scratch_, *now, *next, bounce);
        if (bounce <= 1) note_places(*now, bounce);
        if (scene_.panes) note_panes(*now, bounce);
        scratch_.trials->clear();
        shade_paths<probed, float>(context_, scratch_, *now, *next, bounce);
        note_emission(*now, bounce);
        connect(bounce);
        std::swap(now, next);
    }
}

void BleedPaths::note_places(const PathQueue& now, int bounce) {
    for (int k = 0; k < now.size; ++k) {
        if (scratch_.hits.geometry[k] < 0) continue;
        const Vec3d place = hit_point(now, k);
        if (bounce == 0) {
            places_ = places_ + place;
            ++hits_;
        } else if (scratch_.hits.instance[k] != sphere_instance) {
            const uint32_t object = uint32_t(scene_.parts[part_of_hit(k)].object) & ~expanded_id_bit;
            met_[size_t(now.slot[k])] = {{SentBy::object, int32_t(object)}, place, false};
        }
    }
}

// Panes add their emission while rays pass them.
void BleedPaths::note_panes(const PathQueue& now, int bounce) {
    for (int k = 0; k < now.size; ++k)
        if (const Vec3d rgb = taken(now.slot[k]); !is_zero(rgb)) note_met(now, k, bounce, glowing_pane, rgb);
}

void BleedPaths::note_emission(const PathQueue& now, int bounce) {
    const bool sees_past = sees_past_blended(scene_);
    for (int k = 0; k < now.size; ++k) {
        Vec3d found = taken(now.slot[k]);
        if (is_zero(found)) continue;
        const bool escaped = scratch_.hits.geometry[k] < 0;
        const double share = sees_past ? double((*scratch_.background_share)[k]) : 1;
        if (escaped || (sees_past && share > 0)) found = note_background(now, k, bounce, share, found);
        if (!escaped) note_met(now, k, bounce, group_of_hit(k), found);
    }
}

// Notes the lights of the background one by one, as add_background_by_group(). Returns the rest of `found`: emission of a blended surface
// that stopped the ray, not rounding.
Vec3d BleedPaths::note_background(const PathQueue& now, int k, int bounce, double share, const Vec3d& found) {
    Path<float> path = load_path<probed, float>(now, k);
    path.part = now.part[k];
    std::vector<std::pair<int32_t, Vec3d>> lights;
    Vec3d rest = found;
    for_each_background_light<probed, float>(
        scene_, context_.settings, path, bounce, true, [&](int32_t light, const Vec3& radiance, const float&, bool inside) {
            if (!inside) return;
            const Vec3d rgb = to_double(path.beta * radiance) * share;
            lights.emplace_back(light < 0 ? scene_.groups.environment : scene_.groups.of_light[light], rgb);
            rest = rest - rgb;
        });
    const bool escaped = scratch_.hits.geometry[k] < 0;
    const bool emission = !escaped && luminance(rest) > 1e-5 * luminance(found);
    // What the ray has met is the whole, so that the shares add up.
    if (!emission && !lights.empty()) lights.back().second = lights.back().second + rest;
    if (lights.empty()) lights.emplace_back(scene_.groups.environment, emission ? Vec3d{0, 0, 0} : found);
    for (const auto& [group, rgb] : lights) note_met(now, k, bounce, group, rgb);
    return emission ? rest : Vec3d{0, 0, 0};
}

// Adds the light of the queued shadow rays. A slot has at most one.
void BleedPaths::connect(int bounce) {
    const ShadowQueue& q = scratch_.shadows;
    if (q.size == 0) return;
    shadows_.clear();
    for (int k = 0; k < q.size; ++k) {
        const int slot = q.slot[k];
        const int32_t group = scene_.groups.of_light[(*scratch_.trials)[size_t(q.trial[k])].light];
        const bool infinite = q.distance[k] == infinity;
        const Vec3d to{q.dx[k], q.dy[k], q.dz[k]};
        const Vec3d place = infinite ? to : Vec3d{q.ox[k], q.oy[k], q.oz[k]} + to * double(q.distance[k]);
        const Origin from = bounce == 0 ? Origin{{SentBy::light, group}, place, infinite} : met_[size_t(slot)];
        shadows_.push_back({slot, group, bounce + 1, {}, from});
    }
    connect_paths<probed, float>(context_, scratch_, bounce);
    for (const Arrival& s : shadows_) note(s.slot, s.bounce, s.light, taken(s.slot), s.from);
}

BleedSums BleedPaths::sums(double factor) const {
    BleedSums s;
    std::array<Vec3d, bleed_batch_paths> whole{};
    for (const Arrival& a : arrivals_) whole[size_t(a.slot)] = whole[size_t(a.slot)] + a.rgb;
    const auto is_dropped = [&](int slot) {
        const Vec3d& c = whole[size_t(slot)];
        return !(is_finite<float>(to_float(c)) && c.x >= 0 && c.y >= 0 && c.z >= 0);
    };
    for (int slot = 0; slot < bleed_batch_paths; ++slot) s.dropped += is_dropped(slot);
    factor /= bleed_batch_paths;
    for (const Arrival& a : arrivals_) {
        if (s.dropped > 0 && is_dropped(a.slot)) continue;
        const Vec3d light = a.rgb * factor;
        BleedFlow& flow = s.senders[a.from.sender];
        flow.light = flow.light + light;
        flow.places = flow.places + a.from.place * luminance(light);
        flow.weight += luminance(light);
        flow.infinite = a.from.infinite;
        Vec3d& by_light = s.lights[a.light];
        by_light = by_light + light;
        Vec3d& by_bounce = s.bounces[size_t(std::min(a.bounce, bleed_bounces - 1))];
        by_bounce = by_bounce + light;
    }
    s.places = places_;
    s.hits = hits_;
    return s;
}

Vec3 towards_camera(const CameraRecord& camera, const Vec3& position) {
    return camera.orthographic ? -camera.forward : normalize(camera.position - position);
}

} // namespace

BleedSums trace_bleed_batch(KernelContext context, const BleedTarget& target, const Vec3d& origin, int64_t batch, TileScratch& scratch) {
    context.settings.reuse = {};
    if (batch > 0) context.seed = pcg_hash(context.seed + pcg_hash(uint32_t(batch)));
    BleedPaths paths(context, scratch);
    const Vec3d at = target.position - origin;
    const bool incoming = target.kind == BleedTarget::Kind::incoming;
    if (incoming) {
        context.settings.max_bounces = std::max(context.settings.max_bounces, 1);
        const MeterPoint receiver{to_float(at + target.normal * target.clearance), to_float(target.normal)};
        begin_paths_at_meter(context, receiver, 0, bleed_batch_paths, scratch);
    } else if (target.kind == BleedTarget::Kind::outgoing)
        // Far enough that a ray that grazes begins outside of the surface.
        paths.begin_outgoing(to_float(at), towards_camera(context.scene->camera, to_float(at)), float(256 * target.clearance));
    else
        paths.begin_pixels(target.pixels);
    paths.trace(incoming);
    return paths.sums(incoming ? std::numbers::pi : 1);
}

} // namespace blush
