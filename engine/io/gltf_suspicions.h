// Internal to gltf_*.cpp: what a file may say and hardly anybody means.
#pragma once

#include "io/gltf_source.h"

namespace blush {

// Strengths that no lamp has, as of watts taken for candela; cameras whose transform flattens an axis; a scene as large as a country or smaller than a pinhead.
void report_units(const GltfContext& context, const Scene& scene, const GltfIndices& indices);

// Images that are read as colour here and as data there, data in an image that is marked as sRGB, and normal maps that do not look like any.
void report_textures(const GltfContext& context, const Scene& scene, const GltfIndices& indices);

// Of one primitive, as it was read: triangles without area, normals and tangents that are not of unit length.
void report_geometry(const GltfContext& context, const Geometry& geometry, const std::string& where);

} // namespace blush
