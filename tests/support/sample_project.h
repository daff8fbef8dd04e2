// A small project with every kind of record, a clip and two variants of the red material, for tests of the document and of edits.
#pragma once

#include "scene/document/edit.h"

namespace blush::test {

// A unit quad in the plane z = 0, facing +Z, with normals and one UV set.
GeometryPtr quad_geometry();
// width x height pixels of one value.
ImagePtr byte_image(int width, int height, int channels, uint8_t value);
ImagePtr uniform_image(int width, int height, int channels, float value);

// Ids of the sample project's records.
struct Sample {
    Project project;
    Id<Node> root, table, mug, lamp_node, camera_node; // mug and lamp are below root, table is a root of its own
    Id<Mesh> quad;                                     // shared by table and mug
    Id<Material> red, grey;                            // red has a base colour texture
    Id<Texture> checker;
    Id<Light> lamp;
    Id<Camera> camera;
    Id<Clip> swing; // 2 s: the lamp moves 2 m to the right, the mug rotates a quarter turn about Y
};
Sample sample_project();

} // namespace blush::test
