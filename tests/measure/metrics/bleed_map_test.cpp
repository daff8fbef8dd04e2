// The map of the greatest senders: a floor between two walls is coloured by the nearer one.
#include "measure/metrics/bleed_map.h"
#include "tests/render/rendered_image.h"
#include "tests/render/scenes.h"

namespace blush::test::TEST_FILE {
namespace {

TEST(BleedMap, ShowsTheNearerWall) {
    Scene scene;
    place(scene, floor_quad(1), lambert(0.5f));
    const Id<Node> left = place(scene, quad({-1, 0, 1}, {-1, 0, -1}, {-1, 1, -1}, {-1, 1, 1}), lambert({0.8f, 0.1f, 0.1f}));
    const Id<Node> right = place(scene, quad({1, 0, -1}, {1, 0, 1}, {1, 1, 1}, {1, 1, -1}), lambert({0.1f, 0.8f, 0.1f}));
    Light light;
    light.intensity = 10;
    place_light(scene, light, at({0, 2, 0}));
    scene.view = looking_down(0.9f, 3);
    BleedMap map(2);
    map.begin(scene, settings_for(70, 64, 1), 16);
    while (map.grid().passes < 1) ASSERT_TRUE(map.round());
    const BleedGrid& grid = map.grid();
    ASSERT_EQ(grid.columns, 5);
    ASSERT_EQ(grid.rows, 4);
    for (int y = 0; y < grid.rows; ++y) {
        EXPECT_EQ(grid.cells[size_t(y * grid.columns)].object, left.value);
        EXPECT_EQ(grid.cells[size_t(y * grid.columns + 4)].object, right.value);
    }
    for (const BleedCell& cell : grid.cells) EXPECT_TRUE(cell.share >= 0 && cell.share < 0.7f) << cell.share;

    EXPECT_FALSE(map.round([] { return false; }));
    EXPECT_EQ(map.grid().passes, 1);
}

} // namespace
} // namespace blush::test::TEST_FILE
