#include "app/commands/denoising.h"

#include "app/commands/progress.h"
#include "core/text.h"
#include "render/session/denoised_image.h"

#include <fmt/format.h>

namespace blush {

Result<DenoiseQuality> parse_denoise_quality(std::string_view text) {
    if (text == "fast") return DenoiseQuality::fast;
    if (text == "high") return DenoiseQuality::high;
    return Error{.what = fmt::format("must be fast or high, not \"{}\"", text)};
}

Result<void> try_denoiser(Denoiser& denoiser, DenoiseQuality quality) {
    const float grey[3] = {0.5f, 0.5f, 0.5f};
    DenoiseOptions options;
    options.quality = quality;
    const Result<std::optional<Denoised>> denoised = denoiser.denoise({1, 1, {grey}, {grey}, {grey}}, options);
    if (!denoised) return denoised.error();
    return {};
}

Result<std::vector<Denoised>> denoise_with_progress(Denoiser& denoiser, std::span<const DenoiseInput> inputs, DenoiseQuality quality,
                                                    bool quiet, const std::atomic<bool>& interrupted) {
    Progress progress(quiet);
    DenoiseOptions options;
    options.quality = quality;
    std::vector<Denoised> all;
    for (const DenoiseInput& input : inputs) {
        const std::string note = fmt::format("denoising {}x{}", input.width, input.height);
        const auto show = [&](double fraction) { progress.update((double(all.size()) + fraction) / double(inputs.size()), note); };
        show(0);
        Result<std::optional<Denoised>> denoised = denoiser.denoise(
            input, options, [&] { return !interrupted.load(); }, show);
        if (!denoised) return denoised.error();
        if (!*denoised) return Error{.what = "interrupted before it was denoised"};
        all.push_back(**std::move(denoised));
    }
    return all;
}

OrderedJson denoised_json(const Denoised& denoised) {
    OrderedJson json;
    json["network"] = denoised.network;
    json["precision"] = denoised.precision;
    json["tiles"] = denoised.tiles;
    json["seconds"] = denoised.seconds;
    json["bias_corrected"] = denoised.bias_corrected;
    json["energy_change_percent"] = energy_change_percent(denoised);
    json["sanitised"] = denoised.sanitised;
    return json;
}

std::string denoised_by(const Denoised& denoised) {
    return fmt::format("{}, {}{}", denoised.network, denoised.precision, denoised.bias_corrected ? ", bias corrected" : "");
}

std::string denoised_summary(const Denoised& denoised) {
    std::string text = fmt::format("denoised by {} in {:.2f} s, mean energy {} %", denoised_by(denoised), denoised.seconds,
                                   signed_number(energy_change_percent(denoised), 2));
    if (denoised.sanitised > 0) text += fmt::format(", {} pixels sanitised", denoised.sanitised);
    return text;
}

} // namespace blush
