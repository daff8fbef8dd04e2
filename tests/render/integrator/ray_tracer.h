// A plain ray tracer in double precision, with formulas of its own: where the light of a small lamp arrives through glass and mirrors. For
// tests of caustics; every triangle is tested.
#pragma once

#include "scene/scene.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

namespace blush::test {

struct RayTracer {
    struct Triangle {
        Vec3d corner, edge1, edge2, normal; // normal: unit, outward
    };
    std::vector<Triangle> triangles; // of one closed body
    Vec3d center{0, 0, 0};
    double radius = 0; // of a sphere around the body
    double ior = 0;    // 0: a mirror
    std::mt19937_64 bits{1};

    double random() { return double(bits() >> 11) * 0x1p-53; }

    // `geometry` scaled by `scale` and moved to `center`, which is also the middle of its bounding sphere, of radius `scale` for the unit
    // sphere.
    RayTracer(const Geometry& geometry, const Vec3d& middle, double scale, double index) : center(middle), radius(scale), ior(index) {
        const auto at = [&](size_t i) { return to_double(geometry.positions[geometry.indices[i]]) * scale + middle; };
        for (size_t i = 0; i + 2 < geometry.indices.size(); i += 3) {
            const Vec3d a = at(i), e = at(i + 1) - a, f = at(i + 2) - a;
            triangles.push_back({a, e, f, normalize(cross(e, f))});
        }
    }

    // Moeller and Trumbore 1997.
    const Triangle* nearest(const Vec3d& origin, const Vec3d& direction, double& distance) const {
        const Vec3d to = center - origin;
        const double along = dot(to, direction);
        if (dot(to, to) - along * along > radius * radius * 1.001) return nullptr;
        const Triangle* hit = nullptr;
        for (const Triangle& t : triangles) {
            const Vec3d p = cross(direction, t.edge2);
            const double determinant = dot(t.edge1, p);
            if (determinant == 0) continue;
            const Vec3d from = origin - t.corner, q = cross(from, t.edge1);
            const double u = dot(from, p) / determinant, v = dot(direction, q) / determinant, d = dot(t.edge2, q) / determinant;
            if (u >= 0 && v >= 0 && u + v <= 1 && d > 1e-9 && d < distance) distance = d, hit = &t;
        }
        return hit;
    }

    // Reflects or refracts by Snell's law, with the chance that Fresnel's formulas give to unpolarised light.
    Vec3d scatter(const Vec3d& in, const Vec3d& outward) {
        const bool enters = dot(in, outward) < 0;
        const Vec3d n = enters ? outward : outward * -1.0;
        const double c = -dot(in, n);
        const Vec3d mirrored = in + n * (2 * c);
        if (ior == 0) return mirrored;
        const double n1 = enters ? 1 : ior, n2 = enters ? ior : 1, sine2 = n1 / n2 * n1 / n2 * (1 - c * c);
        if (sine2 >= 1) return mirrored;
        const double d = std::sqrt(1 - sine2);
        const double s = (n1 * c - n2 * d) / (n1 * c + n2 * d), p = (n1 * d - n2 * c) / (n1 * d + n2 * c);
        if (random() < (s * s + p * p) / 2) return mirrored;
        return normalize(in * (n1 / n2) + n * (n1 / n2 * c - d));
    }

    Vec3d direction() {
        const double z = 2 * random() - 1, r = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * random();
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

    // Where one of the rays of a lamp, a sphere that emits by Lambert's law, meets the plane y = 0.
    std::optional<Vec3d> arrival(const Vec3d& lamp, double lamp_radius) {
        const Vec3d normal = direction();
        Vec3d origin = lamp + normal * lamp_radius, along = normalize(normal + direction()); // by the cosine to the normal
        for (int bounce = 0; bounce < 1000; ++bounce) {
            double distance = INFINITY;
            const Triangle* hit = nearest(origin, along, distance);
            const double floor = along.y < 0 ? -origin.y / along.y : INFINITY;
            if (!hit || floor < distance) return floor < INFINITY ? std::optional(origin + along * floor) : std::nullopt;
            origin = origin + along * distance;
            along = scatter(along, hit->normal);
        }
        return std::nullopt;
    }
};

} // namespace blush::test
