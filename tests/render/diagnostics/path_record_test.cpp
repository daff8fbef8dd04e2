// Where the light of a path counts: by strategy and by length.
#include "render/diagnostics/path_record.h"

#include <gtest/gtest.h>

#include <limits>

namespace blush::test::TEST_FILE {
namespace {

Vec3 grey(float x) { return {x, x, x}; }

// Each contribution is another power of two, so that sums tell which of them are in.
RecordedPath path_of_all_light() {
    RecordedPath path;
    PathVertex first, second, third;
    first.emission = grey(1);
    first.panes = grey(2);
    first.next_event.emplace().arrived = grey(4);
    first.chains = grey(8);
    second.bounce = 1;
    second.guided = 0.25f;
    second.emission = grey(16);
    second.next_event.emplace().arrived = grey(32);
    third.bounce = 2;
    third.past = grey(64);
    third.light_vertices = grey(256);
    path.vertices = {first, second, third};
    path.light_paths = grey(128);
    path.radiance = grey(127 + 256);
    return path;
}

TEST(PathRecord, SplitsItsLightByStrategy) {
    const LightByStrategy found = by_strategy(path_of_all_light());
    EXPECT_EQ(found[size_t(FoundBy::camera_hit)].x, 1 + 2 + 12 + 64);
    EXPECT_EQ(found[size_t(FoundBy::guided)].x, 4);
    EXPECT_EQ(found[size_t(FoundBy::nee)].x, 4 + 32);
    EXPECT_EQ(found[size_t(FoundBy::manifold)].x, 8);
    EXPECT_EQ(found[size_t(FoundBy::light_vertex)].x, 256);
    EXPECT_EQ(found[size_t(FoundBy::light_path)].x, 128);
}

// Light of manifold sampling and of light vertices goes over at least one more surface.
TEST(PathRecord, SplitsItsLightByLength) {
    const RecordedPath path = path_of_all_light();
    const auto at = [&](size_t lengths, size_t k) { return by_length(path, lengths)[k].x; };
    EXPECT_EQ(at(8, 0), 1 + 2);
    EXPECT_EQ(at(8, 1), 4 + 16);
    EXPECT_EQ(at(8, 2), 8 + 32 + 64);
    EXPECT_EQ(at(8, 3), 0);
    EXPECT_EQ(at(8, 4), 256);
    EXPECT_EQ(at(2, 1), 127 + 256 - 3);
}

TEST(PathRecord, IsInvalidLikeTheFilms) {
    RecordedPath path = path_of_all_light();
    EXPECT_TRUE(path.is_valid());
    EXPECT_EQ(path.total().x, 511);
    EXPECT_EQ(path.vertices[0].received().x, 15);
    path.radiance.y = -1e-9f;
    EXPECT_FALSE(path.is_valid());
    path.radiance.y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(path.is_valid());
    path.radiance.y = 1;
    path.light_paths.z = std::numeric_limits<float>::infinity();
    EXPECT_FALSE(path.is_valid());
}

} // namespace
} // namespace blush::test::TEST_FILE
