// A small project with one of everything that rays can meet, to edit at random.
#pragma once

#include "scene/edit.h"

namespace blush::test {

// Flat, shared and large meshes; textures, normal map, alpha (flat and through instances), glass, textured emission, vertex colours; every
// kind of light, with and without size; an environment image. 48 x 32 pixels.
Project rich_project();
// 33800 triangles, a metre wide: more than are flattened.
GeometryPtr hill_geometry();

} // namespace blush::test
