// FLIP against the values that the authors' own tool printed for the same images (tests/golden/flip/README.md).
#include "io/image/image_io.h"
#include "measure/metrics/flip.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace blush::TEST_FILE {
namespace {

struct Printed {
    const char* scene;
    int exposures;
    double mean, first_quartile, median, third_quartile, largest;
};
constexpr Printed printed[] = {
    {"cornell", 9, 0.214790, 0.211265, 0.328820, 0.463830, 0.871130},
    {"card-and-mug", 2, 0.074743, 0.059635, 0.086553, 0.140388, 0.409453},
};

RgbImage rgb_of(const std::string& name) {
    const Result<LayeredImage> image = read_layers(std::filesystem::path(BLUSH_GOLDEN) / "flip" / name);
    if (!image) {
        ADD_FAILURE() << image.error().text();
        return {};
    }
    const auto [r, g, b] = image->find_color();
    RgbImage rgb{image->width, image->height, {}};
    for (size_t i = 0; i < r->values.size(); ++i) rgb.pixels.push_back({r->values[i], g->values[i], b->values[i]});
    return rgb;
}

TEST(FlipGolden, AgreesWithTheToolOfItsAuthors) {
    for (const Printed& p : printed) {
        const RgbImage reference = rgb_of(std::string(p.scene) + "-reference.exr"), test = rgb_of(std::string(p.scene) + "-test.exr");
        ASSERT_FALSE(reference.pixels.empty());
        EXPECT_EQ(hdr_flip_exposures(reference).count, p.exposures) << p.scene;
        const FlipNumbers n = flip_numbers(hdr_flip(reference, test));
        // The tool computes in float: of its sums four digits are certain, of a single pixel three.
        EXPECT_NEAR(n.mean, p.mean, 5e-5) << p.scene;
        EXPECT_NEAR(n.first_quartile, p.first_quartile, 1e-4) << p.scene;
        EXPECT_NEAR(n.median, p.median, 1e-4) << p.scene;
        EXPECT_NEAR(n.third_quartile, p.third_quartile, 1e-4) << p.scene;
        EXPECT_NEAR(n.largest, p.largest, 1e-3) << p.scene;
        // Reference and test are not interchangeable: the reference sets the exposures.
        EXPECT_GT(std::abs(flip_numbers(hdr_flip(test, reference)).mean - p.mean), 1e-3) << p.scene;
    }
}

} // namespace
} // namespace blush::TEST_FILE
