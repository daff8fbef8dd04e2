// Biased integrators in the renderer's tiles.
#pragma once

#include "render/biased/biased_integrator.h"
#include "render/biased/indirect_light.h"

#include <memory>

namespace blush {

// Null for path tracing.
std::unique_ptr<IndirectLight> make_indirect_light(const BiasedIntegrator& integrator);

// Adds what the tile's diffuse surfaces reflect. `context` has all bounces; `points` and `scratch` are memory.
void add_indirect_light(const KernelContext& context, const IndirectLight& light, const TileJob& job, TileScratch& tile,
                        TileScratch& scratch);

} // namespace blush
