#include "render/integrator/kernel_settings.h"

#include "render/integrator/camera.h"
#include "shading/energy.h"

namespace blush {
namespace {

const EnergyTable& energy_table() {
    static const EnergyTable table = make_energy_table();
    return table;
}

} // namespace

EstimatorSettings kernel_settings(const RenderSettings& settings, int width, int height) {
    EstimatorSettings e;
    if (settings.max_bounces != unlimited_bounces) e.max_bounces = settings.max_bounces;
    e.roulette = settings.roulette;
    e.mis = {settings.strategy, settings.heuristic == MisHeuristic{}, settings.heuristic};
    e.sampler = settings.sampler;
    e.filter = settings.filter == PixelFilter::box ? &box_filter() : &blackman_harris_filter();
    e.energy = settings.energy_compensation ? &energy_table() : nullptr;
    e.reuse = reuse_groups(settings.reuse);
    e.width = float(width);
    e.height = float(height);
    return e;
}

} // namespace blush
