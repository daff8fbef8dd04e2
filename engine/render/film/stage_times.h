// Profile of rendering by stage: where the time of the threads goes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace blush {

// Stages of a tile (wavefront.h). `generate`: camera rays; `trace`: closest hits; `light`: sampling a light for NEE; `shade`: the rest of
// scatter(); `shadow`: shadow rays; `reuse`: connections of path reuse; `film`: adding the samples to the film.
enum class Stage : int { generate, trace, light, shade, shadow, reuse, film };
constexpr std::array<std::string_view, 7> stage_names{"generate", "trace", "light", "shade", "shadow", "reuse", "film"};

// Of each stage, summed over threads: in ticks (core/ticks.h) or seconds.
template <class T> struct StageSums {
    std::array<T, stage_names.size()> of{};
    T& operator[](Stage s) { return of[size_t(s)]; }
    const T& operator[](Stage s) const { return of[size_t(s)]; }
};
using StageTicks = StageSums<int64_t>;
using StageSeconds = StageSums<double>;

inline void add_seconds(StageSeconds& seconds, const StageTicks& ticks, double seconds_per_tick) {
    for (size_t k = 0; k < seconds.of.size(); ++k) seconds.of[k] += double(ticks.of[k]) * seconds_per_tick;
}

} // namespace blush
