#include "render/comparison/make_integrator.h"

#include "render/comparison/ambient_light.h"
#include "render/comparison/bidirectional.h"
#include "render/comparison/irradiance_cache.h"
#include "render/comparison/light_probes.h"
#include "render/comparison/metropolis.h"
#include "render/comparison/photon_map.h"
#include "render/comparison/progressive_photon_map.h"

namespace blush {

std::unique_ptr<PathReplacement> make_integrator(const ComparisonIntegrator& integrator) {
    switch (integrator.kind) {
    case ComparisonIntegrator::Kind::none: break;
    case ComparisonIntegrator::Kind::ambient: return std::make_unique<AmbientLight>(integrator);
    case ComparisonIntegrator::Kind::irradiance_cache: return std::make_unique<IrradianceCache>(integrator);
    case ComparisonIntegrator::Kind::light_probes: return std::make_unique<LightProbes>(integrator);
    case ComparisonIntegrator::Kind::photon_map: return std::make_unique<PhotonMap>(integrator);
    case ComparisonIntegrator::Kind::progressive_photon_map: return std::make_unique<ProgressivePhotonMap>(integrator);
    case ComparisonIntegrator::Kind::bidirectional: return std::make_unique<Bidirectional>();
    case ComparisonIntegrator::Kind::metropolis: return std::make_unique<Metropolis>(integrator);
    }
    return nullptr;
}

} // namespace blush
