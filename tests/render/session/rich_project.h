// A small project with every kind of scene content, for random edits.
#pragma once

#include "scene/document/edit.h"

namespace blush::test {

// Flat, shared and large meshes; textures, normal map, alpha (flat and through instances), glass, textured emission, vertex colours; every
// kind of light, with and without size; an environment image. 48 x 32 pixels.
Project rich_project();
// 33800 triangles, one metre wide: more than the limit for flattening.
GeometryPtr hill_geometry();

} // namespace blush::test
