// What `blush converge` found, as CSV, JSON and one self-contained HTML file.
#pragma once

#include "app/commands/converge_run.h"
#include "app/commands/json_output.h"
#include "color/color_management.h"
#include "scene/view_settings.h"

#include <string>

namespace blush {

struct ConvergeReport {
    std::string scene, preset; // file name; preset is empty if there was none
    int width = 0, height = 0;
    ConvergeInput input;
    ConvergeResult result;
    Reference reference;
    std::string reference_source; // where it is from, in words
    std::string machine, build;
};

// "AMD Ryzen ..., 16 cores".
std::string machine_text();

// "bounce 4 -0.8 %, bounce 5 -0.6 %": where the bias certainly is, per cent of the whole image's light; empty if that is not known.
std::string bias_by_bounce_text(const VariantResult& variant);

// variant,seconds,spp,mse,relmse,flip,mean_r,mean_g,mean_b,repeat; flip is empty where it was not measured.
std::string converge_csv(const ConvergeReport& report);

// The keys of cli.md, and: points have a repeat; slope_low, slope_high and slope_spp, efficiency_low and _high; bias{z, verdict, percent,
// threshold, worst{x, y, width, height, percent, z}, bounces[{bounce, share_percent, percent, percent_error, significant}]}. What is not
// known is null.
OrderedJson converge_json(const ConvergeReport& report);

// Pictures go through the view transform. Errors: unknown view.
Result<std::string> converge_html(const ConvergeReport& report, const ColorManagement& color, const ViewSettings& view);

} // namespace blush
