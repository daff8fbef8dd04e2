// Internal to io/gltf: writes the lights of an edited scene into the lists of their extensions.
#pragma once

#include "io/gltf/write/document.h"
#include "io/gltf/write/write_payloads.h"

#include <vector>

namespace blush {

// Puts each light into the list of its kind and writes what differs from `read`. The IES profile of a light that was embedded in
// another document cannot be saved: reported in `lost`.
void write_lights(GltfDocument& document, const Scene& read, const Scene& scene, const UsedRecords& used, std::vector<Diagnostic>& lost);

} // namespace blush
