#include "ui/snapshots/image_pixels.h"

#include "color/illuminance.h"
#include "core/math.h"
#include "render/film/coverage.h"
#include "ui/snapshots/aov_pixels.h"
#include "ui/snapshots/aov_view.h"
#include "ui/snapshots/heat_map.h"
#include "ui/snapshots/light_piles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

using Show = ImageView::Show;

struct Range {
    float low = 0, high = 1;
};

Range range_of(const std::vector<float>& values) {
    if (values.empty()) return {};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*low, std::max(*high, *low + 1e-6f)};
}

Range range_of(const Frame& frame, Show show) {
    switch (show) {
    case Show::path_length: return {1, std::max(2.f, range_of(frame.path_length).high)};
    case Show::dropped: {
        uint32_t most = 1;
        for (const uint32_t count : frame.health.dropped_map) most = std::max(most, count);
        return {0, float(most)};
    }
    default: return {0, 1};
    }
}

float value_at(const Frame& frame, Show show, size_t pixel) {
    switch (show) {
    case Show::path_length: return frame.path_length[pixel];
    case Show::survival: return frame.survival[pixel];
    case Show::dropped: return frame.health.dropped_map.empty() ? 0 : float(frame.health.dropped_map[pixel]);
    default: return 0;
    }
}

Vec3 mixed(const Frame& frame, const std::vector<float>& gains, size_t pixel) {
    Vec3 sum{0, 0, 0};
    for (size_t k = 0; k < frame.bounces.size() && k < gains.size(); ++k) sum = sum + frame.bounces[k][pixel] * gains[k];
    return sum;
}

std::string bounces_caption(const std::vector<float>& gains) {
    std::string kept;
    bool plain = true;
    for (size_t k = 0; k < gains.size(); ++k) {
        plain = plain && (gains[k] == 0 || gains[k] == 1);
        if (gains[k] != 0) kept += fmt::format("{}{}{}", kept.empty() ? "" : ", ", k, k + 1 == gains.size() ? "+" : "");
    }
    if (!plain) return "Bounces with gains: not the physical image";
    if (kept.empty()) return "No bounces selected";
    return fmt::format("Bounce{} {} only: not the whole image", kept.find(',') == kept.npos ? "" : "s", kept);
}

std::vector<float> illuminance_of(const Frame& frame) {
    const size_t pixels = frame.rgba.size() / 4;
    std::vector<float> rgb(pixels * 3), rgba(frame.rgba.size(), 1.f);
    for (size_t i = 0; i < pixels; ++i) std::copy_n(&frame.rgba[4 * i], 3, &rgb[3 * i]);
    to_illuminance(rgb, frame.albedo);
    for (size_t i = 0; i < pixels; ++i) std::copy_n(&rgb[3 * i], 3, &rgba[4 * i]);
    return rgba;
}

std::vector<float> two_piles_of(const Frame& frame, const std::array<float, 2>& wipes) {
    std::vector<float> rgba(frame.rgba.size(), 1.f);
    const int ends[] = {int(std::lround(wipes[0] * float(frame.width))), int(std::lround(wipes[1] * float(frame.width)))};
    for (size_t i = 0; i < rgba.size() / 4; ++i) {
        const int x = int(i % size_t(frame.width));
        const TwoPiles piles = piles_of(frame, i);
        const Vec3 c = x < ends[0] ? piles.direct : x < ends[1] ? piles.indirect : piles.direct + piles.indirect;
        rgba[4 * i] = c.x;
        rgba[4 * i + 1] = c.y;
        rgba[4 * i + 2] = c.z;
    }
    return rgba;
}

} // namespace

bool is_special(const Frame& frame, const ImageView& view) {
    switch (view.show) {
    case Show::beauty: return false;
    case Show::bounces: return !frame.bounces.empty() && !std::ranges::all_of(view.gains, [](float g) { return g == 1; });
    case Show::dropped: return true;
    case Show::path_length: return !frame.path_length.empty();
    case Show::survival: return !frame.survival.empty();
    case Show::illuminance:
    case Show::albedo: return !frame.albedo.empty();
    case Show::normal: return !frame.normal.empty();
    case Show::depth: return !frame.depth.empty();
    case Show::object_id: return !frame.object_id.empty();
    case Show::material_id: return !frame.material_id.empty();
    case Show::error: return !frame.standard_error.empty();
    case Show::samples: return frame.samples > 0;
    case Show::strategy: return view.strategy >= 0 && size_t(view.strategy) < frame.strategies.size();
    case Show::group: return view.group >= 0 && size_t(view.group) < frame.groups.size();
    case Show::indirect_share:
    case Show::bleed:
    case Show::two_piles: return !frame.bounces.empty();
    }
    return false;
}

std::vector<float> pixels_of(const Frame& frame, const ImageView& view) {
    if (view.show == Show::illuminance) return illuminance_of(frame);
    if (is_data(view)) return aov_pixels(frame, view.show);
    if (view.show == Show::two_piles) return two_piles_of(frame, view.wipes);
    std::vector<float> rgba(frame.rgba.size(), 1.f);
    const Range range = range_of(frame, view.show);
    for (size_t i = 0; i < rgba.size() / 4; ++i) {
        const Vec3 c = view.show == Show::bounces    ? mixed(frame, view.gains, i)
                       : view.show == Show::strategy ? frame.strategies[size_t(view.strategy)][i]
                       : view.show == Show::group    ? group_pixel(frame, size_t(view.group), i)
                                                  : heat_map_color((value_at(frame, view.show, i) - range.low) / (range.high - range.low));
        rgba[4 * i] = c.x;
        rgba[4 * i + 1] = c.y;
        rgba[4 * i + 2] = c.z;
    }
    return rgba;
}

std::vector<float> with_coverage(const Frame& frame, std::vector<float> rgba) {
    for (size_t i = 0; i < rgba.size() / 4; ++i) rgba[4 * i + 3] = coverage_of_pixel(frame, i);
    return rgba;
}

bool is_mixed(std::span<const Vec3> gains) {
    return !std::ranges::all_of(gains, [](const Vec3& g) { return g == Vec3{1, 1, 1}; });
}

std::string caption_of(const Frame& frame, const ImageView& view) {
    const Range range = range_of(frame, view.show);
    switch (view.show) {
    case Show::bounces: return bounces_caption(view.gains) + (is_mixed(frame.gains) ? ", without the light mix" : "");
    case Show::dropped:
        if (frame.health.dropped_map.empty()) return "Dropped samples: none";
        return fmt::format("Dropped samples: black 0, white {:.0f} per pixel", range.high);
    case Show::path_length: return fmt::format("Path length: black {:.0f}, white {:.1f} vertices on average", range.low, range.high);
    case Show::survival: return "Survival: mean survival probability, black 0, white 1";
    case Show::strategy:
        return fmt::format("{} only: not the whole image{}", strategy_name(FoundBy(view.strategy)),
                           is_mixed(frame.gains) ? ", without the light mix" : "");
    case Show::group: return fmt::format("Light group {} only: not the whole image", frame.group_names[size_t(view.group)]);
    case Show::two_piles:
        return std::string("Direct light, indirect light, and their sum") + (is_mixed(frame.gains) ? ", without the light mix" : "");
    default: return is_data(view) ? aov_caption(frame, view.show) : std::string();
    }
}

} // namespace blush
