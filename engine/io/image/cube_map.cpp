#include "io/image/cube_map.h"

#include "core/math.h"
#include "scene/affine.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tbb/parallel_for.h>

namespace blush {
namespace {

constexpr int max_width = 4096;

// The face that a direction hits, and the position on it: right and up from its centre, in half sides.
struct FacePoint {
    size_t face = 0;
    double right = 0, up = 0;
};
FacePoint face_point(const Vec3d& d) {
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    if (x >= y && x >= z) return {d.x > 0 ? 0u : 1u, (d.x > 0 ? d.z : -d.z) / x, d.y / x};
    if (y >= z) return {d.y > 0 ? 2u : 3u, -d.x / y, (d.y > 0 ? -d.z : d.z) / y};
    return {d.z > 0 ? 4u : 5u, (d.z > 0 ? -d.x : d.x) / z, d.y / z};
}

Vec3d texel(const Image& face, int x, int y) {
    const float* t = &face.floats[(size_t(y) * size_t(face.width) + size_t(x)) * size_t(face.channels)];
    return {double(t[0]), double(t[1]), double(t[2])};
}

// Bilinear lookup within a face.
Vec3d seen(const CubeFaces& faces, const Vec3d& direction) {
    const FacePoint p = face_point(direction);
    const Image& face = *faces[p.face];
    const auto place = [&](double half_sides) { return std::clamp((half_sides + 1) / 2 * face.width - 0.5, 0.0, double(face.width - 1)); };
    const double x = place(p.right), y = place(-p.up);
    const int x0 = int(x), y0 = int(y), x1 = std::min(x0 + 1, face.width - 1), y1 = std::min(y0 + 1, face.width - 1);
    const double u = x - x0, v = y - y0;
    return (texel(face, x0, y0) * (1 - u) + texel(face, x1, y0) * u) * (1 - v) +
           (texel(face, x0, y1) * (1 - u) + texel(face, x1, y1) * u) * v;
}

bool is_cube(const CubeFaces& faces) {
    return faces[0] && faces[0]->width > 0 && std::ranges::all_of(faces, [&](const ImagePtr& f) {
               return f && f->width == faces[0]->width && f->height == f->width && f->channels >= 3 &&
                      f->floats.size() == size_t(f->width) * size_t(f->height) * size_t(f->channels);
           });
}

} // namespace

Result<ImagePtr> lat_long_of(const CubeFaces& faces, const Quat& rotation) {
    if (!is_cube(faces)) return Error{"", "the faces of a cube map must be square and of one size", ""};
    constexpr double pi = std::numbers::pi;
    const Affined turned = to_affine(rotation);
    auto image = std::make_shared<Image>();
    image->width = std::min(4 * faces[0]->width, max_width);
    image->height = image->width / 2;
    image->channels = 3;
    image->floats.resize(3 * size_t(image->width) * size_t(image->height));
    tbb::parallel_for(0, image->height, [&](int row) {
        for (int column = 0; column < image->width; ++column) {
            Vec3d sum{0, 0, 0};
            for (const double dy : {0.25, 0.75})
                for (const double dx : {0.25, 0.75}) {
                    // Right of the centre column, which looks along -Z, is +X.
                    const double azimuth = ((column + dx) / image->width - 0.5) * 2 * pi, theta = (row + dy) / image->height * pi;
                    const Vec3d d{std::sin(theta) * std::sin(azimuth), std::cos(theta), -std::sin(theta) * std::cos(azimuth)};
                    sum = sum + seen(faces, {dot(d, turned.x), dot(d, turned.y), dot(d, turned.z)});
                }
            float* to = &image->floats[3 * (size_t(row) * size_t(image->width) + size_t(column))];
            to[0] = float(sum.x / 4);
            to[1] = float(sum.y / 4);
            to[2] = float(sum.z / 4);
        }
    });
    return ImagePtr(std::move(image));
}

} // namespace blush
