// Pilot of manifold sampling: finds out whether it is worth its walks.
#pragma once

#include "core/parallel.h"
#include "render/compile/feature_report.h"
#include "render/integrator/light_path_emission.h"
#include "render/kernels/kernel.h"
#include "render/lights/guiding_trial.h"
#include "render/lights/manifold_seed_table.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush {

struct ManifoldPilot {
    ManifoldSeedTable seeds;
    std::optional<PilotFigures> figures; // empty: no photon has arrived by specular surfaces alone, or no camera path met its region
    bool endless = false;                // some solutions need so many trials that their light would come too rarely
    // Manifold sampling that shares chains with light paths over that without. Empty: there are none.
    std::optional<PilotFigures> shared_figures = {};
    bool shares = false;        // it pays
    LightPathEmission emission; // of light vertices
    float usual_ratio = 0;      // LightVertexTables::usual_ratio; 0: no light path has found a light vertex
    // Manifold sampling with light vertices over that without. Empty: not measured, as it would not be used.
    std::optional<PilotFigures> vertex_figures = {};

    // Empty if there are none. Valid as long as this object.
    LightVertexTables light_vertices() const;
};

// Renders tiles of the image at a low resolution with manifold sampling. The variance that the same light has without is known from its
// solutions, though no path may have found it: light f of probability density p there has the second moment of f^2 / p. `kernel`: with
// Feature::light_paths; `without`: that of the image as decided before; `shares` overrides ManifoldPilot::shares. `disperses`: a solid of
// the scene does. Arguments and the result otherwise as learn_path_guiding().
std::optional<ManifoldPilot> measure_manifolds(KernelContext context, const CausticPhotons& photons, const CasterSphere& scene_sphere,
                                               const CausticCasterTables& casters, std::optional<bool> shares, bool disperses,
                                               const Kernel& kernel, const Kernel& without, const Workers& workers,
                                               std::vector<std::unique_ptr<TileScratch>>& scratch, const std::function<bool()>& wanted);

} // namespace blush
