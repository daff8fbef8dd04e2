#include "render/denoise/joint_upsampling.h"

#include "core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace blush {
namespace {

constexpr float min_albedo = 0.02f; // added to albedos, so that black surfaces keep their light
// A weight is that of bilinear interpolation over (1 + penalty)^2. The penalty is 1 for normals or albedos that differ by 0.16 (the
// length of the difference), and for depths that differ by a twentieth.
constexpr float normal_penalty = 40, albedo_penalty = 40, depth_scale = 20;
constexpr float min_share = 0.01f; // of a pixel that is alike but far away, if those nearby are not alike
constexpr float no_depth = 1e-30f; // against 0 / 0

enum Channel { irradiance_r, irradiance_g, irradiance_b, albedo_r, albedo_g, albedo_b, normal_x, normal_y, normal_z, depth, channels };
constexpr int taps = 4; // left and right above, left and right below

// One array for each number of a pixel, so that loops over pixels have no strides.
struct Row {
    explicit Row(int width) : stride(size_t(width)), values(stride * channels) {}
    float* operator[](int channel) { return values.data() + stride * size_t(channel); }
    const float* operator[](int channel) const { return values.data() + stride * size_t(channel); }

    size_t stride;
    std::vector<float> values;
};

// Where fine pixels lie between coarse ones, along one axis: between `first` and `first` + 1, `share` of the way.
struct Place {
    int first;
    float share;
};
Place place_of(int pixel, int fine, int coarse) {
    const float at = (float(pixel) + 0.5f) * float(coarse) / float(fine) - 0.5f;
    const float floor = std::floor(at);
    return {int(floor), at - floor};
}

class Upsampling {
public:
    Upsampling(std::span<const float> rgb, const FirstHitPlanes& coarse, const FirstHitPlanes& fine, std::vector<float>& out)
        : rgb_(rgb), coarse_(coarse), fine_(fine), out_(out), share_(size_t(fine.width)) {
        for (int x = 0; x < fine.width; ++x) {
            const Place place = place_of(x, fine.width, coarse.width);
            first_.push_back(place.first);
            share_[size_t(x)] = place.share;
        }
    }

    // All fine rows between coarse rows `band` - 1 and `band`.
    void run(int64_t band) const {
        const int above = int(band) - 1;
        int y = std::max(0, int(float(above) * float(fine_.height) / float(coarse_.height)) - 1);
        std::vector<Row> around;
        for (; y < fine_.height; ++y) {
            const Place place = place_of(y, fine_.height, coarse_.height);
            if (place.first > above) return;
            if (place.first < above) continue;
            if (around.empty())
                for (int tap = 0; tap < taps; ++tap) around.push_back(coarse_row(above + tap / 2, tap % 2));
            fill_row(y, place.share, around);
        }
    }

private:
    // For each fine pixel, the coarse one of this row to its left (0) or right (1).
    Row coarse_row(int y, int side) const {
        Row row(fine_.width);
        y = std::clamp(y, 0, coarse_.height - 1);
        for (int x = 0; x < fine_.width; ++x) {
            const int from_x = std::clamp(first_[size_t(x)] + side, 0, coarse_.width - 1);
            const size_t from = size_t(y) * size_t(coarse_.width) + size_t(from_x);
            const Vec3 albedo = albedo_of(coarse_, from), normal = coarse_.normal[from];
            row[irradiance_r][x] = rgb_[3 * from] / (albedo.x + min_albedo);
            row[irradiance_g][x] = rgb_[3 * from + 1] / (albedo.y + min_albedo);
            row[irradiance_b][x] = rgb_[3 * from + 2] / (albedo.z + min_albedo);
            store(row, x, albedo, normal, coarse_.depth[from]);
        }
        return row;
    }

    // The albedo of a miss is the radiance of the background, which edits of light change.
    static Vec3 albedo_of(const FirstHitPlanes& planes, size_t pixel) {
        return planes.depth[pixel] > 0 ? planes.albedo[pixel] : Vec3{0, 0, 0};
    }

    static void store(Row& row, int x, const Vec3& albedo, const Vec3& normal, float distance) {
        row[albedo_r][x] = albedo.x;
        row[albedo_g][x] = albedo.y;
        row[albedo_b][x] = albedo.z;
        row[normal_x][x] = normal.x;
        row[normal_y][x] = normal.y;
        row[normal_z][x] = normal.z;
        row[depth][x] = distance;
    }

    void fill_row(int y, float below, const std::vector<Row>& around) const {
        const auto width = size_t(fine_.width), begin = size_t(y) * width;
        Row here(fine_.width), sum(fine_.width);
        for (size_t x = 0; x < width; ++x)
            store(here, int(x), albedo_of(fine_, begin + x), fine_.normal[begin + x], fine_.depth[begin + x]);
        for (int tap = 0; tap < taps; ++tap) {
            const float vertical = tap / 2 ? below : 1 - below;
            add_tap(here, around[size_t(tap)], tap % 2 ? 0 : vertical, tap % 2 ? vertical : -vertical, sum);
        }
        float* to = &out_[3 * begin];
        for (size_t x = 0; x < width; ++x) {
            const float scale = 1 / sum[depth][x];
            to[3 * x] = (here[albedo_r][x] + min_albedo) * (sum[irradiance_r][x] * scale);
            to[3 * x + 1] = (here[albedo_g][x] + min_albedo) * (sum[irradiance_g][x] * scale);
            to[3 * x + 2] = (here[albedo_b][x] + min_albedo) * (sum[irradiance_b][x] * scale);
        }
    }

    // Adds irradiance times weight, and in place of the depth the weight. The share of a pixel is `constant` + `slope` times its place.
    void add_tap(const Row& here, const Row& tap, float constant, float slope, Row& sum) const {
        const float *nx = here[normal_x], *ny = here[normal_y], *nz = here[normal_z];
        const float *ar = here[albedo_r], *ag = here[albedo_g], *ab = here[albedo_b];
        const float *tap_nx = tap[normal_x], *tap_ny = tap[normal_y], *tap_nz = tap[normal_z];
        const float *tap_ar = tap[albedo_r], *tap_ag = tap[albedo_g], *tap_ab = tap[albedo_b];
        const float *r = tap[irradiance_r], *g = tap[irradiance_g], *b = tap[irradiance_b];
        const float *z = here[depth], *tap_z = tap[depth], *place = share_.data();
        float *sum_r = sum[irradiance_r], *sum_g = sum[irradiance_g], *sum_b = sum[irradiance_b];
        float* sum_w = sum[depth];
        const auto squared = [](float d) { return d * d; };
#pragma omp simd
        for (size_t x = 0; x < size_t(fine_.width); ++x) {
            const float normals = squared(nx[x] - tap_nx[x]) + squared(ny[x] - tap_ny[x]) + squared(nz[x] - tap_nz[x]);
            const float albedos = squared(ar[x] - tap_ar[x]) + squared(ag[x] - tap_ag[x]) + squared(ab[x] - tap_ab[x]);
            const float farthest = (z[x] > tap_z[x] ? z[x] : tap_z[x]) + no_depth;
            const float depths = squared(depth_scale * (z[x] - tap_z[x]) / farthest);
            const float share = constant + slope * place[x] + min_share;
            const float w = share / squared(1 + normal_penalty * normals + albedo_penalty * albedos + depths);
            sum_r[x] += w * r[x];
            sum_g[x] += w * g[x];
            sum_b[x] += w * b[x];
            sum_w[x] += w;
        }
    }

    std::span<const float> rgb_;
    const FirstHitPlanes &coarse_, &fine_;
    std::vector<float>& out_;
    std::vector<int> first_;
    std::vector<float> share_;
};

} // namespace

std::vector<float> upsample_jointly(std::span<const float> rgb, const FirstHitPlanes& coarse, const FirstHitPlanes& fine,
                                    const Workers* workers) {
    std::vector<float> out(size_t(fine.width) * size_t(fine.height) * 3);
    const Upsampling upsampling(rgb, coarse, fine, out);
    const int bands = coarse.height + 1;
    if (workers)
        workers->for_each(bands, {}, [&](int64_t band, unsigned) { upsampling.run(band); });
    else
        for (int band = 0; band < bands; ++band) upsampling.run(band);
    return out;
}

} // namespace blush
