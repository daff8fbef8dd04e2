#include "ui/snapshots/aov_pixels.h"

#include "color/color_difference.h"
#include "core/math.h"
#include "core/srgb.h"
#include "scene/affine.h"
#include "ui/snapshots/heat_map.h"
#include "ui/snapshots/light_piles.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

using Show = ImageView::Show;

constexpr Vec3 nothing_hit{0.004f, 0.012f, 0.06f};
// Range of relative errors of the heat map, as powers of ten.
constexpr float min_error = 1e-3f, error_decades = 3;

struct AovRange {
    float low = 0, high = 1;
    float share(float x) const { return (x - low) / std::max(high - low, 1e-12f); }
};

// Range of the first-hit depths.
AovRange depth_range(const Frame& frame) {
    AovRange r{1e30f, 0};
    for (const float z : frame.depth)
        if (z > 0 && std::isfinite(z)) r = {std::min(r.low, z), std::max(r.high, z)};
    return r.low > r.high ? AovRange{} : r;
}

// Starts at 0, so that a constant number of samples has one colour.
AovRange sample_range(const Frame& frame) {
    float most = float(frame.samples);
    for (const float n : frame.pixel_samples) most = std::max(most, n);
    return {0, std::max(most, 1.f)};
}

float samples_of(const Frame& frame, size_t pixel) {
    return frame.pixel_samples.empty() ? float(frame.samples) : frame.pixel_samples[pixel];
}

Vec3 linear(const Vec3& display) { return {linear_from_srgb(display.x), linear_from_srgb(display.y), linear_from_srgb(display.z)}; }
Vec3 encoded(const Vec3& c) { return {srgb_from_linear(clamp01(c.x)), srgb_from_linear(clamp01(c.y)), srgb_from_linear(clamp01(c.z))}; }
Vec3 grey(float t) { return {t, t, t}; }

Vec3 normal_color(const Vec3& n) { return n == Vec3{0, 0, 0} ? n : linear((n + Vec3{1, 1, 1}) * 0.5f); }

float error_share(float relative) { return std::log10(std::max(relative, 1e-12f) / min_error) / error_decades; }

// Delta E at the upper end of the heat map, and the side of the blocks of pixels whose means are compared: of single pixels it is mostly
// that of their noise.
constexpr float most_bleed = 20;
constexpr int bleed_block = 4;

float indirect_share(const Frame& f, size_t i) {
    const TwoPiles piles = piles_of(f, i);
    const float whole = luminance(piles.direct + piles.indirect);
    return whole > 0 ? luminance(piles.indirect) / whole : 0;
}

// By pixel: the hue difference of its block.
std::vector<float> bleed_by_block(const Frame& f) {
    std::vector<float> found(f.rgba.size() / 4);
    for (int y = 0; y < f.height; y += bleed_block)
        for (int x = 0; x < f.width; x += bleed_block) {
            const int right = std::min(x + bleed_block, f.width), bottom = std::min(y + bleed_block, f.height);
            Vec3 direct{0, 0, 0}, indirect{0, 0, 0};
            const auto each = [&](const auto& visit) {
                for (int v = y; v < bottom; ++v)
                    for (int u = x; u < right; ++u) visit(size_t(v) * size_t(f.width) + size_t(u));
            };
            each([&](size_t i) {
                const TwoPiles piles = piles_of(f, i);
                direct = direct + piles.direct;
                indirect = indirect + piles.indirect;
            });
            const float difference = float(hue_difference(to_double(direct), to_double(direct + indirect)));
            each([&](size_t i) { found[i] = difference; });
        }
    return found;
}

struct Ranges {
    AovRange depth, samples;
    std::vector<float> bleed = {};
};

Vec3 color_of(const Frame& f, Show show, const Ranges& ranges, size_t i) {
    switch (show) {
    case Show::albedo: return f.albedo[i];
    case Show::normal: return normal_color(f.normal[i]);
    case Show::depth: return f.depth[i] > 0 ? linear(grey(clamp01(ranges.depth.share(f.depth[i])))) : nothing_hit;
    case Show::object_id: return id_color(f.object_id[i]);
    case Show::material_id: return id_color(f.material_id[i]);
    case Show::error: return heat_map_color(error_share(relative_error(f, i)));
    case Show::samples: return heat_map_color(ranges.samples.share(samples_of(f, i)));
    case Show::indirect_share: return heat_map_color(indirect_share(f, i));
    case Show::bleed: return heat_map_color(ranges.bleed[i] / most_bleed);
    default: return {0, 0, 0};
    }
}

} // namespace

// Hues at multiples of the golden ratio: consecutive ids get very different colours.
Vec3 id_color(uint32_t id) {
    if (id == 0) return {0, 0, 0};
    const float hue = float(std::fmod(double(id) * 0.61803398875, 1.0)), value = 0.55f + 0.4f * float(id % 3) / 2;
    const auto channel = [&](float shift) {
        const float k = std::fmod(shift + hue * 6, 6.f);
        return value - value * 0.65f * clamp01(std::min(k, 4 - k));
    };
    return linear({channel(5), channel(3), channel(1)});
}

float relative_error(const Frame& f, size_t i) {
    const float y = luminance(Vec3{f.rgba[4 * i], f.rgba[4 * i + 1], f.rgba[4 * i + 2]});
    return luminance(f.standard_error[i]) / std::sqrt(y * y + 0.01f);
}

Vec3 group_pixel(const Frame& frame, size_t group, size_t pixel) {
    const Vec3 light = frame.groups[group][pixel];
    return group < frame.gains.size() ? light * frame.gains[group] : light;
}

std::vector<float> aov_pixels(const Frame& frame, Show show) {
    Ranges ranges;
    if (show == Show::depth) ranges.depth = depth_range(frame);
    if (show == Show::bleed) ranges.bleed = bleed_by_block(frame);
    if (show == Show::samples) ranges.samples = sample_range(frame);
    std::vector<float> rgba(frame.rgba.size(), 0.f);
    for (size_t i = 0; i < rgba.size() / 4; ++i) {
        const Vec3 c = color_of(frame, show, ranges, i);
        rgba[4 * i] = c.x;
        rgba[4 * i + 1] = c.y;
        rgba[4 * i + 2] = c.z;
    }
    return rgba;
}

std::string aov_caption(const Frame& frame, Show show) {
    switch (show) {
    case Show::albedo: return "Albedo: the reflectance at first hits";
    case Show::normal: return "Normal: X red, Y green, Z blue; 0 is mid-grey";
    case Show::depth: return "Depth: metres along the ray; blue: no hit";
    case Show::object_id: return "Object ids: one colour per id";
    case Show::material_id: return "Material ids: one colour per id";
    case Show::error: return "Error: standard error of each pixel divided by its value";
    case Show::samples:
        return frame.pixel_samples.empty() ? fmt::format("Samples: {} in each pixel", frame.samples)
                                           : std::string("Samples: number per pixel");
    case Show::indirect_share: return "Indirect share of the luminance";
    case Show::bleed: return "Bleed: Delta E of direct and all light, by hue";
    default: return {};
    }
}

std::optional<MapScale> map_scale(const Frame& frame, Show show) {
    constexpr auto hot = [](float t) { return encoded(heat_map_color(t)); };
    if (show == Show::depth) {
        const AovRange r = depth_range(frame);
        const auto metres = [](float z) { return fmt::format("{:.3g} m", z); };
        return MapScale{"Depth", metres(r.low), metres((r.low + r.high) / 2), metres(r.high), grey};
    }
    if (show == Show::indirect_share) return MapScale{"Indirect", "0 %", "50 %", "100 %", hot};
    if (show == Show::bleed) return MapScale{"Delta E", "0", "10", "20", hot};
    if (show == Show::error) return MapScale{"Error", "0.1 %", "3.2 %", "100 %", hot};
    if (show == Show::samples) {
        const AovRange r = sample_range(frame);
        return MapScale{"Samples", "0", fmt::format("{:.0f}", r.high / 2), fmt::format("{:.0f}", r.high), hot};
    }
    return {};
}

} // namespace blush
