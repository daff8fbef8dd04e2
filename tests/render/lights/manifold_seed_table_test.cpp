// Seeds of manifold sampling: which lights and regions they cover, and in which proportions.
#include "render/lights/manifold_seed_table.h"

#include "shading/path_guiding.h"
#include "tests/support/random_numbers.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <span>
#include <vector>

namespace blush::test::TEST_FILE {
namespace {

constexpr int32_t two_refractions = 2 << chain_count_shift | 3;

LightRecord record_of(LightKind kind, int32_t part = -1) {
    LightRecord r{};
    r.kind = int32_t(kind);
    r.part = part;
    r.cone_height = kind == LightKind::sun ? 1e-5f : 0;
    r.radius = 0.1f;
    return r;
}
// 0: sun with a disk; 1 .. 3: triangles of one mesh; 4: parallel sun; 5: sphere; 6: environment; 7: triangle of a lamp of glass.
std::vector<LightRecord> some_lights() {
    std::vector<LightRecord> lights{record_of(LightKind::sun),         record_of(LightKind::triangle, 7), record_of(LightKind::triangle, 7),
                                    record_of(LightKind::triangle, 7), record_of(LightKind::sun),         record_of(LightKind::sphere),
                                    record_of(LightKind::environment), record_of(LightKind::triangle, 8)};
    lights[4].cone_height = 0;
    return lights;
}
std::optional<ManifoldSeedTable> made(std::span<const ChainPhoton> photons, const std::vector<LightRecord>& lights,
                                      const std::function<bool()>& wanted, unsigned threads = 1) {
    MaterialRecord materials[2]; // the second of a lamp of glass
    materials[1].flags = material_chains;
    std::vector<PartRecord> parts(9);
    parts[8].material = 1;
    SceneTables scene;
    scene.parts = parts.data();
    scene.materials.materials = materials;
    scene.lights.lights = lights.data();
    scene.lights.count = int32_t(lights.size());
    return ManifoldSeedTable::make(photons, scene, Workers(threads), wanted);
}
ManifoldSeedTable table_of(std::span<const ChainPhoton> photons, const std::vector<LightRecord>& lights) {
    return made(photons, lights, {}).value();
}
// On a floor of 4 x 4 m: dense on the left, a hundredth of it on the right. Three quarters of the flux are the sun's, the others that of
// the mesh's second triangle.
std::vector<ChainPhoton> some_photons() {
    RandomNumbers random(3);
    std::vector<ChainPhoton> photons;
    for (int i = 0; i < 40'000; ++i) {
        const Vec3 position{i % 100 == 0 ? random(0, 2) : random(-2, 0), 0, random(-2, 2)};
        const bool by_sun = i % 2 == 0;
        photons.push_back({position, {0, 1, 0}, position + Vec3{0.1f, 1, 0}, two_refractions, by_sun ? 0 : 2, by_sun ? 3.f : 1.f});
    }
    return photons;
}
const ManifoldRegion& region_at(const ManifoldTables& t, const Vec3& position, const Vec3& normal) {
    return t.regions[t.regions_of_cell[guiding_cell<float>(t.grid, position, normal)]];
}

TEST(ManifoldSeedTable, CoversTheLightsThatPhotonsComeFrom) {
    const auto lights = some_lights();
    const ManifoldSeedTable table = table_of(some_photons(), lights);
    const ManifoldTables t = table.tables({});
    ASSERT_FALSE(t.empty());
    const std::vector<int32_t> groups(t.group_of_light, t.group_of_light + t.lights);
    ASSERT_EQ(groups.size(), lights.size());
    const int32_t sun = groups[0], mesh = groups[1];
    EXPECT_EQ(groups, (std::vector<int32_t>{sun, mesh, mesh, mesh, -1, -1, -1, -1}));
    EXPECT_NE(sun, mesh);
    EXPECT_EQ(t.groups[mesh].first_light, 1);
    EXPECT_EQ(t.groups[mesh].lights, 3);
    EXPECT_EQ(t.groups[sun].lights, 1);
    // Systematic resampling: as many of the 256 seeds as the share of the flux, but for one.
    EXPECT_NEAR(double(t.groups[sun].share), 0.75, 1.01 / 256);
    EXPECT_FLOAT_EQ(t.groups[sun].share + t.groups[mesh].share, 1);
}

// An edit does not wait for a table that it makes useless.
TEST(ManifoldSeedTable, StopsWhenItIsNotWanted) {
    EXPECT_FALSE(made(some_photons(), some_lights(), [] { return false; }));
    EXPECT_TRUE(made(some_photons(), some_lights(), [] { return true; }));
}

TEST(ManifoldSeedTable, TakesPhotonsOfLightsWithoutSize) {
    const std::vector<ChainPhoton> photons(4, {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, two_refractions, 4, 1});
    EXPECT_FALSE(table_of(photons, some_lights()).empty());
}

TEST(ManifoldSeedTable, PhotonsWithoutValueOrAnEvenLightAreIgnored) {
    std::vector<ChainPhoton> photons(4, {{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, two_refractions, 6, 1});
    photons[1].light = 7;
    photons[2].light = -1;
    photons[3] = {{0, std::numeric_limits<float>::quiet_NaN(), 0}, {0, 1, 0}, {0, 1, 0}, two_refractions, 0, 1};
    EXPECT_TRUE(table_of(photons, some_lights()).empty());
    EXPECT_TRUE(table_of(photons, some_lights()).tables({}).empty());
    EXPECT_TRUE(table_of({}, some_lights()).empty());
}

// Suns may cover each other. Mirrors and glass are parts of chains, and paths that pass a pane straight keep all of its light.
TEST(ManifoldSeedTable, ChainsEndAtSunsAndAtTrianglesOfOtherMaterials) {
    std::vector<LightRecord> lights{record_of(LightKind::sun), record_of(LightKind::sun)};
    for (LightRecord& sun : lights) sun.position = {0, 1, 0};
    std::vector<PartRecord> parts(3);
    std::vector<MaterialRecord> materials(3);
    materials[1].flags = material_chains;
    materials[2].flags = material_pane;
    for (int32_t k = 0; k < 3; ++k) {
        parts[size_t(k)].material = k;
        lights.push_back(record_of(LightKind::triangle));
        lights.back().part = k;
    }
    const std::vector<int32_t> suns{0, 1};
    std::vector<ChainPhoton> photons;
    for (int32_t light = 0; light < 5; ++light)
        for (int k = 0; k < 100; ++k) photons.push_back({{float(k), 0, 0}, {0, 1, 0}, {float(k), 1, 0}, two_refractions, light, 1});
    SceneTables scene;
    scene.lights.lights = lights.data();
    scene.lights.count = 5;
    scene.lights.suns = suns.data();
    scene.lights.sun_count = 2;
    scene.parts = parts.data();
    scene.materials.materials = materials.data();
    const ManifoldSeedTable table = ManifoldSeedTable::make(photons, scene, Workers(1), {}).value();
    const ManifoldTables t = table.tables({});
    for (int light = 0; light < 5; ++light) EXPECT_EQ(t.group_of_light[light] >= 0, light < 3) << light;
}

TEST(ManifoldSeedTable, DoesNotDependOnTheNumberOfThreads) {
    const auto lights = some_lights();
    const ManifoldSeedTable one = made(some_photons(), lights, {}, 1).value(), four = made(some_photons(), lights, {}, 4).value();
    const ManifoldTables a = one.tables({}), b = four.tables({});
    ASSERT_EQ(a.grid, b.grid);
    int32_t regions = 0, seeds = 0;
    for (int32_t cell = 0; cell < a.grid.count() * guiding_sides; ++cell) {
        ASSERT_EQ(a.regions_of_cell[cell], b.regions_of_cell[cell]);
        regions = std::max(regions, a.regions_of_cell[cell] + 1);
    }
    EXPECT_GT(regions, 100);
    for (int32_t k = 0; k < regions; ++k) {
        ASSERT_EQ(a.regions[k].first, b.regions[k].first);
        ASSERT_EQ(a.regions[k].count, b.regions[k].count);
        seeds = std::max(seeds, a.regions[k].first + a.regions[k].count);
    }
    for (int32_t k = 0; k < seeds; ++k) {
        ASSERT_EQ(a.seeds[k].position, b.seeds[k].position);
        ASSERT_EQ(a.seeds[k].segment, b.seeds[k].segment);
    }
}

TEST(ManifoldSeedTable, SegmentsHoldTheSeedsOfTheirGroup) {
    const auto lights = some_lights();
    const ManifoldSeedTable table = table_of(some_photons(), lights);
    const ManifoldTables t = table.tables({});
    const ManifoldRegion &dense = region_at(t, {-1, 0, 0.3f}, {0, 1, 0}), &scene = t.regions[0];
    for (const ManifoldRegion* region : {&dense, &scene}) {
        int32_t seeds = 0;
        for (int32_t s = 0; s < region->segments; ++s) {
            const ManifoldSegment& segment = t.segments[region->first_segment + s];
            EXPECT_EQ(segment.first, region->first + seeds);
            seeds += segment.count;
            for (int32_t k = 0; k < segment.count; ++k) EXPECT_EQ(t.seeds[segment.first + k].segment, region->first_segment + s);
        }
        EXPECT_EQ(seeds, region->count);
        EXPECT_EQ(region->segments, 2);
    }
}

TEST(ManifoldSeedTable, SeedsAreNearTheirReceivers) {
    const auto lights = some_lights();
    const ManifoldSeedTable table = table_of(some_photons(), lights);
    const ManifoldTables t = table.tables({});
    // The widest distance of a seed from a receiver: a region is larger where there are fewer photons.
    const auto reach = [&](const Vec3& receiver) {
        const ManifoldRegion& region = region_at(t, receiver, {0, 1, 0});
        float far = 0;
        for (int32_t k = 0; k < region.count; ++k) far = std::max(far, length(t.seeds[region.first + k].position - receiver));
        return far;
    };
    EXPECT_LT(reach({-1, 0, 0.3f}), 1.25f * 8 * std::sqrt(2.f) / t.grid.cells_per_metre); // of the largest block with its margin
    EXPECT_GT(reach({1, 0, 0.3f}), reach({-1, 0, 0.3f}));
    // No photon arrives from below: the seeds of the scene.
    EXPECT_EQ(&region_at(t, {-1, 0, 0.3f}, {0, -1, 0}), &t.regions[0]);
}

} // namespace
} // namespace blush::test::TEST_FILE
