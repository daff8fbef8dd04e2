// Path reuse keeps the mean of every part of an image, and changes only noise, whatever blocks the connections.
#include "render/error/error_estimate.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using statistics::Moments;
using statistics::sidak;
using statistics::significance;

// Pixels and blocks along each side. The shares of a group sum to
// one, so blocks as large as groups would be right for any shares.
constexpr int size = 32, blocks = 8;
using BlockMoments = std::array<Moments, blocks * blocks * 3>;

// Block means over independent seeds: pixels of a group are correlated, renders are not.
BlockMoments over_seeds(const Scene& scene, RenderSettings settings, uint32_t first_seed, int seeds) {
    constexpr int side = size / blocks;
    BlockMoments moments;
    RendererOptions options;
    options.threads = 1;
    Renderer renderer(options);
    for (int i = 0; i < seeds; ++i) {
        settings.seed = first_seed + uint32_t(i);
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        const Frame frame = renderer.resolve();
        EXPECT_EQ(frame.health.dropped(), 0);
        for (int block = 0; block < blocks * blocks; ++block)
            for (int c = 0; c < 3; ++c) {
                double sum = 0;
                for (int y = 0; y < side; ++y)
                    for (int x = 0; x < side; ++x)
                        sum += double(frame.rgba[4 * size_t((block / blocks * side + y) * size + block % blocks * side + x) + size_t(c)]);
                moments[size_t(block * 3 + c)].add(sum / (side * side));
            }
    }
    return moments;
}

void expect_same_means(const Scene& scene, const RenderSettings& settings, std::initializer_list<int> group_sizes, int seeds) {
    const BlockMoments alone = over_seeds(scene, settings, 1, seeds);
    const double alpha = sidak(significance, int64_t(alone.size() * group_sizes.size()));
    for (const int group_size : group_sizes) {
        RenderSettings shared = settings;
        shared.reuse = group_size;
        const BlockMoments together = over_seeds(scene, shared, 1000 * uint32_t(group_size), seeds);
        for (size_t i = 0; i < alone.size(); ++i)
            EXPECT_TRUE(statistics::same_mean(alone[i], together[i], alpha)) << group_size << " pixels, block and channel " << i;
    }
}

// A room with everything that can end or block a connection: textures that reflect no green or nothing, a sphere with
// interpolated normals, a wall with a normal map, a veil with alpha, a mirror and a glossy box, and a one-sided light.
Scene obstacle_room() {
    Scene scene;
    const std::array<Vec3, 4> texels{{{0.9f, 0, 0.4f}, {0.8f, 0.8f, 0.8f}, {0, 0, 0}, {0.5f, 0.9f, 0}}};
    Material checks = lambert(1);
    checks.base_color_texture.texture = add_texture(scene, float_image(2, 2, texels));
    place(scene, quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}), checks);

    Geometry bumpy = *quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1});
    bumpy.serial = next_payload_serial();
    bumpy.normals.assign(4, {0, 0, 1});
    bumpy.tangents.assign(4, {1, 0, 0, 1});
    const std::array<Vec3, 4> normals{{{0.9f, 0.5f, 0.7f}, {0.3f, 0.6f, 0.8f}, {0.5f, 0.5f, 1}, {0.5f, 0.1f, 0.6f}}};
    Material mapped = lambert({0.7f, 0.7f, 0.5f});
    mapped.normal_texture.texture = add_texture(scene, float_image(2, 2, normals));
    place(scene, std::make_shared<const Geometry>(bumpy), mapped);

    place(scene, quad({-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}), lambert({0.8f, 0.1f, 0.1f}));
    place(scene, quad({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}), lambert({0.1f, 0.6f, 0.2f}));
    place(scene, ceiling_quad(1, 1), lambert(0.75f));

    Geometry smooth = *sphere(false);
    smooth.serial = next_payload_serial();
    smooth.normals = smooth.positions;
    place(scene, std::make_shared<const Geometry>(smooth), lambert(0.8f), at({-0.45f, -0.6f, -0.2f}, 0.35f));
    place(scene, cube(false), plastic(0.3f), at({0.5f, -0.75f, -0.3f}, 0.25f));
    place(scene, cube(false), metal(0), at({0.55f, -0.8f, 0.45f}, 0.15f));
    Material veil = lambert(0.6f);
    veil.alpha = Material::Alpha::blend;
    veil.opacity = 0.5f;
    place(scene, quad({-0.6f, -0.9f, 0.3f}, {0.4f, -0.9f, 0.4f}, {0.4f, 0.3f, 0.2f}, {-0.6f, 0.3f, 0.3f}), veil);
    Material lamp = emitter(15, 0.5f);
    lamp.double_sided = false;
    place(scene, ceiling_quad(0.25f, 0.9f), lamp);
    scene.view = looking({0, 0, 2.9f}, {0, -0.1f, 0}, 0.75f);
    return scene;
}

TEST(PathReuse, KeepsTheMeanOfADiffuseRoom) { expect_same_means(shipped_scene("cornell"), settings_for(size, size, 8), {4, 8, 16}, 48); }

TEST(PathReuse, KeepsTheMeanAmongObstacles) { expect_same_means(obstacle_room(), settings_for(size, size, 8), {4, 16}, 48); }

TEST(PathReuse, KeepsTheMeanWhereverPathsEnd) {
    const Scene scene = obstacle_room();
    for (const int bounces : {1, 2, 3}) {
        SCOPED_TRACE(bounces);
        RenderSettings settings = settings_for(size, size, 4);
        settings.max_bounces = bounces;
        expect_same_means(scene, settings, {16}, 64);
    }
    for (const char* rule : {"off", "constant=0.6,start=1", "max,start=1"}) {
        SCOPED_TRACE(rule);
        RenderSettings settings = settings_for(size, size, 4);
        settings.roulette = *parse_roulette(rule);
        settings.max_bounces = 8;
        expect_same_means(scene, settings, {16}, 64);
    }
}

TEST(PathReuse, KeepsTheMeanOfEveryStrategy) {
    const Scene scene = shipped_scene("cornell");
    for (const Strategy strategy : {Strategy::light, Strategy::bsdf}) {
        RenderSettings settings = settings_for(size, size, 16);
        settings.strategy = strategy;
        expect_same_means(scene, settings, {16}, 32);
    }
}

// Le / (1 - rho): all scattering is diffuse and infinite.
TEST(PathReuse, KeepsTheLightOfAClosedSphere) {
    Scene scene;
    place(scene, sphere(true), emitter(2, 0.8f));
    scene.view = looking({0.1f, -0.2f, 0.3f}, {0.9f, 0.35f, -0.8f}, 1.2f);
    RenderSettings settings = settings_for(size, size, 4);
    settings.reuse = 16;
    for (const Moments& m : over_seeds(scene, settings, 1, 24))
        EXPECT_TRUE(statistics::z_test(m, 2 / 0.2, sidak(significance, int64_t(std::tuple_size_v<BlockMoments>))));
}

double mean_square(const Scene& scene, RenderSettings settings) {
    const RenderedImage a = render(scene, settings);
    settings.seed += 1;
    const RenderedImage b = render(scene, settings);
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(a.pixels[i].y - b.pixels[i].y, 2);
    return sum;
}

TEST(PathReuse, LowersTheNoiseOfIndirectLight) {
    for (const char* name : {"cornell", "corridor"}) {
        RenderSettings settings = settings_for(64, 64, 8);
        const double alone = mean_square(shipped_scene(name), settings);
        settings.reuse = 16;
        EXPECT_LT(mean_square(shipped_scene(name), settings), alone) << name;
    }
}

// A film whose border cuts cells and groups, and one smaller than a group.
TEST(PathReuse, WorksAtTheFilmsBorder) {
    for (const auto& [width, height] : {std::pair{37, 19}, {3, 2}, {1, 1}}) {
        RenderSettings settings = settings_for(width, height, 16);
        settings.reuse = 16;
        const RenderedImage p = render(shipped_scene("cornell"), settings);
        for (const Vec3d& pixel : p.pixels) EXPECT_GE(pixel.y, 0);
    }
}

// ---- groups

// For uniform sampling, and for a sample plan.
std::vector<ReuseGroups> groupings() {
    std::vector<ReuseGroups> all;
    for (const int size : {4, 8, 16}) all.insert(all.end(), {reuse_groups(size), reuse_groups(size, 16, 16)});
    return all;
}

TEST(ReuseGroups, ContainEveryPixelOnceAndOnePerCell) {
    for (const ReuseGroups& groups : groupings()) {
        const int pixels = groups.block_width * groups.block_height;
        ASSERT_EQ(groups.size() * groups.per_block(), pixels);
        for (const int64_t sample : {int64_t(0), int64_t(1), int64_t(7), (int64_t(1) << 40) + 3}) {
            const BlockGroups in_block(groups, 64, 96, sample);
            std::set<int> seen;
            for (int group = 0; group < groups.per_block(); ++group)
                for (int member = 0; member < groups.size(); ++member) {
                    const auto [x, y] = in_block.pixel(group, member);
                    ASSERT_TRUE(x >= 0 && y >= 0 && x < groups.block_width && y < groups.block_height);
                    EXPECT_EQ(y / groups.cell_height() * groups.columns + x / groups.cell_width(), member);
                    seen.insert(y * groups.block_width + x);
                }
            EXPECT_EQ(seen.size(), size_t(pixels));
        }
    }
}

// How often one pixel shares with each of the others, over many samples: uniform over other cells.
TEST(ReuseGroups, SelectNewPartnersForEverySample) {
    for (const ReuseGroups& groups : groupings()) {
        constexpr int64_t samples = 20000;
        const int width = groups.block_width, pixels = width * groups.block_height;
        std::vector<int64_t> met(static_cast<size_t>(pixels));
        for (int64_t sample = 0; sample < samples; ++sample) {
            const BlockGroups in_block(groups, 64, 96, sample);
            for (int group = 0; group < groups.per_block(); ++group) {
                const auto [x, y] = in_block.pixel(group, 0);
                if (x != 1 || y != 2) continue;
                for (int member = 1; member < groups.size(); ++member) {
                    const auto [px, py] = in_block.pixel(group, member);
                    ++met[size_t(py * width + px)];
                }
            }
        }
        // Chi-squared over the pixels of other cells, by its normal approximation: there are hundreds.
        const double expected = double(samples) / groups.per_block(), others = pixels - groups.per_block();
        double chi_squared = 0;
        for (int i = 0; i < pixels; ++i) {
            const double count = double(met[size_t(i)]);
            if (i % width < groups.cell_width() && i / width < groups.cell_height())
                EXPECT_EQ(count, 0);
            else
                chi_squared += (count - expected) * (count - expected) / expected;
        }
        EXPECT_GT(statistics::normal_p((chi_squared - others) / std::sqrt(2 * others)), significance) << groups.size() << " of " << pixels;
    }
}

// Variance of the means of squares of 4 x 4 pixels, from the difference of two independent renders.
constexpr int wide = 64, high = 32, square = 4;
std::vector<double> noise_of_squares(Renderer& renderer, const Scene& scene, RenderSettings settings) {
    std::vector<double> means(size_t(wide / square * high / square));
    for (const double sign : {1.0, -1.0}) {
        ++settings.seed;
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        const Frame frame = renderer.resolve();
        for (int y = 0; y < high; ++y)
            for (int x = 0; x < wide; ++x)
                means[size_t(y / square * (wide / square) + x / square)] += sign * double(frame.rgba[4 * size_t(y * wide + x) + 1]);
    }
    return means;
}

// Groups with a pixel of each of the 4 x 4 squares within 16 pixels would give all these squares the same mean error: a visible
// block pattern. Neighbouring squares must be no more correlated inside 16 pixels than across such a border.
TEST(PathReuse, HasNoBlockPattern) {
    const Scene scene = shipped_scene("corridor");
    for (const int group_size : {8, 16}) {
        RenderSettings settings = settings_for(wide, high, 8);
        settings.reuse = group_size;
        Renderer renderer({.threads = 1, .planes = {}});
        Moments within, across;
        for (uint32_t pair = 0; pair < 48; ++pair) {
            settings.seed = 2 * pair;
            const std::vector<double> noise = noise_of_squares(renderer, scene, settings);
            double squares = 0, in = 0, out = 0;
            for (size_t i = 0; i < noise.size(); ++i) {
                const size_t column = i % (wide / square);
                squares += noise[i] * noise[i];
                if (column > 0) (column % 4 == 0 ? out : in) += noise[i - 1] * noise[i];
            }
            // Of 16 columns, 12 have their left neighbour within 16 pixels, 3 across a border.
            within.add(in / 12 / (squares / 16));
            across.add(out / 3 / (squares / 16));
        }
        EXPECT_TRUE(statistics::same_mean(within, across, sidak(significance, 2))) << group_size;
    }
}

// Scatter of the mean of an image over seeds, compared with its pixels' errors and their measured correlation.
TEST(PathReuse, MeasuresTheErrorCorrelation) {
    const Scene scene = shipped_scene("corridor");
    constexpr int width = 128, height = 64; // four blocks
    RenderSettings settings = settings_for(width, height, 8);
    settings.reuse = 16;
    Renderer renderer({.threads = 1, .planes = {}});
    Moments means, told;
    double shared = 0;
    constexpr int seeds = 64;
    for (int seed = 0; seed < seeds; ++seed) {
        settings.seed = uint32_t(seed);
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        const Frame frame = renderer.resolve();
        double sum = 0, squares = 0;
        for (size_t i = 0; i < frame.rgba.size(); i += 4) sum += double(frame.rgba[i + 1]);
        for (const Vec3& e : renderer.resolve_error()) squares += double(e.y) * double(e.y);
        constexpr double pixels = width * height;
        means.add(sum / pixels);
        told.add(squares / (pixels * pixels) * renderer.reuse_covariance().means);
        shared += renderer.reuse_covariance().means / seeds;
    }
    EXPECT_GT(shared, 1.5) << "the test needs correlated errors";
    // A variance from 64 normal means has a relative standard error of sqrt(2 / 63).
    EXPECT_NEAR(means.variance() / told.mean, 1, 4 * std::sqrt(2.0 / (seeds - 1)));
}

} // namespace
} // namespace blush::test::TEST_FILE
