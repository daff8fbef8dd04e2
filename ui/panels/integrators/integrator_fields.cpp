#include "ui/panels/integrators/integrator_fields.h"

namespace blush {
namespace {

using Kind = ComparisonIntegrator::Kind;
using enum IntegratorKnob;

const ComparisonIntegrator defaults;

void integer(Fields& f, const char* label, int& value, int64_t least, int64_t most, int reset, const char* tip) {
    int64_t shown = value;
    if (f.integer(label, shown, least, most, reset, tip)) value = int(shown);
}

void draw_rays(Fields& f, ComparisonIntegrator& i) {
    int rays = i.rays > 0 ? i.rays : i.default_rays();
    integer(f, "Rays", rays, 1, ComparisonIntegrator::max_rays, i.default_rays(), "Paths of each record or probe.");
    i.rays = rays == i.default_rays() ? 0 : rays;
}

void draw_photons(Fields& f, ComparisonIntegrator& i) {
    int photons = i.photons_per_pass();
    integer(f, "Photons", photons, 1000, ComparisonIntegrator::max_photons, i.default_photons(),
            i.kind == Kind::progressive_photon_map ? "Light paths of each sample."
                                                   : "Light paths. They are traced before the first sample.");
    i.photons = photons == i.default_photons() ? 0 : photons;
}

} // namespace

void choose_integrator(ComparisonIntegrator& integrator, Kind kind) {
    if (kind != integrator.kind) integrator = {.kind = kind};
}

std::vector<IntegratorKnob> integrator_knobs(const ComparisonIntegrator& i) {
    switch (i.kind) {
    case Kind::none: break;
    case Kind::ambient:
        return i.automatic_color ? std::vector{ao_distance, automatic_color} : std::vector{ao_distance, automatic_color, color};
    case Kind::irradiance_cache: return {accuracy, rays, baked};
    case Kind::light_probes: return {grid, rays, baked};
    case Kind::photon_map: return {photons, radius, gather_rays, baked};
    case Kind::progressive_photon_map: return {photons, radius, alpha};
    case Kind::bidirectional: break;
    case Kind::metropolis: return {large_steps, chain};
    }
    return {};
}

void draw_integrator_knob(Fields& f, ComparisonIntegrator& i, IntegratorKnob knob) {
    switch (knob) {
    case ao_distance:
        f.number("AO distance", i.distance,
                 {.min = 1e-4f, .max = 1e6f, .reset = defaults.distance, .unit = "m", .tip = "Occluders count up to this distance."});
        return;
    case automatic_color:
        f.checkbox("Automatic colour", i.automatic_color, "The mean of the indirect light that path tracing finds at 256 pixels.");
        return;
    case color: f.color("Ambient colour", i.color, {1, 1, 1}, "Radiance from all sides, in nits."); return;
    case accuracy:
        f.number(
            "Accuracy a", i.accuracy,
            {.min = 0,
             .max = ComparisonIntegrator::max_accuracy,
             .reset = defaults.accuracy,
             .step = 0.005f,
             .tip = "Ward's a: the largest error of a record. Smaller is denser and slower. 0 stores no record: then it is unbiased."});
        return;
    case rays: return draw_rays(f, i);
    case grid:
        return integer(f, "Grid", i.grid, 1, ComparisonIntegrator::max_grid, defaults.grid, "Cells along each axis of the scene's bounds.");
    case photons: return draw_photons(f, i);
    case radius:
        f.number("Radius", i.radius,
                 {.min = 0, .max = 1e6f, .unit = "m", .tip = "Of the disk that counts photons. 0: a fiftieth of the radius of the scene."});
        return;
    case gather_rays:
        return integer(
            f, "Gather rays", i.gather, 0, ComparisonIntegrator::max_rays, defaults.gather,
            "Final gather: rays that look for the light at the surfaces around each point, where the map is used. 0: the map itself "
            "is shown.");
    case alpha:
        f.number("Alpha", i.alpha,
                 {.min = 0.01f,
                  .max = 1,
                  .reset = defaults.alpha,
                  .bar = true,
                  .tip = "How fast the disks shrink: 1 keeps their radius, 0 the number of photons in them.",
                  .format = "%.2f"});
        return;
    case large_steps:
        f.number("Large steps", i.large_steps,
                 {.min = 0.01f,
                  .max = 1,
                  .reset = defaults.large_steps,
                  .bar = true,
                  .tip = "Share of the mutations that are new paths. The others change a path a little.",
                  .format = "%.2f"});
        return;
    case baked:
        f.checkbox(
            "Baked", i.baked,
            "Keeps the records, probes or photons when the scene is edited: they go stale, as baked light does. Switch it off to make "
            "them anew.");
        return;
    case chain:
        return integer(f, "Chain", i.chain, 1, ComparisonIntegrator::max_chain, defaults.chain,
                       "Mutations in a chain before another path begins a new one.");
    }
}

} // namespace blush
