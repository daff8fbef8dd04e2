// Enlarges a coarse image by what a finer one sees.
#pragma once

#include "render/first_hit_planes.h"

#include <span>
#include <vector>

namespace blush {

class Workers;

// Joint bilateral upsampling (Kopf, Cohen, Lischinski, Uyttendaele 2007, "Joint Bilateral Upsampling") of irradiance: a pixel takes the
// radiance over albedo of the four coarse pixels around it, weighted by distance and by how alike normals, depths and albedos are, times
// its own albedo. Edges and textures are then those of `fine`; shadows, reflections and the background are as coarse as before.
// `rgb`: of the coarse image, coarse.width * coarse.height * 3 values, finite and >= 0. Returns fine.width * fine.height * 3 values.
// Null workers: on this thread. The result does not depend on the number of threads.
std::vector<float> upsample_jointly(std::span<const float> rgb, const FirstHitPlanes& coarse, const FirstHitPlanes& fine,
                                    const Workers* workers = nullptr);

} // namespace blush
