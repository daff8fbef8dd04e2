#include "app/commands/render/command_feature_report.h"

#include "app/commands/denoising.h"
#include "app/common/assets_dir.h"
#include "color/color_management.h"
#include "io/codec/image_codec.h"

#include <chrono>

namespace blush {
namespace {

// Seconds; nullopt if `make` fails.
template <class Make> std::optional<double> seconds_to(const Make& make) {
    const auto begin = std::chrono::steady_clock::now();
    if (!make()) return std::nullopt;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

FeatureUse image_library_use() {
    const std::optional<double> seconds = image_codec_load_seconds();
    return {
        "files", "OpenImageIO", seconds.has_value(), seconds ? "an image file was read or written" : "no image file was read or written",
        {},      seconds};
}

FeatureReport with_command_features(const FeatureReport& renderer, const CommandFeatures& made) {
    FeatureReport feature_report = renderer;
    feature_report.push_back(made.image_library);
    feature_report.push_back(
        {"display", "view transform", made.display, made.display ? "the output is display-encoded" : "the output is scene-linear"});
    feature_report.back().seconds = made.display_seconds;
    std::array<bool, denoise_qualities> loaded{};
    if (made.denoiser) loaded[size_t(*made.denoiser)] = true;
    for (FeatureUse& use : denoiser_feature_report(weights_dir(), loaded)) feature_report.push_back(std::move(use));
    const auto fast = std::ranges::find(feature_report, "fast network", &FeatureUse::name);
    if (fast != feature_report.end()) fast->seconds = made.denoiser_seconds;
    return feature_report;
}

CommandFeatures measure_command_features(unsigned threads) {
    CommandFeatures made;
    if (!made.image_library.used) made.image_library.seconds = seconds_to([] { return bool(image_codec("")); });
    made.display_seconds = seconds_to([] {
        const Result<ColorManagement> color = ColorManagement::load(assets_dir());
        float grey[3] = {0.18f, 0.18f, 0.18f};
        return color && color->apply_display({}, {}, grey, 1);
    });
    made.denoiser_seconds = seconds_to([threads] {
        Denoiser denoiser(weights_dir(), threads);
        return bool(try_denoiser(denoiser, DenoiseQuality::fast));
    });
    return made;
}

} // namespace blush
