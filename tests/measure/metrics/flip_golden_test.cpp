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

// LDR-FLIP of the sRGB-encoded 8-bit versions of the same images.
constexpr Printed printed_ldr[] = {
    {"cornell", 1, 0.075380, 0.081725, 0.116745, 0.159815, 0.476011},
    {"card-and-mug", 1, 0.090442, 0.074282, 0.107326, 0.152535, 0.403866},
};

std::filesystem::path golden_file(const std::string& name) { return std::filesystem::path(BLUSH_GOLDEN) / "flip" / name; }

RgbImage rgb_of(const std::string& name) {
    const Result<LayeredImage> image = read_layers(golden_file(name));
    if (!image) {
        ADD_FAILURE() << image.error().text();
        return {};
    }
    const auto [r, g, b] = image->find_color();
    RgbImage rgb{image->width, image->height, {}};
    for (size_t i = 0; i < r->values.size(); ++i) rgb.pixels.push_back({r->values[i], g->values[i], b->values[i]});
    return rgb;
}

RgbImage encoded_rgb_of(const std::string& name) {
    const Result<ImagePtr> image = read_image(golden_file(name));
    if (!image) {
        ADD_FAILURE() << image.error().text();
        return {};
    }
    RgbImage rgb{(*image)->width, (*image)->height, {}};
    const std::vector<uint8_t>& bytes = (*image)->bytes;
    for (size_t i = 0; i + 2 < bytes.size(); i += 3)
        rgb.pixels.push_back({float(bytes[i]) / 255, float(bytes[i + 1]) / 255, float(bytes[i + 2]) / 255});
    return rgb;
}

// The tool computes in float: of its sums four digits are certain, of a single pixel three.
void expect_printed(const FlipNumbers& n, const Printed& p) {
    EXPECT_NEAR(n.mean, p.mean, 5e-5) << p.scene;
    EXPECT_NEAR(n.first_quartile, p.first_quartile, 1e-4) << p.scene;
    EXPECT_NEAR(n.median, p.median, 1e-4) << p.scene;
    EXPECT_NEAR(n.third_quartile, p.third_quartile, 1e-4) << p.scene;
    EXPECT_NEAR(n.largest, p.largest, 1e-3) << p.scene;
}

TEST(FlipGolden, LdrFlipAgreesWithTheToolOfItsAuthors) {
    for (const Printed& p : printed_ldr) {
        const RgbImage reference = encoded_rgb_of(std::string(p.scene) + "-reference.png");
        ASSERT_FALSE(reference.pixels.empty());
        expect_printed(flip_numbers(ldr_flip(reference, encoded_rgb_of(std::string(p.scene) + "-test.png"))), p);
    }
}

TEST(FlipGolden, HdrFlipAgreesWithTheToolOfItsAuthors) {
    for (const Printed& p : printed) {
        const RgbImage reference = rgb_of(std::string(p.scene) + "-reference.exr"), test = rgb_of(std::string(p.scene) + "-test.exr");
        ASSERT_FALSE(reference.pixels.empty());
        EXPECT_EQ(hdr_flip_exposures(reference).count, p.exposures) << p.scene;
        const FlipNumbers n = flip_numbers(hdr_flip(reference, test));
        expect_printed(n, p);
        // Reference and test are not interchangeable: the reference sets the exposures.
        EXPECT_GT(std::abs(flip_numbers(hdr_flip(test, reference)).mean - p.mean), 1e-3) << p.scene;
    }
}

} // namespace
} // namespace blush::TEST_FILE
