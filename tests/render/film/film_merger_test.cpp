// Parts of one image merge to that image, bit for bit, however its samples are split.
#include "render/film/film_merger.h"
#include "render/renderer.h"
#include "tests/render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

constexpr int samples = 12;
using Range = std::pair<int, int>; // [first, last)

RenderSettings small() {
    RenderSettings settings;
    settings.width = 8;
    settings.height = 6;
    settings.spp = samples;
    return settings;
}

RendererOptions with_planes(bool is_part) {
    return {.threads = 2, .planes = {.albedo = true, .normal = true, .bounces = 3, .strategies = true}, .is_part = is_part};
}

// Renders its parts with the pilots run once.
class Image {
public:
    explicit Image(const char* scene) : renderer_(with_planes(true)) { renderer_.update(shipped_scene(scene), settings); }

    FilmState render(const Range& range) {
        renderer_.clear();
        renderer_.render(range.first, range.second - range.first);
        return *renderer_.save_film(range.first);
    }

    const RenderSettings settings = small();

private:
    Renderer renderer_;
};

std::vector<Range> random_partition(std::mt19937& random) {
    std::vector<Range> ranges;
    for (int first = 0; first < samples;) {
        const int last = std::min(samples, first + 1 + int(random() % 6));
        ranges.emplace_back(first, last);
        first = last;
    }
    return ranges;
}

// Of a scene with path reuse and smooth edges, and of one with light paths and path guiding.
TEST(FilmMerger, DoesNotDependOnThePartition) {
    for (const char* scene : {"cornell", "wine-glass"}) {
        SCOPED_TRACE(scene);
        Image image(scene);
        const FilmState whole = image.render({0, samples});
        std::map<Range, FilmState> parts;
        std::mt19937 random(20);
        for (int k = 0; k < 200; ++k) {
            FilmMerger merger(image.settings);
            for (const Range& range : random_partition(random)) {
                if (!parts.contains(range)) parts.emplace(range, image.render(range));
                ASSERT_TRUE(merger.add(parts.at(range)));
            }
            const FilmState sum = merger.sum();
            EXPECT_EQ(sum.samples, samples);
            EXPECT_EQ(sum.passes, whole.passes);
            EXPECT_TRUE(sum.planes == whole.planes);
        }
    }
}

// Two merged halves are a part again.
TEST(FilmMerger, MergesMergedParts) {
    Image image("cornell");
    const FilmState a = *merge_films(image.render({0, 2}), image.render({2, 5}), image.settings),
                    b = *merge_films(image.render({9, 12}), image.render({5, 9}), image.settings);
    EXPECT_TRUE(merge_films(b, a, image.settings)->planes == image.render({0, samples}).planes);
}

// As when the window opens it.
TEST(FilmMerger, APartByAnAllocationGoesOnWithItsNextSample) {
    const Scene scene = shipped_scene("veach-mis");
    RenderSettings settings = small();
    settings.width = 48;
    settings.height = 32;
    settings.adaptive = true;
    RendererOptions options = with_planes(true);
    const auto render = [&](int64_t first, int64_t count) {
        Renderer renderer(options);
        renderer.update(scene, settings);
        renderer.render(first, count);
        return *renderer.save_film(first);
    };
    options.allocation = render(0, 16).shares;
    Renderer renderer(with_planes(false));
    renderer.update(scene, settings);
    ASSERT_TRUE(renderer.load_film(render(16, 4)));
    renderer.render(20, 4);
    EXPECT_TRUE(renderer.save_film(16)->planes == render(16, 8).planes);
}

TEST(FilmMerger, RefusesGapsOverlapsAndARoughFirstSample) {
    Image image("cornell");
    FilmMerger merger(image.settings);
    ASSERT_TRUE(merger.add(image.render({0, 3})));
    EXPECT_EQ(merger.add(image.render({4, 5})).error().what, "samples 3 to 3 are in neither file");
    EXPECT_EQ(merger.add(image.render({2, 4})).error().what, "both files contain sample 2");
    ASSERT_TRUE(merger.add(image.render({3, 4})));
    EXPECT_EQ(merger.sum().samples, 4);

    Renderer renderer(with_planes(false));
    renderer.update(shipped_scene("cornell"), image.settings);
    renderer.render(0, 1);
    FilmMerger rough(image.settings);
    ASSERT_TRUE(rough.add(*renderer.save_film(0)));
    EXPECT_FALSE(rough.add(image.render({1, 2})));
}

} // namespace
} // namespace blush::test::TEST_FILE
