// Internal to gltf_*.cpp: the lights of an edited scene in the lists of their extensions.
#pragma once

#include "io/gltf_document.h"
#include "io/gltf_write_payloads.h"

#include <vector>

namespace blush {

// Each light in the list of its kind, and what has changed of it since it was `read`. A light whose distribution came inside of another
// document cannot take it along: `lost` says so.
void write_lights(GltfDocument& document, const Scene& read, const Scene& scene, const UsedRecords& used, std::vector<Diagnostic>& lost);

} // namespace blush
