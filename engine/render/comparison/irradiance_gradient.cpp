#include "render/comparison/irradiance_gradient.h"

#include "scene/affine.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace blush {
namespace {

struct Cell {
    Vec3d radiance{0, 0, 0}; // mean
    double distance = std::numeric_limits<double>::infinity();
    int rays = 0;
};

class Strata {
public:
    // Cells about as wide as high in the middle of the hemisphere: pi rows of columns.
    explicit Strata(size_t rays)
        : rows_(int(std::bit_floor(size_t(std::max(1.0, std::sqrt(double(rays) * std::numbers::inv_pi)))))),
          columns_(std::max(1, int(rays) / rows_)), cells_(size_t(rows_) * size_t(columns_)) {}

    int rows() const { return rows_; }
    int columns() const { return columns_; }
    // `column` may be -1, the last one.
    const Cell& at(int row, int column) const { return cells_[size_t(row * columns_ + (column + columns_) % columns_)]; }
    double sine_below(int row) const { return std::sqrt(double(row) / rows_); }
    double azimuth(double column) const { return 2 * std::numbers::pi * column / columns_; }

    void add(const Vec3d& local, const Vec3d& radiance, double distance) {
        const double sine_squared = local.x * local.x + local.y * local.y, turns = std::atan2(local.y, local.x) / (2 * std::numbers::pi);
        const int row = std::clamp(int(sine_squared * rows_), 0, rows_ - 1);
        const int column = std::clamp(int((turns - std::floor(turns)) * columns_), 0, columns_ - 1);
        Cell& cell = cells_[size_t(row * columns_ + column)];
        cell.radiance = cell.radiance + radiance;
        cell.distance = std::min(cell.distance, distance);
        ++cell.rays;
    }
    void take_means() {
        for (Cell& cell : cells_)
            if (cell.rays > 0) cell.radiance = cell.radiance * (1.0 / cell.rays);
    }

private:
    int rows_, columns_;
    std::vector<Cell> cells_;
};

// Of the light that a cell has in the place of its neighbour, over the distance of the wall between them.
Vec3d step_at_wall(const Cell& cell, const Cell& neighbour) {
    const double distance = std::min(cell.distance, neighbour.distance);
    if (cell.rays == 0 || neighbour.rays == 0 || std::isinf(distance)) return {0, 0, 0};
    return (cell.radiance - neighbour.radiance) * (1 / distance);
}

} // namespace

std::array<Vec3d, 3> translational_gradient(const GatheredRays& rays, const Vec3& normal, double nearest) {
    const Basis<float> basis = basis_around(normal);
    Strata strata(rays.direction.size());
    for (size_t i = 0; i < rays.direction.size(); ++i)
        strata.add(to_double(basis.to_local(rays.direction[i])), rays.radiance[i], std::max(double(rays.distance[i]), nearest));
    strata.take_means();
    std::array<Vec3d, 3> gradient{};
    const auto add = [&](double azimuth, const Vec3d& change) {
        const Vec3d along = to_double(basis.s) * std::cos(azimuth) + to_double(basis.t) * std::sin(azimuth);
        gradient[0] = gradient[0] + along * change.x;
        gradient[1] = gradient[1] + along * change.y;
        gradient[2] = gradient[2] + along * change.z;
    };
    for (int k = 0; k < strata.columns(); ++k) {
        Vec3d across_rows{0, 0, 0}, across_columns{0, 0, 0};
        for (int j = 0; j < strata.rows(); ++j) {
            const double below = strata.sine_below(j), above = strata.sine_below(j + 1);
            if (j > 0) across_rows = across_rows + step_at_wall(strata.at(j, k), strata.at(j - 1, k)) * (below * (1 - below * below));
            across_columns = across_columns + step_at_wall(strata.at(j, k), strata.at(j, k - 1)) * (above - below);
        }
        add(strata.azimuth(k + 0.5), across_rows * strata.azimuth(1));
        add(strata.azimuth(k) + std::numbers::pi / 2, across_columns);
    }
    return gradient;
}

} // namespace blush
