// Results of a bleed probe in plain words, for the window and the command line.
#pragma once

#include "measure/metrics/bleed_probe.h"

#include <string>
#include <vector>

namespace blush {

// "11.2 ± 0.3 %", with as many decimals as the interval justifies; "..." without an interval.
std::string percent_text(const Interval& share);
// "342 ± 4 lx"
std::string light_text(const Interval& light, BleedTarget::Kind kind);

// "Mug (red) adds 11.2 ± 0.3 % of this light and moves its colour by 0.021 ± 0.001 towards red." `row`: of a sender.
std::string sentence_of(const BleedShare& row, BleedTarget::Kind kind);
// What direct and scattered light are worth, and how the colour of direct light alone differs from that of all.
std::string summary_of(const BleedReport& report, BleedTarget::Kind kind);
// What the probe does not show: one sentence each.
std::vector<std::string> limits_of(const BleedReport& report, const RenderSettings& settings);

} // namespace blush
