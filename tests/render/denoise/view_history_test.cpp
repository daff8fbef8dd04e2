// Images of a wall, with a box in front of it, from two views: their pixels are known in closed form.
#include "render/denoise/view_history.h"

#include "core/math.h"
#include "core/parallel.h"
#include "scene/affine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace blush::TEST_FILE {
namespace {

constexpr int width = 160, height = 90;

struct Hit {
    Vec3 at, albedo, radiance; // `at` relative to the scene's middle
};
// What a ray from `origin` sees; empty: nothing.
using World = std::function<std::optional<Hit>(const Vec3& origin, const Vec3& direction)>;

// Planes of an image, and its pixels.
struct Seen {
    std::vector<Vec3> albedo, normal;
    std::vector<float> depth, rgb;
    FirstHitPlanes planes;
    // Of one colour, in place of the pixels.
    std::vector<float> flat(float value) const { return std::vector<float>(rgb.size(), value); }
};

constexpr Vec3d middle{1e6, -2e6, 3e5}; // positions are only known to a tenth of a metre in float

WorldCamera camera_at(double x, bool orthographic = false) {
    return {middle + Vec3d{x, 0, 4}, {orthographic ? 3.2f : 0.8f, 0, 0}, {0, orthographic ? 1.8f : 0.45f, 0}, {0, 0, -1}, orthographic};
}

std::unique_ptr<Seen> seen_by(const WorldCamera& camera, const World& world, int w = width, int h = height) {
    auto seen = std::make_unique<Seen>();
    const Vec3 eye = to_float(camera.position - middle);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const float sx = 2 * (float(x) + 0.5f) / float(w) - 1, sy = 1 - 2 * (float(y) + 0.5f) / float(h);
            const Vec3 lateral = camera.right * sx + camera.up * sy;
            const Vec3 origin = camera.orthographic ? eye + lateral : eye;
            const Vec3 direction = camera.orthographic ? camera.forward : normalize(camera.forward + lateral);
            const std::optional<Hit> hit = world(origin, direction);
            seen->albedo.push_back(hit ? hit->albedo : Vec3{1, 1, 1});
            seen->normal.push_back(hit ? Vec3{0, 0, 1} : Vec3{0, 0, 0});
            seen->depth.push_back(hit ? length(hit->at - origin) : 0);
            const Vec3 c = hit ? hit->radiance : Vec3{0.25f, 0.5f, 0.75f};
            seen->rgb.insert(seen->rgb.end(), {c.x, c.y, c.z});
        }
    seen->planes = {w, h, seen->albedo, seen->normal, seen->depth, {}, camera};
    return seen;
}

Vec3 at_z(const Vec3& origin, const Vec3& direction, float z) { return origin + direction * ((z - origin.z) / direction.z); }

// At z = 0, smoothly lit, with stripes of albedo.
std::optional<Hit> wall(const Vec3& origin, const Vec3& direction) {
    const Vec3 p = at_z(origin, direction, 0);
    const float light = 1 + 0.5f * std::sin(3 * p.x) * std::cos(2 * p.y), albedo = std::fmod(p.x + 100, 0.5f) < 0.25f ? 0.2f : 0.8f;
    return Hit{p, {albedo, albedo, albedo}, Vec3{1, 0.5f, 2} * (light * albedo)};
}

// A red square of a width of 1 at z = 1, before a wall.
std::optional<Hit> square_and_wall(const Vec3& origin, const Vec3& direction) {
    const Vec3 p = at_z(origin, direction, 1);
    if (std::abs(p.x) < 0.5f && std::abs(p.y) < 0.5f) return Hit{p, {0.5f, 0.5f, 0.5f}, {1, 0, 0}};
    const Vec3 q = at_z(origin, direction, 0);
    return Hit{q, {0.5f, 0.5f, 0.5f}, {0, 1, 0}};
}

ViewHistory history_of(const Seen& seen) { return ViewHistory(seen.planes, seen.rgb); }

// The mean of each square of pixels, as films have it; the size must be a multiple.
std::vector<float> averaged(const Seen& seen, int side) {
    const int w = seen.planes.width / side, h = seen.planes.height / side;
    std::vector<float> means(size_t(3 * w * h));
    for (int y = 0; y < h * side; ++y)
        for (int x = 0; x < w * side; ++x)
            for (int k = 0; k < 3; ++k)
                means[size_t(3 * (y / side * w + x / side) + k)] +=
                    seen.rgb[size_t(3 * (y * seen.planes.width + x) + k)] / float(side * side);
    return means;
}

// Mean and largest difference from the true pixels, relative to the mean.
struct Difference {
    double mean = 0, share_of_large = 0; // large: more than a tenth
};
Difference difference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0, norm = 0, large = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum += std::abs(double(a[i]) - double(b[i]));
        norm += double(b[i]);
        large += std::abs(a[i] - b[i]) > 0.1f * b[i];
    }
    return {sum / norm, large / double(a.size())};
}

class Cameras : public testing::TestWithParam<std::pair<bool, bool>> {};

// The new image has the right mean, but nothing of what is in it.
TEST_P(Cameras, HistoryIsSeenWhereItsSurfacesAre) {
    const auto [before, after] = GetParam();
    const auto old = seen_by(camera_at(0, before), wall), now = seen_by(camera_at(0.2, after), wall);
    std::vector<float> blurred = now->rgb;
    for (size_t i = 0; i < blurred.size(); ++i) blurred[i] *= i % 2 ? 1.1f : 0.9f;
    const WithHistory mixed = with_history(blurred, true, now->planes, history_of(*old));
    ASSERT_EQ(mixed.width, width);
    ASSERT_EQ(mixed.height, height);
    EXPECT_GT(mixed.share, 0.8f);
    EXPECT_GT(difference(blurred, now->rgb).mean, 0.09);
    // What the view before did not show remains blurred.
    const Difference d = difference(mixed.rgb, now->rgb);
    EXPECT_LT(d.mean, 0.03);
    EXPECT_LT(d.share_of_large, 0.05) << "edges of albedo are sharp";
}

TEST_P(Cameras, CoarseImagesFindTheirPlaceInTheHistory) {
    const auto [before, after] = GetParam();
    constexpr int divider = 10;
    const auto old = seen_by(camera_at(0, before), wall), now = seen_by(camera_at(0.2, after), wall);
    const auto coarse = seen_by(camera_at(0.2, after), wall, width / divider, height / divider);
    const std::vector<float> means = averaged(*now, divider), truth = averaged(*now, 2);
    const WithHistory none = with_history(means, true, coarse->planes, history_of(*seen_by(camera_at(100), wall)));
    const WithHistory mixed = with_history(means, true, coarse->planes, history_of(*old));
    ASSERT_EQ(mixed.width, width / 2);
    ASSERT_EQ(mixed.height, height / 2);
    EXPECT_EQ(none.share, 0);
    EXPECT_GT(mixed.share, 0.8f);
    EXPECT_LT(difference(mixed.rgb, truth).mean, 0.25 * difference(none.rgb, truth).mean);
}

INSTANTIATE_TEST_SUITE_P(ViewHistory, Cameras,
                         testing::Values(std::pair{false, false}, std::pair{true, true}, std::pair{false, true}, std::pair{true, false}));

TEST(ViewHistory, SurfacesThatWereHiddenShowTheImageAlone) {
    for (const int divider : {1, 6}) {
        const auto old = seen_by(camera_at(0), square_and_wall);
        const auto now = seen_by(camera_at(0.5), square_and_wall, width / divider, height / divider);
        const WithHistory mixed = with_history(now->rgb, true, now->planes, history_of(*old));
        const auto truth = seen_by(camera_at(0.5), square_and_wall, mixed.width, mixed.height);
        EXPECT_GT(mixed.share, 0.5f);
        // Red beside the square, or green in it: only at its edges, and in coarse images as far as those are coarse.
        size_t wrong = 0;
        for (size_t i = 0; i < truth->depth.size(); ++i) wrong += std::abs(mixed.rgb[3 * i] - truth->rgb[3 * i]) > 0.1f;
        EXPECT_LT(double(wrong) / double(truth->depth.size()), divider == 1 ? 0.001 : 0.03) << divider;
    }
}

TEST(ViewHistory, IsNotUsedWhereTheImageIsAnother) {
    const auto old = seen_by(camera_at(0), wall), now = seen_by(camera_at(0.1), wall);
    std::vector<float> brighter = now->rgb;
    for (float& v : brighter) v *= 4;
    const WithHistory mixed = with_history(brighter, true, now->planes, history_of(*old));
    EXPECT_EQ(mixed.share, 0);
    EXPECT_EQ(mixed.rgb, brighter);
    // The mean of an image of full size says more.
    std::vector<float> brighter_by_a_third = now->rgb;
    for (float& v : brighter_by_a_third) v *= 1.33f;
    EXPECT_GT(with_history(brighter_by_a_third, true, now->planes, history_of(*old)).share, 0.8f);
    EXPECT_LT(with_history(brighter_by_a_third, false, now->planes, history_of(*old)).share, 0.05f);
}

// Beside a lamp whose albedo is black, radiance over albedo would be a firefly.
TEST(ViewHistory, LampsLeaveNoFireflies) {
    const World lamp = [](const Vec3& origin, const Vec3& direction) {
        const Vec3 p = at_z(origin, direction, 0);
        const bool lit = std::abs(p.x) < 0.5f && std::abs(p.y) < 0.5f;
        return std::optional(Hit{p, lit ? Vec3{0, 0, 0} : Vec3{1, 1, 1}, lit ? Vec3{50, 50, 50} : Vec3{1, 1, 1}});
    };
    const auto old = seen_by(camera_at(0), lamp), now = seen_by(camera_at(0.013), lamp);
    const WithHistory mixed = with_history(now->rgb, true, now->planes, history_of(*old));
    EXPECT_GT(mixed.share, 0.8f);
    EXPECT_LE(*std::max_element(mixed.rgb.begin(), mixed.rgb.end()), 50.001f);
    EXPECT_LT(difference(mixed.rgb, now->rgb).share_of_large, 0.001);
}

TEST(ViewHistory, DirectionsWithoutSurfacesKeepTheirBackground) {
    const World nothing = [](const Vec3&, const Vec3&) { return std::optional<Hit>(); };
    const auto old = seen_by(camera_at(0), nothing);
    for (const int divider : {1, 4}) {
        const auto now = seen_by(camera_at(3), nothing, width / divider, height / divider);
        const WithHistory mixed = with_history(now->flat(0.5f), true, now->planes, history_of(*old));
        EXPECT_NEAR(mixed.share, 1, 1e-3) << "they do not depend on the position";
        EXPECT_NEAR(mixed.rgb[2], 0.75f, 1e-5f);
        // An orthographic camera sees one direction in all pixels.
        const auto flat = seen_by(camera_at(3, true), nothing, width / divider, height / divider);
        EXPECT_EQ(with_history(flat->rgb, true, flat->planes, history_of(*old)).share, 0);
    }
}

TEST(ViewHistory, DoesNotDependOnThreads) {
    for (const int divider : {1, 5}) {
        const auto old = seen_by(camera_at(0), square_and_wall, width + 3, height + 1);
        const auto now = seen_by(camera_at(0.3), square_and_wall, (width + 3) / divider, (height + 1) / divider);
        const WithHistory alone = with_history(now->rgb, true, now->planes, history_of(*old));
        const Workers workers(3);
        const WithHistory many = with_history(now->rgb, true, now->planes, history_of(*old), &workers);
        EXPECT_EQ(alone.rgb, many.rgb);
        EXPECT_EQ(alone.share, many.share);
    }
}

} // namespace
} // namespace blush::TEST_FILE
