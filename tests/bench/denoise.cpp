// The denoiser: time for an image of the window's size, compared with its convolutions alone, and the reduction of the error.
#include "tests/bench/bare_convolutions.h"
#include "tests/bench/bench.h"

#include "measure/metrics/metrics.h"
#include "render/denoise/convolution.h"
#include "render/denoise/denoiser.h"
#include "render/denoise/unet_weights.h"
#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace blush::bench {
namespace {

using denoise::Element;

struct Case {
    const char* network;
    DenoiseQuality quality;
    Element element;
    const char* precision() const { return element == Element::float32 ? "float32" : "bfloat16"; }
};
constexpr Case speed_cases[]{
    {"rt_hdr_alb_nrm", DenoiseQuality::base, Element::float32},
    {"rt_hdr_alb_nrm", DenoiseQuality::base, Element::bfloat16},
    {"rt_hdr_alb_nrm_small", DenoiseQuality::fast, Element::float32},
    {"rt_hdr_alb_nrm_small", DenoiseQuality::fast, Element::bfloat16},
};

DenoiseInput input_of(const Frame& frame) {
    const auto floats = [](const std::vector<Vec3>& v) { return std::span(&v[0].x, v.size() * 3); };
    return {frame.width, frame.height, {frame.rgba, 4}, {floats(frame.albedo), 3}, {floats(frame.normal), 3}};
}

Frame rendered(const BenchScene& scene, const RenderSettings& settings, unsigned threads) {
    Renderer renderer({.threads = threads, .planes = {.albedo = true, .normal = true}});
    renderer.update(scene.scene, settings);
    renderer.render(0, settings.spp);
    return renderer.resolve();
}

// The full denoiser and bare convolutions alternate, so that other load affects both. CPU seconds of the bare ones are those of
// one thread: oneDNN's own threads spin while they wait.
Result<Json> measure_speed(const Case& c, const Frame& frame, const Options& options) {
    const auto weights = denoise::read_unet_weights(weights_folder() / (std::string(c.network) + ".tza"), 9);
    if (!weights) return weights.error();
    const BareConvolutions bare(weights->channels(), frame.width, frame.height, c.element, options.threads),
        bare_one(weights->channels(), frame.width, frame.height, c.element, 1);
    Denoiser denoiser(weights_folder(), options.threads);
    const DenoiseOptions how{.quality = c.quality,
                             .precision = c.element == Element::float32 ? DenoisePrecision::float32 : DenoisePrecision::bfloat16};
    const double peak = peak_rate(c.element);

    Result<std::optional<Denoised>> made = std::optional<Denoised>();
    std::vector<double> whole_seconds, whole_core_seconds, bare_seconds, ratios;
    const auto denoise_once = [&] { made = denoiser.denoise(input_of(frame), how); };
    const double first_seconds = cost_of(denoise_once).wall_seconds;
    if (!made) return made.error();
    for (int round = 0; round < options.rounds; round++) {
        const double before = cost_of([&] { bare_one.run(); }).core_seconds;
        const Cost whole = cost_of(denoise_once);
        const double after = cost_of([&] { bare_one.run(); }).core_seconds;
        ratios.push_back(2 * whole.core_seconds / (before + after));
        whole_seconds.push_back(whole.wall_seconds);
        whole_core_seconds.push_back(whole.core_seconds);
        bare_seconds.push_back(cost_of([&] { bare.run(); }).wall_seconds);
    }
    const double fastest = *std::ranges::min_element(whole_seconds), megapixels = frame.width * frame.height * 1e-6;
    const double rate = bare.operations() / median(whole_core_seconds);
    return Json{{"network", c.network},
                {"precision", c.precision()},
                {"milliseconds", rounded(1e3 * fastest)},
                {"milliseconds_per_megapixel", rounded(1e3 * fastest / megapixels)},
                {"first_milliseconds", rounded(1e3 * first_seconds)},
                {"bare_convolutions_milliseconds", rounded(1e3 * *std::ranges::min_element(bare_seconds))},
                {"core_seconds_over_bare_convolutions", rounded(median(ratios))},
                {"gigaflops_per_core", rounded(rate * 1e-9)},
                {"matmul_gigaflops_per_core", rounded(peak * 1e-9)},
                {"share_of_matmul_peak", rounded(rate / peak)}};
}

RgbImage image(int width, int height, std::span<const float> values, int stride) {
    RgbImage made{width, height, {}};
    for (size_t i = 0; i < values.size(); i += stride) made.pixels.push_back({values[i], values[i + 1], values[i + 2]});
    return made;
}

// relMSE of raw and denoised images against many samples of another seed.
Result<Json> measure_error(const BenchScene& scene, const Options& options) {
    RenderSettings settings = rate_settings();
    settings.width = settings.height = 256;
    settings.spp = options.reference_samples;
    settings.seed = 1000;
    const Frame truth = rendered(scene, settings, options.threads);
    const RgbImage reference = image(truth.width, truth.height, truth.rgba, 4);
    settings.spp = 4;
    settings.seed = 1;
    const Frame raw = rendered(scene, settings, options.threads);
    const auto relmse = [&](std::span<const float> values, int stride) {
        return compare(image(raw.width, raw.height, values, stride), reference, Encoding::scene_linear)->relmse;
    };

    const double raw_relmse = relmse(raw.rgba, 4);
    Json result{{"scene", scene.name()}, {"samples", settings.spp}, {"raw_relmse", rounded(raw_relmse)}};
    Denoiser denoiser(weights_folder(), options.threads);
    for (const auto& [name, quality] :
         {std::pair{"fast", DenoiseQuality::fast}, {"base", DenoiseQuality::base}, {"high", DenoiseQuality::high}}) {
        const auto made = denoiser.denoise(input_of(raw), {.quality = quality});
        if (!made) return made.error();
        const double denoised_relmse = relmse((*made)->rgb, 3);
        result[name] = {{"relmse", rounded(denoised_relmse)},
                        {"raw_over_denoised", rounded(raw_relmse / denoised_relmse)},
                        {"mean_energy_change_percent", rounded(100 * ((*made)->mean_after / (*made)->mean_before - 1))}};
    }
    return result;
}

} // namespace

Json run_denoise(const Options& options) {
    Json result{{"speed", Json::array()}, {"error", Json::array()}};
    const auto add = [](Json& list, const Result<Json>& measured) {
        list.push_back(measured ? *measured : Json{{"failed", measured.error().text()}});
    };
    for (const BenchScene& scene : options.scenes) {
        if (!scene.ours || (scene.name() != "cornell.gltf" && scene.name() != "card-and-mug.gltf")) continue;
        add(result["error"], measure_error(scene, options));
        if (!result["speed"].empty()) continue;
        RenderSettings settings = window_settings();
        settings.spp = 1;
        const Frame frame = rendered(scene, settings, options.threads);
        for (const Case& c : speed_cases)
            if (c.element == Element::float32 || denoise::has_bfloat16()) add(result["speed"], measure_speed(c, frame, options));
    }
    return result;
}

} // namespace blush::bench
