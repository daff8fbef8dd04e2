// Samples that aim at places of highlights: their density, their weights, and which pixels aim.
#include "render/film/edges/highlight_places.h"

#include "render/integrator/camera.h"
#include "tests/support/random_numbers.h"
#include "tests/support/statistics.h"

#include <array>
#include <cmath>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

using statistics::Moments;

constexpr int size = 8, pixel_x = 3, pixel_y = 5;

// Two rectangles with edges at eighths of the pixel, one of them rotated by a right angle.
std::vector<HighlightPlace> two_places() {
    return {{.x = pixel_x + 0.25, .y = pixel_y + 0.375, .ax = 0.125, .ay = 0, .bx = 0, .by = 0.125, .light = 3},
            {.x = pixel_x + 0.5, .y = pixel_y + 0.5, .ax = 0, .ay = 0.125, .bx = 0.25, .by = 0, .light = 2}};
}
// Also one that two pixels see, and one without area.
std::vector<HighlightPlace> slanted_places() {
    return {{.x = pixel_x + 0.9, .y = pixel_y + 0.2, .ax = 0.3, .ay = 0.1, .bx = -0.02, .by = 0.06, .light = 5},
            {.x = pixel_x + 0.3, .y = pixel_y + 0.6, .ax = 0.004, .ay = 0.001, .bx = -0.002, .by = 0.003, .light = 900},
            {.x = pixel_x + 0.3, .y = pixel_y + 0.6, .ax = 0.2, .ay = 0.2, .bx = 0.1, .by = 0.1, .light = 900}};
}

TEST(HighlightPlaces, SamplesHaveTheDensityOfFilterAndPlaces) {
    const FilterTable& filter = box_filter();
    const HighlightPlaces places(two_places(), size, size, filter);
    constexpr int cells = 8;
    std::vector<int64_t> counts(cells * cells);
    std::vector<double> expected(cells * cells);
    constexpr int64_t samples = 200000;
    const std::vector<HighlightPlace> two = two_places();
    // All light of a place is seen, so a place is selected in proportion to its light times its area.
    const double light = two[0].light * two[0].area() + two[1].light * two[1].area();
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const double x = pixel_x + (i + 0.5) / cells, y = pixel_y + (j + 0.5) / cells;
            double q = 0.5;
            for (const HighlightPlace& p : two)
                if (p.contains(x, y)) q += 0.5 * p.light / light;
            expected[size_t(j * cells + i)] = double(samples) * q / (cells * cells);
        }
    RandomNumbers random(1);
    for (int64_t k = 0; k < samples; ++k) {
        const auto s = places.sample(pixel_x, pixel_y, double(random()), double(random()), filter);
        const int i = int((s.x - pixel_x) * cells), j = int((s.y - pixel_y) * cells);
        ASSERT_TRUE(i >= 0 && i < cells && j >= 0 && j < cells) << s.x << ", " << s.y;
        ++counts[size_t(j * cells + i)];
        const double density = expected[size_t(j * cells + i)] * (cells * cells) / double(samples);
        EXPECT_NEAR(s.weight, 1 / density, 1e-4) << s.x << ", " << s.y;
    }
    EXPECT_TRUE(statistics::chi_squared_test(counts, expected));
}

// The filter's mean of a function, by samples that aim and by samples of the filter alone.
TEST(HighlightPlaces, SamplesKeepTheMeanOfAnyFunction) {
    const std::array<const FilterTable*, 2> filters{&box_filter(), &blackman_harris_filter()};
    const double alpha = statistics::sidak(statistics::significance, 3 * int64_t(filters.size()));
    for (const FilterTable* filter : filters) {
        const HighlightPlaces places(slanted_places(), size, size, *filter), none;
        ASSERT_TRUE(places.aims(pixel_x, pixel_y));
        RandomNumbers random(2);
        std::array<Moments, 3> aimed, plain;
        const auto add = [&](std::array<Moments, 3>& to, double x, double y, double weight) {
            to[0].add(weight);
            to[1].add(weight * (x * x + y));
            to[2].add(slanted_places()[0].contains(x, y) ? weight : 0);
        };
        for (int k = 0; k < 200000; ++k) {
            const auto s = places.sample(pixel_x, pixel_y, double(random()), double(random()), *filter);
            EXPECT_LE(s.weight, 2.000001);
            EXPECT_GE(s.weight, 0);
            add(aimed, s.x, s.y, s.weight);
            const float u = random(), v = random();
            add(plain, pixel_x + 0.5 + double(filter_offset<float>(*filter, u)), pixel_y + 0.5 + double(filter_offset<float>(*filter, v)),
                1);
        }
        EXPECT_TRUE(statistics::z_test(aimed[0], 1, alpha));
        EXPECT_TRUE(statistics::same_mean(aimed[1], plain[1], alpha));
        EXPECT_TRUE(statistics::same_mean(aimed[2], plain[2], alpha));
    }
}

TEST(HighlightPlaces, OnlyPixelsThatSeeOneAim) {
    const auto aiming = [](const FilterTable& filter, const std::vector<HighlightPlace>& all) {
        const HighlightPlaces places(all, size, size, filter);
        std::vector<std::array<int, 2>> pixels;
        places.for_each_pixel([&](int x, int y, double) { pixels.push_back({x, y}); });
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                EXPECT_EQ(places.aims(x, y), std::ranges::find(pixels, std::array{x, y}) != pixels.end()) << x << ", " << y;
        return pixels;
    };
    const std::array one{pixel_x, pixel_y}, right{pixel_x + 1, pixel_y};
    EXPECT_EQ(aiming(box_filter(), two_places()), (std::vector{one}));
    EXPECT_EQ(aiming(box_filter(), slanted_places()), (std::vector{one, right}));
    EXPECT_GT(aiming(blackman_harris_filter(), two_places()).size(), 1u) << "its radius is more than half a pixel";
    // Outside of the image, and beyond what integers hold.
    EXPECT_TRUE(aiming(box_filter(), {{.x = -3, .y = 2, .ax = 1, .ay = 0, .bx = 0, .by = 1, .light = 1}}).empty());
    EXPECT_TRUE(aiming(box_filter(), {{.x = 1e30, .y = 2, .ax = 1, .ay = 0, .bx = 0, .by = 1, .light = 1}}).empty());
    EXPECT_TRUE(HighlightPlaces().empty());
}

} // namespace
} // namespace blush::test::TEST_FILE
