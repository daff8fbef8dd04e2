#include "render/diagnostics/health.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace blush {
namespace {

// Radiance beyond single precision, the format of frames.
constexpr double max_frame_radiance = double(std::numeric_limits<float>::max());

} // namespace

std::optional<BadSample::Cause> cause_to_drop(const Vec3d& c) {
    if (std::isnan(c.x) || std::isnan(c.y) || std::isnan(c.z)) return BadSample::Cause::nan;
    if (std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) > max_frame_radiance) return BadSample::Cause::infinite;
    if (c.x < 0 || c.y < 0 || c.z < 0) return BadSample::Cause::negative;
    return std::nullopt;
}

std::string_view to_string(Fault::Kind kind) {
    static constexpr std::string_view words[Fault::kinds] = {"nan", "inf", "negative", "zero pdf", "overflowing pdf"};
    return words[size_t(kind)];
}

std::string_view to_string(Fault::Place place) {
    static constexpr std::string_view words[Fault::places] = {"camera",   "geometry",     "environment", "absorption",
                                                              "emission", "light sample", "bsdf eval",   "bsdf sample",
                                                              "roulette", "sum",          "light path"};
    return words[size_t(place)];
}

std::string_view to_string(BadSample::Cause cause) {
    static constexpr std::string_view words[] = {"nan", "inf", "negative"};
    return words[size_t(cause)];
}

std::string describe(const BadSample& s) {
    return fmt::format("{} at {}, vertex {}: pixel {},{} sample {}", to_string(s.fault.kind), to_string(s.fault.place), s.fault.vertex, s.x,
                       s.y, s.sample);
}

} // namespace blush
