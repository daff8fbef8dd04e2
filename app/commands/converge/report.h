// Results of `blush converge` as CSV, JSON and one self-contained HTML file.
#pragma once

#include "app/commands/converge/run.h"
#include "app/commands/json_output.h"
#include "color/color_management.h"
#include "scene/view_settings.h"

#include <string>

namespace blush {

struct ConvergeReport {
    std::string scene, preset; // file name; preset name, empty if none
    int width = 0, height = 0;
    ConvergeInput input;
    ConvergeResult result;
    Reference reference;
    std::string reference_source; // rendered, cached or loaded, as text
    std::string machine, build;
};

// "AMD Ryzen ..., 16 cores".
std::string machine_text();

// "bounce 4 -0.8 %, bounce 5 -0.6 %": the bounces with significant bias, in per cent of the whole image's light; empty if
// unknown.
std::string bias_by_bounce_text(const VariantResult& variant);

// variant,seconds,spp,mse,relmse,flip,mean_r,mean_g,mean_b,repeat; flip is empty if it was not measured.
std::string converge_csv(const ConvergeReport& report);

// The keys of docs/reference/json.md, and: points have a repeat; slope_low, slope_high and slope_spp, efficiency_low and _high;
// bias{z, verdict, percent, threshold, worst{x, y, width, height, percent, z}, bounces[{bounce, share_percent, percent,
// percent_error, significant}]}. Unknown values are null.
OrderedJson converge_json(const ConvergeReport& report);

// Images are converted by the view transform. Errors: unknown view.
Result<std::string> converge_html(const ConvergeReport& report, const ColorManagement& color, const ViewSettings& view);

} // namespace blush
