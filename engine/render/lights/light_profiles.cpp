#include "render/lights/light_profiles.h"

#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "scene/affine.h"
#include "scene/lights/ies_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

// Orthonormal frame from the node's axes: the light points along -Z; X is kept as far as it is perpendicular to that. Area lights use
// the normal of their plane, so that an area light under a skewed node still emits perpendicular to itself.
void set_frame(ProfileRecord& record, const Affined& m, bool flat) {
    Vec3d ahead = -m.z;
    if (flat) {
        const Vec3d normal = cross(m.x, m.y);
        ahead = dot(normal, m.z) < 0 ? normal : -normal;
    }
    ahead = normalize(ahead);
    const Vec3d x = normalize(m.x - ahead * dot(m.x, ahead));
    const Vec3d y = cross(x, ahead);
    record.ahead = to_float(ahead);
    record.x = to_float(x);
    record.y = to_float(dot(y, m.y) < 0 ? -y : y);
}

} // namespace

LightProfiles::Added LightProfiles::add(const Light& light, const Affined& world_from_node) {
    const bool flat = is_area_light(light);
    const bool is_spot = light.kind == Light::Kind::spot;
    const bool has_spread = flat && light.spread_radians < float(std::numbers::pi);
    const bool has_table = light.ies && (is_spot || light.kind == Light::Kind::point);
    if (!is_spot && !has_spread && !has_table) return {};

    ProfileRecord record{};
    record.cone_offset = 1;
    record.first = -1;
    set_frame(record, world_from_node, flat);
    double rms = 1;
    if (is_spot) {
        const double inner = std::cos(double(light.inner_cone_radians)), outer = std::cos(double(light.outer_cone_radians));
        record.cone_scale = float(1 / std::max(0.001, inner - outer)); // as KHR_lights_punctual recommends
        record.cone_offset = float(-outer) * record.cone_scale;
    }
    if (has_spread) {
        const double half = 0.5 * double(light.spread_radians), tangent = std::tan(half);
        record.spread_tan = float(tangent);
        record.spread_scale = float(1 / (tangent - half));
    }
    if (has_table) {
        add_table(record, *light.ies);
        rms = std::sqrt(std::max(luminous_flux(*light.ies) / (4 * std::numbers::pi * double(light.ies->peak)), 1e-4));
    }
    records_.push_back(record);
    return {int32_t(records_.size()) - 1, rms};
}

void LightProfiles::add_table(ProfileRecord& record, const IesProfile& p) {
    record.verticals = int32_t(p.vertical.size());
    record.horizontals = int32_t(p.horizontal.size());
    record.polar_x = p.type == IesProfile::Type::b;
    const auto [it, is_new] = first_by_serial_.try_emplace(p.serial, int32_t(numbers_.size()));
    record.first = it->second;
    if (!is_new) return;
    for (const float degrees : p.vertical) numbers_.push_back(degrees / 360);
    for (const float degrees : p.horizontal) numbers_.push_back(degrees / 360);
    for (const float candela : p.candela) numbers_.push_back(candela / p.peak);
}

} // namespace blush
