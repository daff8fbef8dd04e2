#include "render/comparison/comparison_integrator.h"

#include "core/text.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace blush {
namespace {

using Kind = ComparisonIntegrator::Kind;

struct Name {
    Kind kind;
    std::string_view name, bias;
    std::string_view verdict = "biased";
};
constexpr Name names[]{
    {Kind::none, "path", "", "unbiased"},
    {Kind::ambient, "ambient", "indirect light is the same from all sides"},
    {Kind::irradiance_cache, "irradiance-cache", "indirect light is interpolated between records"},
    {Kind::photon_map, "photon-map", "photons are counted over disks of a size"},
    {Kind::light_probes, "light-probes", "indirect light is interpolated between probes, which see through walls"},
    {Kind::progressive_photon_map, "progressive-photon-map", "photons are counted over disks that shrink with each sample", "consistent"},
    {Kind::bidirectional, "bidirectional", "", "unbiased"},
    {Kind::metropolis, "metropolis", "", "unbiased"},
};

const Name& name_of(Kind kind) {
    for (const Name& name : names)
        if (name.kind == kind) return name;
    return names[0];
}

bool parse_color(std::string_view text, ComparisonIntegrator& to) {
    if (text == "auto") return to.automatic_color = true;
    const std::vector<std::string_view> parts = split(text, ':');
    Vec3& c = to.color;
    to.automatic_color = false;
    return parts.size() == 3 && parse_number(parts[0], c.x) && parse_number(parts[1], c.y) && parse_number(parts[2], c.z) && c.x >= 0 &&
           c.y >= 0 && c.z >= 0 && std::isfinite(c.x + c.y + c.z);
}

bool parse_knob(std::string_view name, std::string_view value, ComparisonIntegrator& to) {
    if (to.kind == Kind::ambient && name == "color") return parse_color(value, to);
    if (to.kind == Kind::ambient && name == "distance")
        return parse_number(value, to.distance) && to.distance > 0 && std::isfinite(to.distance);
    if (to.kind == Kind::irradiance_cache && name == "a")
        return parse_number(value, to.accuracy) && to.accuracy >= 0 && to.accuracy <= ComparisonIntegrator::max_accuracy;
    if (to.kind == Kind::light_probes && name == "grid")
        return parse_number(value, to.grid) && to.grid >= 1 && to.grid <= ComparisonIntegrator::max_grid;
    if (to.kind == Kind::metropolis && name == "large")
        return parse_number(value, to.large_steps) && to.large_steps > 0 && to.large_steps <= 1;
    if (to.kind == Kind::metropolis && name == "chain")
        return parse_number(value, to.chain) && to.chain >= 1 && to.chain <= ComparisonIntegrator::max_chain;
    const bool maps = to.kind == Kind::photon_map || to.kind == Kind::progressive_photon_map;
    if (to.kind == Kind::progressive_photon_map && name == "alpha") return parse_number(value, to.alpha) && to.alpha > 0 && to.alpha <= 1;
    if (maps && name == "photons")
        return parse_number(value, to.photons) && to.photons >= 1 && to.photons <= ComparisonIntegrator::max_photons;
    if (to.kind == Kind::photon_map && name == "gather")
        return parse_number(value, to.gather) && to.gather >= 0 && to.gather <= ComparisonIntegrator::max_rays;
    if (maps && name == "radius") {
        to.radius = 0;
        return value == "auto" || (parse_number(value, to.radius) && to.radius > 0 && std::isfinite(to.radius));
    }
    if ((to.kind == Kind::irradiance_cache || to.kind == Kind::light_probes) && name == "rays")
        return parse_number(value, to.rays) && to.rays >= 1 && to.rays <= ComparisonIntegrator::max_rays;
    return false;
}

} // namespace

Result<ComparisonIntegrator> parse_integrator(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    ComparisonIntegrator integrator;
    bool known = false;
    for (const Name& name : names) {
        if (name.name != parts[0]) continue;
        integrator.kind = name.kind;
        known = true;
    }
    if (!known)
        return Error{.what = fmt::format("an integrator must be path, ambient, irradiance-cache, light-probes, photon-map, "
                                         "progressive-photon-map, bidirectional or metropolis, not \"{}\"",
                                         parts[0])};
    for (size_t i = 1; i < parts.size(); ++i) {
        if (parts[i] == "baked" && integrator.can_be_baked()) {
            integrator.baked = true;
            continue;
        }
        const size_t equals = parts[i].find('=');
        if (equals == std::string_view::npos || !parse_knob(parts[i].substr(0, equals), parts[i].substr(equals + 1), integrator))
            return Error{.what = fmt::format("integrator {}: \"{}\" is not an option, or out of range (ambient: color=R:G:B or auto, "
                                             "distance=M; irradiance-cache: a=0..1, rays=1..1024; light-probes: grid=1..64, rays=1..1024; "
                                             "photon-map: photons=1..1e8, "
                                             "radius=M or auto, gather=0..1024; progressive-photon-map: photons, radius, alpha=0..1; "
                                             "metropolis: large=0..1, chain=1..1e6; irradiance-cache, light-probes and photon-map: baked)",
                                             parts[0], parts[i])};
    }
    return integrator;
}

std::string to_string(const ComparisonIntegrator& i) {
    const std::string name(name_of(i.kind).name), baked = i.baked ? ",baked" : "";
    const int rays = i.rays > 0 ? i.rays : i.default_rays();
    const std::string radius = i.radius > 0 ? fmt::format("{}", i.radius) : "auto";
    switch (i.kind) {
    case Kind::none: break;
    case Kind::ambient:
        return i.automatic_color ? fmt::format("{},color=auto,distance={}", name, i.distance)
                                 : fmt::format("{},color={}:{}:{},distance={}", name, i.color.x, i.color.y, i.color.z, i.distance);
    case Kind::irradiance_cache: return fmt::format("{},a={},rays={}{}", name, i.accuracy, rays, baked);
    case Kind::photon_map: return fmt::format("{},photons={},radius={},gather={}{}", name, i.photons_per_pass(), radius, i.gather, baked);
    case Kind::progressive_photon_map: return fmt::format("{},photons={},radius={},alpha={}", name, i.photons_per_pass(), radius, i.alpha);
    case Kind::metropolis: return fmt::format("{},large={},chain={}", name, i.large_steps, i.chain);
    case Kind::bidirectional: break;
    case Kind::light_probes: return fmt::format("{},grid={},rays={}{}", name, i.grid, rays, baked);
    }
    return name;
}

std::string_view bias_of(ComparisonIntegrator::Kind kind) { return name_of(kind).bias; }
std::string_view verdict_of(ComparisonIntegrator::Kind kind) { return name_of(kind).verdict; }

} // namespace blush
