#include "io/image/display_image.h"

#include "color/exposure_meter.h"
#include "color/illuminance.h"
#include "color/white_balance.h"
#include "core/math.h"

#include <cmath>

namespace blush {
namespace {

constexpr float stops_from_grey = 6.5f; // half range of the scale in stops

FalseColorScale scale_of(const FalseColor& f) {
    switch (f.of) {
    case FalseColor::Of::off: return {};
    case FalseColor::Of::stops: {
        const float grey = std::log2(0.18f);
        return {FalseColorScale::Of::exposed, grey - stops_from_grey, grey + stops_from_grey};
    }
    case FalseColor::Of::nits:
    case FalseColor::Of::lux: return {FalseColorScale::Of::scene, std::log2(f.low), std::log2(f.high)};
    }
    return {};
}

// Steps 1, 2, 5, 10, 20, ...: the largest step <= x, and the next step after a step x.
float round_number_below(float x) {
    const float power = std::pow(10.f, std::floor(std::log10(x)));
    for (const float digit : {5.f, 2.f})
        if (digit * power <= x) return digit * power;
    return power;
}
float next_round_number(float x) {
    const float digit = std::round(x / std::pow(10.f, std::floor(std::log10(x * 1.01f))));
    return x * (digit == 2 ? 2.5f : 2);
}

} // namespace

DisplayTransform transform_of(const ViewSettings& view) { return {view.display, view.view, view.look}; }

DisplayParameters display_parameters_of(const ViewSettings& view) {
    return {view.exposure_ev, view.gamma, white_balance(view.white), scale_of(view.false_color), view.background_as_it_is};
}

float metered_exposure(AutoExposure rule, std::span<const float> values, int channels) {
    switch (rule) {
    case AutoExposure::off: return 0;
    case AutoExposure::average: return average_exposure(values, channels);
    case AutoExposure::highlights: return highlight_exposure(values, channels);
    }
    return 0;
}

ViewSettings settled(const ViewSettings& view, float metered_ev) {
    ViewSettings v = view;
    v.auto_exposure = AutoExposure::off;
    v.exposure_ev += metered_ev;
    return v;
}

float stops_from_grey(const DisplayParameters& numbers, const Vec3& scene) {
    return std::log2(luminance(transform_vector(numbers.white_balance, scene)) / 0.18f) + numbers.exposure_ev;
}

FalseColor fitted(const FalseColor& scale, std::span<const float> values, int channels) {
    const LuminanceRange range = luminance_range(values, channels);
    if (!(range.low > 0)) return scale;
    FalseColor f = scale;
    f.low = round_number_below(range.low);
    for (f.high = f.low; f.high <= range.high && std::isfinite(f.high);) f.high = next_round_number(f.high);
    return std::isfinite(f.high) ? f : scale;
}

Result<void> show(const ColorManagement& color, const ViewSettings& view, std::span<float> rgb, const DisplayPlanes& with) {
    const ViewSettings v = settled(view, metered_exposure(view.auto_exposure, rgb, 3));
    if (v.false_color.of == FalseColor::Of::lux) {
        if (with.albedo.size() != rgb.size() / 3) return Error{.what = "the image has no albedo, which false colour in lux needs"};
        to_illuminance(rgb, with.albedo);
    }
    const float* coverage = with.coverage.size() == rgb.size() / 3 ? with.coverage.data() : nullptr;
    return color.apply_display(transform_of(v), display_parameters_of(v), rgb.data(), rgb.size() / 3, coverage);
}

} // namespace blush
