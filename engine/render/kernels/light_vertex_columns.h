// The light vertices of a tile (render/integrator/manifold/light_vertices.h).
#pragma once

#include "render/kernels/light_path_columns.h"
#include "render/kernels/manifold_columns.h"
#include "render/kernels/shadow_queue.h"

#include <cstdint>
#include <vector>

namespace blush {

struct LightVertexColumns {
    std::vector<EmittedPath> emitted; // of the tile; EmittedPath::index is the slot

    // By slot: events of the chain to the light (shading/manifold_seeds.h), 0 without a light vertex; the light's record.
    Column<int32_t> chain, light;
    Column<int32_t> wavelength; // of the path, as ManifoldColumns::wavelength
    // The origin of its rays, normals, direction in which light arrives; the light's point (at infinity: direction towards it).
    Columns3 origin, ns, ng, wi, target;
    Columns3 reflected; // flux of the path times reflectance over pi
    Column<float> pdf;  // with which paths of the camera sample `wi`, 1/sr; only of shared chains
    // Density of manifold sampling from a vertex here, over that of light paths: m^2; of shared chains, over `pdf`.
    Column<float> ratio;

    ShadowQueue connections; // of this bounce, without groups
};

} // namespace blush
