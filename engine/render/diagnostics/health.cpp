#include "render/diagnostics/health.h"

#include <fmt/format.h>

namespace blush {

std::string_view to_string(Fault::Kind kind) {
    static constexpr std::string_view words[Fault::kinds] = {"nan", "inf", "negative", "zero pdf", "overflowing pdf"};
    return words[size_t(kind)];
}

std::string_view to_string(Fault::Place place) {
    static constexpr std::string_view words[Fault::places] = {"camera",       "geometry",  "environment", "absorption", "emission",
                                                              "light sample", "bsdf eval", "bsdf sample", "roulette",   "sum"};
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
