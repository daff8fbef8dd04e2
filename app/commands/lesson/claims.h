// Measures the claims of a lesson with the renderer.
#pragma once

#include "app/commands/lesson/lesson_file.h"
#include "measure/statistics/intervals.h"
#include "scene/document/edit.h"

#include <functional>

namespace blush {

enum class ClaimVerdict {
    holds,     // the 95 % interval lies within that of the claim
    fails,     // it lies outside
    undecided, // it overlaps an end after all that was measured, or nothing was measured
};

struct MeasuredClaim {
    ClaimVerdict verdict = ClaimVerdict::undecided;
    Interval value;   // 95 %
    int64_t work = 0; // paths, or pairs of images
    std::string note; // why nothing was measured; empty: it was
};

// Measures until the claim is decided. Shares and luminance by the bleed probe, up to 2^21 paths. Noise and mean from pairs of images of
// independent seeds, 8 to 64 of them: a noise is the root of the mean of (a - b)^2 / 2 over pairs of images and all channels, a mean is
// that of luminance. The interval of a ratio r of means over pairs is that of the mean of (y - r x) / mean(x) (delta method; Cochran 1977,
// 2.11). `state`: of the step. Undecided if `wanted` returns false.
MeasuredClaim measure_claim(const LessonStep& step, const Project& state, const LessonClaim& claim, unsigned threads,
                            const std::function<bool()>& wanted);

// "share of mug body at 56,30,8,8: 0.381 (0.37 .. 0.392), claimed 0.3 .. 0.45"
std::string claim_text(const LessonClaim& claim, const MeasuredClaim& measured);

} // namespace blush
