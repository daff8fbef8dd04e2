// The contents of a film do not depend on batches, even if some samples are invalid.
#include "render/film/film.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <memory>

namespace blush::TEST_FILE {
namespace {

constexpr int width = 4, height = 3, samples = 6;
constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

// Red of a sample: some are invalid, including the first of pixel (0, 0).
float red_of(int x, int y, int64_t sample) {
    if (x == 0 && y == 0 && sample == 0) return nan;
    if (x == 1 && y == 2 && sample == 3) return inf;
    if (x == 3 && y == 1 && sample >= 4) return -1;
    return float(1 + x + 10 * y) * float(sample + 1) / 7;
}

// Fills `film` with all samples, in batches of these sizes.
void trace(Film& film, std::initializer_list<int> batches) {
    film.reset({width, height, {true, true, true, true}});
    const auto tile = std::make_unique<TileScratch>();
    tile->first = std::make_unique<FirstHitColumns>();
    int64_t next = 0;
    for (const int count : batches) {
        const TileJob job{0, 0, width, height, next, count};
        for (int slot = 0; slot < job.paths(); ++slot) {
            const int pixel = slot / count;
            const int64_t sample = next + slot % count;
            tile->r[slot] = red_of(pixel % width, pixel / width, sample);
            tile->g[slot] = tile->b[slot] = 1;
            tile->first->albedo_r[slot] = tile->first->albedo_g[slot] = tile->first->albedo_b[slot] = 0.5f;
            tile->first->normal_x[slot] = tile->first->normal_y[slot] = tile->first->normal_z[slot] = 0;
            tile->first->depth[slot] = float(sample);
            tile->first->object[slot] = int32_t(100 * pixel + sample);
            tile->first->material[slot] = 3;
        }
        film.add(job, *tile, 42);
        next += count;
    }
}

Frame resolved(const Film& film) {
    Frame frame;
    film.resolve(frame, Workers(1));
    return frame;
}

TEST(FilmBatches, FirstHitsAreOfTheFirstValidSample) {
    Film film;
    trace(film, {samples});
    const Frame frame = resolved(film);
    EXPECT_EQ(frame.object_id[0], 1u);
    EXPECT_EQ(frame.depth[0], 1);
    EXPECT_EQ(frame.object_id[1], 100u);
    EXPECT_EQ(frame.depth[1], 0);
}

TEST(FilmBatches, DoNotChangeItsSums) {
    Film whole, split;
    trace(whole, {samples});
    trace(split, {1, 2, 3});
    const Frame a = resolved(whole), b = resolved(split);
    EXPECT_EQ(a.rgba, b.rgba);
    EXPECT_EQ(a.object_id, b.object_id);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.health.first, b.health.first);
}

} // namespace
} // namespace blush::TEST_FILE
