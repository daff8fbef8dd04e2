#include "ui/views/meters_view.h"

#include "core/math.h"
#include "render/compile/surface_clearance.h"
#include "scene/geometry/ray_queries.h"
#include "ui/viewport/picking.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {

std::optional<LightMeter> meter_at(const Frame& frame, const Scene& scene, const Projection& projection, double u, double v,
                                   std::string name) {
    const ViewRay ray = projection.ray(u, v);
    const auto any = [](Id<Node>) { return true; };
    // The object id of the pixel, which may be visible through holes of other objects. At an edge the ray through the click may
    // miss it, or meet another object before it.
    const Id<Node> shown = pick(frame, u, v).node;
    std::optional<RayHit> hit;
    if (shown) hit = cast_ray(scene, ray.origin, ray.direction, [&](Id<Node> id) { return id == shown; });
    if (!hit || first_occluder(scene, ray.origin, hit->position, any)) hit = cast_ray(scene, ray.origin, ray.direction, any);
    if (!hit) return {};
    LightMeter meter = meter_on(scene, hit->node, hit->position, hit->normal, std::move(name));
    meter.clearance = float(surface_clearance(scene, *hit));
    return meter;
}

std::string new_meter_name(const std::vector<LightMeter>& meters) {
    for (int i = 1;; ++i) {
        const std::string name = fmt::format("Meter {}", i);
        if (std::ranges::find(meters, name, &LightMeter::name) == meters.end()) return name;
    }
}

std::vector<MeterPlace> places_of(const Scene& scene, const std::vector<LightMeter>& meters) {
    std::vector<MeterPlace> places;
    for (const LightMeter& meter : meters) {
        const PlacedMeter p = placed(scene, meter);
        places.push_back({p.position, p.normal, double(meter.clearance)});
    }
    return places;
}

std::string reading_text(const MeterReading& reading) {
    const Interval& lux = reading.lux;
    if (!lux.known) return reading.rounds > 1 ? "no light found yet" : "...";
    const double half = (lux.high - lux.low) / 2;
    // As many decimals as the confidence interval justifies.
    const int decimals = half > 0 ? std::clamp(1 - int(std::floor(std::log10(half))), 0, 6) : 3;
    return fmt::format("{:.{}f} ± {:.{}f} lx", lux.value, decimals, half, decimals);
}

} // namespace blush
