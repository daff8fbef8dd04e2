#include "render/session/halved_frame.h"

#include "core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace blush::TEST_FILE {
namespace {

// Sides are odd: the last row and column of the result cover one pixel less each way.
std::shared_ptr<Frame> five_by_three() {
    auto frame = std::make_shared<Frame>();
    frame->width = 5;
    frame->height = 3;
    frame->samples = 1;
    for (int i = 0; i < 15; ++i) {
        const float v = float(i);
        for (int c = 0; c < 4; ++c) frame->rgba.push_back(c == 3 ? 1 : v + 100 * float(c));
        frame->albedo.push_back({v, 0, 1});
        frame->normal.push_back({0, v, 0});
        frame->depth.push_back(1 + v);
        frame->half_difference.push_back({v - 7, 0, 0});
    }
    return frame;
}

TEST(HalvedFrame, PixelsAreMeans) {
    const auto frame = five_by_three();
    const auto half = halved(frame);
    ASSERT_EQ(half->width, 3);
    ASSERT_EQ(half->height, 2);
    EXPECT_EQ(half->divider, 2);
    EXPECT_EQ(half->samples, 1);
    // Of 0, 1, 5, 6; 2, 3, 7, 8; 4, 9; then of 10, 11; 12, 13; 14.
    const float means[] = {3, 5, 6.5f, 10.5f, 12.5f, 14};
    ASSERT_EQ(half->rgba.size(), 4 * std::size(means));
    ASSERT_EQ(half->albedo.size(), std::size(means));
    for (size_t i = 0; i < std::size(means); ++i) {
        for (size_t c = 0; c < 3; ++c) EXPECT_EQ(half->rgba[4 * i + c], means[i] + 100 * float(c)) << i;
        EXPECT_EQ(half->rgba[4 * i + 3], 1);
        EXPECT_EQ(half->albedo[i], (Vec3{means[i], 0, 1})) << i;
        EXPECT_EQ(half->normal[i], (Vec3{0, means[i], 0})) << i;
        EXPECT_EQ(half->depth[i], 1 + means[i]) << i;
        EXPECT_EQ(half->half_difference[i], (Vec3{means[i] - 7, 0, 0})) << "the half difference of a mean is the mean of half differences";
    }
}

TEST(HalvedFrame, APixelHitsWhatMostOfItsPixelsHit) {
    const auto frame = five_by_three();
    frame->depth = {2, 0, 0, 0, 0, //
                    4, 0, 0, 8, 6, //
                    0, 0, 5, 0, 0};
    const auto half = halved(frame);
    EXPECT_EQ(half->depth, (std::vector<float>{3, 0, 6, 0, 5, 0})) << "half of them suffice";
}

TEST(HalvedFrame, WhatIsUnknownStaysUnknown) {
    const auto frame = five_by_three();
    frame->half_difference[0].x = std::numeric_limits<float>::quiet_NaN();
    const auto half = halved(frame);
    EXPECT_TRUE(std::isnan(half->half_difference[0].x));
    EXPECT_FALSE(std::isnan(half->half_difference[1].x));
    frame->half_difference.clear();
    EXPECT_TRUE(halved(frame)->half_difference.empty());
}

TEST(HalvedFrame, FirstHitsAreThoseOfTheFrame) {
    const auto frame = five_by_three();
    const auto half = halved(frame);
    ASSERT_TRUE(half->first_hits);
    EXPECT_EQ(half->first_hits->width, 5);
    EXPECT_EQ(half->first_hits->height, 3);
    EXPECT_EQ(half->first_hits->albedo.data(), frame->albedo.data());
    EXPECT_EQ(half->first_hits->depth.data(), frame->depth.data());
    frame->depth.clear();
    EXPECT_FALSE(halved(frame)->first_hits) << "a plane is missing";
}

TEST(HalvedFrame, GroupsAreHalvedEachAndThreadsDoNotMatter) {
    const auto frame = five_by_three();
    frame->groups = {frame->albedo, frame->normal};
    frame->group_half_differences = {frame->half_difference, frame->normal};
    frame->gains = {{1, 1, 1}, {2, 2, 2}};
    const Workers workers(2, false);
    const auto half = halved(frame), parallel = halved(frame, &workers);
    ASSERT_EQ(half->groups.size(), 2u);
    EXPECT_EQ(half->groups[0], half->albedo);
    EXPECT_EQ(half->groups[1], half->normal);
    EXPECT_EQ(half->group_half_differences[0], half->half_difference);
    EXPECT_EQ(half->gains, frame->gains);
    EXPECT_EQ(half->rgba, parallel->rgba);
    EXPECT_EQ(half->depth, parallel->depth);
    EXPECT_EQ(half->groups, parallel->groups);
}

} // namespace
} // namespace blush::TEST_FILE
