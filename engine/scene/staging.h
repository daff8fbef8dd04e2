// Choosing among what a file offers: a moment of a clip, one of its scenes, a variant of its materials.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <string>

namespace blush {

// Errors: a clip, scene or variant that is not there, a time that is no number.
Result<void> check_staging(const Scene& scene, const Staging& staging);

// The scene under another staging, which check_staging accepts. Parts of meshes wear the materials of the variant, and a view that looks through
// a camera stays with it.
Scene staged(const Scene& scene, const Staging& staging);
// "Choose variant Blue", "Move to 1.5 s", ...: what is another than now.
std::string staging_label(const Scene& scene, const Staging& staging);

// Gives a part a material: as that of the chosen variant where the part has one for it, else of all variants that have none.
void wear(const Scene& scene, MeshPart& part, Id<Material> material);

} // namespace blush
