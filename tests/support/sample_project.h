// A small project with one of everything, a clip and two variants of the red material, for tests of the document and of what follows from editing it.
#pragma once

#include "scene/edit.h"

namespace blush::test {

// A unit quad in the plane z = 0, facing +Z, with normals and one UV set.
GeometryPtr quad_geometry();
// width x height pixels of one value.
ImagePtr byte_image(int width, int height, int channels, uint8_t value);
ImagePtr float_image(int width, int height, int channels, float value);

// Ids of the sample project's records, so that tests read like sentences.
struct Sample {
    Project project;
    Id<Node> root, table, mug, lamp_node, camera_node; // mug and lamp hang below root, table is a root of its own
    Id<Mesh> quad;                                     // shared by table and mug
    Id<Material> red, grey;                            // red has a base colour texture
    Id<Texture> checker;
    Id<Light> lamp;
    Id<Camera> camera;
    Id<Clip> swing; // 2 s: the lamp goes 2 m to the right, the mug turns a quarter about Y
};
Sample sample_project();

} // namespace blush::test
