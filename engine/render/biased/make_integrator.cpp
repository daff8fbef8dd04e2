#include "render/biased/make_integrator.h"

#include "render/biased/ambient_light.h"
#include "render/biased/irradiance_cache.h"
#include "render/biased/light_probes.h"
#include "render/biased/photon_map.h"
#include "render/biased/progressive_photon_map.h"

namespace blush {

std::unique_ptr<PathReplacement> make_integrator(const BiasedIntegrator& integrator) {
    switch (integrator.kind) {
    case BiasedIntegrator::Kind::none: break;
    case BiasedIntegrator::Kind::ambient: return std::make_unique<AmbientLight>(integrator);
    case BiasedIntegrator::Kind::irradiance_cache: return std::make_unique<IrradianceCache>(integrator);
    case BiasedIntegrator::Kind::light_probes: return std::make_unique<LightProbes>(integrator);
    case BiasedIntegrator::Kind::photon_map: return std::make_unique<PhotonMap>(integrator);
    case BiasedIntegrator::Kind::progressive_photon_map: return std::make_unique<ProgressivePhotonMap>(integrator);
    }
    return nullptr;
}

} // namespace blush
