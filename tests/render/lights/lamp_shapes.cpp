#include "tests/render/lights/lamp_shapes.h"

#include "core/math.h"

#include <cmath>
#include <numbers>

namespace blush::test {
namespace {

GeometryPtr finished(Geometry g, bool inward = false) {
    if (inward)
        for (size_t i = 0; i < g.indices.size(); i += 3) std::swap(g.indices[i + 1], g.indices[i + 2]);
    return std::make_shared<const Geometry>(std::move(g));
}

// Rows of `columns` vertices, closed around; front to the right of the way down.
void add_bands(Geometry& g, uint32_t rows, uint32_t columns, bool top, bool bottom) {
    for (uint32_t i = 0; i < rows; ++i)
        for (uint32_t j = 0; j < columns; ++j) {
            const uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns;
            if (i > 0 || !top) g.indices.insert(g.indices.end(), {a, a + columns, b});
            if (i + 1 < rows || !bottom) g.indices.insert(g.indices.end(), {b, a + columns, b + columns});
        }
}

// Of radius 1 around Y, from the angle 0 from +Y to `end`.
void add_rows(Geometry& g, uint32_t rows, uint32_t columns, double end) {
    for (uint32_t i = 0; i <= rows; ++i)
        for (uint32_t j = 0; j < columns; ++j) {
            const double theta = end * i / rows, phi = 2 * std::numbers::pi * j / columns;
            g.positions.push_back({float(std::sin(theta) * std::sin(phi)), float(std::cos(theta)), float(std::sin(theta) * std::cos(phi))});
        }
}

void add_grid(Geometry& g, int n, const Vec3& corner, const Vec3& right, const Vec3& up) {
    const auto point = [&](int x, int y) { return corner + right * (2 * float(x) / float(n)) + up * (2 * float(y) / float(n)); };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const auto first = uint32_t(g.positions.size());
            g.positions.insert(g.positions.end(), {point(x, y), point(x + 1, y), point(x + 1, y + 1), point(x, y + 1)});
            for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) g.indices.push_back(first + i);
        }
}

} // namespace

GeometryPtr ball(uint32_t rows, uint32_t columns) {
    Geometry g;
    add_rows(g, rows, columns, std::numbers::pi);
    add_bands(g, rows, columns, true, true);
    return finished(std::move(g));
}

GeometryPtr hemisphere(uint32_t rows, uint32_t columns, bool inward) {
    Geometry g;
    add_rows(g, rows, columns, std::numbers::pi / 2);
    add_bands(g, rows, columns, true, false);
    return finished(std::move(g), inward);
}

GeometryPtr capsule(uint32_t rows, uint32_t columns, float half) {
    Geometry g = *ball(rows, columns);
    g.serial = next_payload_serial();
    for (size_t i = 0; i < g.positions.size(); ++i) g.positions[i].y += i / columns <= rows / 2 ? half : -half;
    return finished(std::move(g));
}

GeometryPtr torus(uint32_t around, uint32_t across, float radius, float tube) {
    Geometry g;
    for (uint32_t i = 0; i <= around; ++i)
        for (uint32_t j = 0; j < across; ++j) {
            const double turn = 2 * std::numbers::pi * (i % around) / around, bend = 2 * std::numbers::pi * j / across;
            const double from_axis = double(radius) + double(tube) * std::cos(bend);
            g.positions.push_back(
                {float(from_axis * std::cos(turn)), float(double(tube) * std::sin(bend)), float(-from_axis * std::sin(turn))});
        }
    add_bands(g, around, across, false, false);
    return finished(std::move(g));
}

GeometryPtr grid_cube(int n) {
    Geometry g;
    add_grid(g, n, {-1, 1, 1}, {1, 0, 0}, {0, 0, -1});
    add_grid(g, n, {-1, -1, -1}, {1, 0, 0}, {0, 0, 1});
    add_grid(g, n, {-1, -1, 1}, {1, 0, 0}, {0, 1, 0});
    add_grid(g, n, {1, -1, -1}, {-1, 0, 0}, {0, 1, 0});
    add_grid(g, n, {1, -1, 1}, {0, 0, -1}, {0, 1, 0});
    add_grid(g, n, {-1, -1, -1}, {0, 0, 1}, {0, 1, 0});
    return finished(std::move(g));
}

GeometryPtr grid_quad(int n) {
    Geometry g;
    add_grid(g, n, {-1, 0, 1}, {1, 0, 0}, {0, 0, -1});
    return finished(std::move(g));
}

GeometryPtr moved(const GeometryPtr& mesh, const Vec3& by) {
    Geometry g = *mesh;
    g.serial = next_payload_serial();
    for (Vec3& p : g.positions) p = p + by;
    return finished(std::move(g));
}

GeometryPtr joined(const std::vector<GeometryPtr>& meshes) {
    Geometry g;
    for (const GeometryPtr& mesh : meshes) {
        const auto first = uint32_t(g.positions.size());
        g.positions.insert(g.positions.end(), mesh->positions.begin(), mesh->positions.end());
        for (const uint32_t i : mesh->indices) g.indices.push_back(first + i);
    }
    return finished(std::move(g));
}

} // namespace blush::test
