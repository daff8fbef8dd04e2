// Internal to io/gltf: lint. Reports legal but probably unintended content.
#pragma once

#include "io/gltf/read/context.h"

namespace blush {

// Implausible light intensities (such as watts stored as candela), cameras with a singular transform, scenes of implausible size.
void report_units(const GltfContext& context, const Scene& scene, const GltfIndices& indices);

// Images that are used both as colour and as data, data in images that are marked as sRGB, and normal maps that do not look like
// normals.
void report_textures(const GltfContext& context, const Scene& scene, const GltfIndices& indices);

// For one primitive as read: degenerate triangles, normals and tangents that are not of unit length.
void report_geometry(const GltfContext& context, const Geometry& geometry, const std::string& where);

} // namespace blush
