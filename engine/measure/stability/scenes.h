// Scenes small enough that their pictures are known: shapes, materials and cameras to put together. +Y is up.
#pragma once

#include "core/vec.h"
#include "scene/scene.h"

#include <span>

namespace blush::stability {

// ---- shapes, without vertex normals: what they reflect follows from their planes alone

// Of four corners, counter-clockwise as seen from its front; its UV set 0 runs from (0, 0) at the first corner to (1, 1) at the third.
GeometryPtr quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
// [-half, half]^2 at height y, facing up.
GeometryPtr floor_quad(float half, float y = 0);
// The same, facing down.
GeometryPtr ceiling_quad(float half, float y);
// [-1, 1]^3; `inward`: a room.
GeometryPtr cube(bool inward);
// Inscribed in the unit sphere, 512 triangles, none of them parallel to an axis plane.
GeometryPtr sphere(bool inward);

// ---- materials; all are as plain as can be but for what the name says

Material lambert(const Vec3& albedo);
Material lambert(float albedo);
Material metal(float roughness);            // white
Material plastic(float roughness);          // white base, ior 1.5
Material glass(float roughness, float ior); // a solid that absorbs nothing
Material gel(const Vec3& color);            // a thin sheet that reflects nothing
Material emitter(float nits, float albedo = 0);
Material unlit(const Vec3& color);

// ---- putting together

Id<Node> place(Scene& scene, const GeometryPtr& geometry, const Material& material, const Transform& transform = {});
Id<Node> shine(Scene& scene, const Light& light, const Transform& transform);
Id<Texture> add_texture(Scene& scene, const ImagePtr& image, Texture::Filter filter = Texture::Filter::nearest);
void constant_world(Scene& scene, float nits);
// An image of width x height RGB values.
ImagePtr float_picture(int width, int height, std::span<const Vec3> texels);

Transform at(const Vec3& position, float scale = 1);
// -Z, the way lights shine and cameras look, towards `direction`.
Transform aimed(const Vec3& position, const Vec3& direction);
Vec3 unit(const Vec3& v);

View looking(const Vec3& from, const Vec3& to, float yfov_radians);
// Orthographic, straight down on [-half, half]^2 from height `y`: to the right is +X, down the image is +Z.
View looking_down(float half, float y);

} // namespace blush::stability
