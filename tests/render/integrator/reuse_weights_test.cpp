// The shares of path reuse for a hand-made group, compared with the balance heuristic in double precision.
#include "render/integrator/path_reuse.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <numbers>

namespace blush::test::TEST_FILE {
namespace {

constexpr int size = 4;
constexpr std::array<Vec3d, size> on_floor{{{-0.8, 0, 0.1}, {0.3, 0, -0.4}, {0.7, 0, 0.6}, {-0.2, 0, 0.9}}};
constexpr std::array<Vec3d, size> on_ceiling{{{0.1, 1, 0.2}, {-0.6, 1, -0.3}, {0.9, 1, 0.4}, {-0.1, 1, 0.8}}};
constexpr std::array<Vec3d, size> reflectance{{{0.8, 0.2, 0.5}, {0.4, 0.9, 0}, {0.6, 0.6, 0.6}, {0.1, 0.3, 0.7}}};
constexpr std::array<Vec3d, size> radiance{{{1, 2, 3}, {0.5, 4, 0.1}, {2, 0.3, 1}, {7, 0.2, 0.6}}}; // for each vertex above

// G of the floor's point i and the ceiling's point k: both cosines are 1 / d.
double density(int i, int k) {
    const Vec3d to = on_ceiling[size_t(k)] - on_floor[size_t(i)];
    return 1 / (dot(to, to) * dot(to, to));
}

void put(ReuseVertexColumns& c, int i, const Vec3d& position, float up) {
    c.px[i] = float(position.x), c.py[i] = float(position.y), c.pz[i] = float(position.z);
    c.clearance[i] = 1e-4f;
    c.gx[i] = c.gz[i] = c.sx[i] = c.sz[i] = 0;
    c.gy[i] = c.sy[i] = up;
    c.takes_part[i] = 1;
}

// Radiance received by the members. `hidden`: whether point k of the ceiling is hidden from member i; `tamper`: modifies the
// densities to simulate a bug.
template <class Hidden, class Tamper> std::array<Vec3d, size> received(const Hidden& hidden, const Tamper& tamper) {
    const auto scratch = std::make_unique<TileScratch>();
    scratch->reuse = std::make_unique<ReuseColumns>();
    ReuseColumns& reuse = *scratch->reuse;
    int slots[size];
    for (int i = 0; i < size; ++i) {
        slots[i] = i;
        put(reuse.first, i, on_floor[size_t(i)], 1);
        put(reuse.second, i, on_ceiling[size_t(i)], -1);
        const Vec3d &rho = reflectance[size_t(i)], &l = radiance[size_t(i)];
        reuse.rho_r[i] = float(rho.x), reuse.rho_g[i] = float(rho.y), reuse.rho_b[i] = float(rho.z);
        scratch->r[i] = rho.x * l.x, scratch->g[i] = rho.y * l.y, scratch->b[i] = rho.z * l.z;
        reuse.second_of[i] = i;
    }
    ReuseBatch& batch = reuse.batch;
    seat_group(reuse, *scratch, batch, slots, size);
    queue_connections<float>({}, reuse, batch, size, scratch->shadows);
    for (int v = 0; v < batch.vertices; ++v)
        for (int m = 0; m < size; ++m) {
            const int pair = v * size + m;
            if (hidden(m, batch.own_seat[v])) batch.density[pair] = batch.drawn[pair] = 0;
            batch.density[pair] = tamper(batch.density[pair], m, v);
            batch.drawn[pair] = tamper(batch.drawn[pair], m, v);
        }
    Vec3 share[ReuseBatch::max_seats];
    weigh(batch, size, share);
    distribute<float>(reuse, batch, size, share, {scratch->r, scratch->g, scratch->b});
    std::array<Vec3d, size> result;
    for (int i = 0; i < size; ++i) result[size_t(i)] = {scratch->r[i], scratch->g[i], scratch->b[i]};
    return result;
}

bool no_pixel(int, int) { return false; }
bool some(int member, int vertex) { return (member == 0 && vertex == 2) || (member == 3 && vertex == 1); }
float sound(float d, int, int) { return d; }

// rho_i sum_k V_ik G_i(y_k) / sum_j V_jk G_j(y_k) L_k, j over members that reflect the colour.
template <class Hidden> Vec3d expected(int i, const Hidden& hidden) {
    const auto colour = [&](double Vec3d::*c) {
        double sum = 0;
        for (int k = 0; k < size; ++k) {
            if (reflectance[size_t(k)].*c == 0) continue; // its path carried no light
            double all = 0;
            for (int j = 0; j < size; ++j)
                if (reflectance[size_t(j)].*c > 0 && !hidden(j, k)) all += density(j, k);
            if (!hidden(i, k)) sum += density(i, k) / all * radiance[size_t(k)].*c;
        }
        return sum * reflectance[size_t(i)].*c;
    };
    return {colour(&Vec3d::x), colour(&Vec3d::y), colour(&Vec3d::z)};
}

template <class Hidden> double worst_deviation(const std::array<Vec3d, size>& got, const Hidden& hidden) {
    double worst = 0;
    for (int i = 0; i < size; ++i) {
        const Vec3d want = expected(i, hidden), &have = got[size_t(i)];
        for (const double d : {have.x - want.x, have.y - want.y, have.z - want.z}) worst = std::max(worst, std::abs(d));
    }
    return worst;
}

// A few rounding errors of numbers up to 7.
constexpr double rounding = 2e-5;

TEST(ReuseWeights, AreTheBalanceHeuristics) {
    EXPECT_LT(worst_deviation(received(no_pixel, sound), no_pixel), rounding);
    EXPECT_LT(worst_deviation(received(some, sound), some), rounding);
}

// The radiance of the vertices is distributed completely, and no more.
TEST(ReuseWeights, OfAVertexSumToOne) {
    for (const bool hides : {false, true}) {
        const auto got = hides ? received(some, sound) : received(no_pixel, sound);
        Vec3d sum{0, 0, 0}, all{0, 0, 0};
        for (size_t i = 0; i < size; ++i) {
            const auto over = [](double value, double rho) { return rho > 0 ? value / rho : 0; };
            sum = sum + Vec3d{over(got[i].x, reflectance[i].x), over(got[i].y, reflectance[i].y), over(got[i].z, reflectance[i].z)};
            all = all + Vec3d{radiance[i].x, radiance[i].y, reflectance[i].z > 0 ? radiance[i].z : 0};
        }
        EXPECT_NEAR(sum.x, all.x, rounding);
        EXPECT_NEAR(sum.y, all.y, rounding);
        EXPECT_NEAR(sum.z, all.z, rounding);
    }
}

// Sensitivity of the first test: a single weight 5 % off is detected.
TEST(ReuseWeights, WrongOnesAreCaught) {
    for (int vertex = 0; vertex < size; ++vertex)
        for (int member = 0; member < size; ++member) {
            const auto tamper = [&](float d, int m, int v) { return m == member && v == vertex ? d * 1.05f : d; };
            EXPECT_GT(worst_deviation(received(no_pixel, tamper), no_pixel), 10 * rounding) << member << ", " << vertex;
        }
    const auto alike = [](float, int, int) { return 1.f; };
    EXPECT_GT(worst_deviation(received(no_pixel, alike), no_pixel), 10 * rounding) << "wrong shares that sum to one";
}

} // namespace
} // namespace blush::test::TEST_FILE
