// Building blocks of test scenes with known results: shapes, materials and cameras. +Y is up.
#pragma once

#include "core/vec.h"
#include "scene/scene.h"

#include <span>

namespace blush::stability {

// ---- shapes without vertex normals: shading uses geometric normals

// Quad of four corners, counter-clockwise seen from the front; UV set 0 is (0, 0) at the first corner and (1, 1) at the third.
GeometryPtr quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
// [-half, half]^2 at height y, facing up.
GeometryPtr floor_quad(float half, float y = 0);
// The same, facing down.
GeometryPtr ceiling_quad(float half, float y);
// [-1, 1]^3; `inward`: faces point inwards.
GeometryPtr cube(bool inward);
// Inscribed in the unit sphere, 512 triangles, none parallel to an axis plane.
GeometryPtr sphere(bool inward);

// ---- materials; other properties have neutral values

Material lambert(const Vec3& albedo);
Material lambert(float albedo);
Material metal(float roughness);            // white
Material plastic(float roughness);          // white base, ior 1.5
Material glass(float roughness, float ior); // solid without absorption
Material gel(const Vec3& color);            // thin sheet without reflection
Material emitter(float nits, float albedo = 0);
Material unlit(const Vec3& color);

// ---- scene assembly

Id<Node> place(Scene& scene, const GeometryPtr& geometry, const Material& material, const Transform& transform = {});
Id<Node> place_light(Scene& scene, const Light& light, const Transform& transform);
Id<Texture> add_texture(Scene& scene, const ImagePtr& image, Texture::Filter filter = Texture::Filter::nearest);
void constant_world(Scene& scene, float nits);
// An image of width x height RGB values.
ImagePtr float_image(int width, int height, std::span<const Vec3> texels);

Transform at(const Vec3& position, float scale = 1);
// Rotation of -Z (emission and view axis) to `direction`.
Transform aimed(const Vec3& position, const Vec3& direction);
Vec3 unit(const Vec3& v);

View looking(const Vec3& from, const Vec3& to, float yfov_radians);
// Orthographic, straight down on [-half, half]^2 from height `y`: to the right is +X, down the image is +Z.
View looking_down(float half, float y);

// A floor of reflectance 0.01 that gets pi lux from a parallel sun at 45 degrees, from -x: radiance 0.01. The camera sees it in a mirror,
// around x = -1.1. Glass beside it sends more light there, of which hardly any comes back to the glass.
Scene sunlit_floor_in_a_mirror();

} // namespace blush::stability
