// Effect of path reuse and adaptive sampling on displayed images, raw and denoised: FLIP and relMSE at equal samples against a
// converged reference, and the render cost.
#include "tests/bench/bench.h"

#include "io/image/image_io.h"
#include "measure/metrics/metrics.h"
#include "render/denoise/denoiser.h"
#include "render/renderer.h"
#include "render/session/denoised_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <utility>

namespace blush::bench {
namespace {

constexpr int width = 256, height = 160;

struct Variant {
    const char* name;
    int reuse;
    bool adaptive;
};
constexpr Variant variants[]{{"plain", 1, false}, {"reuse", 8, false}, {"adaptive", 1, true}, {"reuse and adaptive", 8, true}};
constexpr std::pair<const char*, DenoiseQuality> qualities[]{{"fast", DenoiseQuality::fast}, {"high", DenoiseQuality::high}};

RenderSettings settings_of(const Variant& variant, uint32_t seed) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.reuse = variant.reuse;
    settings.adaptive = variant.adaptive;
    settings.seed = seed;
    return settings;
}

template <class Values> RgbImage image_of(const Values& values, size_t stride) {
    RgbImage image{width, height, {}};
    for (size_t i = 0; i < values.size(); i += stride) image.pixels.push_back({values[i], values[i + 1], values[i + 2]});
    return image;
}

LayeredImage layers_of(const RgbImage& image) {
    LayeredImage layers{width, height, {}, {}};
    for (const auto& [name, channel] : {std::pair{"R", &Vec3::x}, {"G", &Vec3::y}, {"B", &Vec3::z}}) {
        layers.channels.push_back({name, {}});
        for (const Vec3& p : image.pixels) layers.channels.back().values.push_back(p.*channel);
    }
    return layers;
}

RgbImage reference_of(const BenchScene& scene, const Options& options) {
    const std::filesystem::path file =
        options.cache / fmt::format("{}-{}x{}-{}.exr", scene.name(), width, height, options.reference_samples);
    if (!options.cache.empty())
        if (const auto cached = read_layers(file)) {
            const auto rgb = cached->find_color();
            if (rgb[0] && cached->width == width && cached->height == height) {
                RgbImage image{width, height, {}};
                for (size_t i = 0; i < rgb[0]->values.size(); ++i)
                    image.pixels.push_back({rgb[0]->values[i], rgb[1]->values[i], rgb[2]->values[i]});
                return image;
            }
        }
    RenderSettings settings = settings_of({"reference", 16, false}, 1000);
    Renderer renderer({.threads = options.threads, .planes = {}});
    renderer.update(scene.scene, settings);
    renderer.render(0, options.reference_samples);
    RgbImage image = image_of(renderer.resolve().rgba, 4);
    if (!options.cache.empty())
        if (const auto written = write_exr(file, layers_of(image)); !written) fmt::print(stderr, "{}\n", written.error().text());
    return image;
}

// Statistics over seeds.
struct Figures {
    std::vector<double> flip, relmse;
    void add(const RgbImage& image, const RgbImage& reference) {
        const auto metrics = compare(image, reference, Encoding::scene_linear);
        flip.push_back(metrics->flip.mean);
        relmse.push_back(metrics->relmse);
    }
};

Json mean_and_error(const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (const double v : values) sum += v;
    const double mean = sum / double(values.size());
    for (const double v : values) squares += (v - mean) * (v - mean);
    const double n = double(values.size());
    return Json::array({rounded(mean), n > 1 ? Json(rounded(std::sqrt(squares / (n * (n - 1))))) : Json()});
}

// All measures at 1, 2, 4, ... samples per pixel of one rendering.
void render_series(const BenchScene& scene, const Variant& variant, uint32_t seed, const RgbImage& reference, Denoiser& denoiser,
                   const Options& options, std::map<int64_t, std::map<std::string, Figures>>& figures, std::vector<double>& seconds) {
    Renderer renderer({.threads = options.threads, .planes = {.albedo = true, .normal = true, .half_difference = true}});
    renderer.update(scene.scene, settings_of(variant, seed));
    double spent = 0;
    for (int64_t done = 0, count = 1; count <= options.max_samples; done = count, count *= 2) {
        spent += cost_of([&] { renderer.render(done, count - done); }).core_seconds;
        // Adaptive sampling begins after its pilot.
        if (variant.adaptive && count <= 16) continue;
        const Frame frame = renderer.resolve();
        auto& of_count = figures[count];
        of_count["raw"].add(image_of(frame.rgba, 4), reference);
        for (const auto& [name, quality] : qualities) {
            auto made = denoiser.denoise(denoise_inputs(frame).front(), {.quality = quality});
            if (!made) throw std::runtime_error(made.error().text());
            const auto denoised = denoised_image(frame, quality, {*std::move(*made)});
            of_count[name].add(image_of(denoised->denoised.rgb, 3), reference);
        }
    }
    seconds.push_back(spent);
}

} // namespace

Json run_image_quality(const Options& options) {
    Json result;
    Denoiser denoiser(weights_folder(), options.threads);
    for (const BenchScene& scene : options.scenes) {
        const RgbImage reference = reference_of(scene, options);
        for (const Variant& variant : variants) {
            if (!options.variant.empty() && options.variant != variant.name) continue;
            std::map<int64_t, std::map<std::string, Figures>> figures;
            std::vector<double> seconds;
            for (int seed = 0; seed < options.rounds; ++seed)
                render_series(scene, variant, uint32_t(seed), reference, denoiser, options, figures, seconds);
            Json& of_variant = result[scene.name()][variant.name];
            of_variant["core_seconds"] = rounded(median(seconds));
            for (const auto& [count, images] : figures)
                for (const auto& [name, f] : images)
                    of_variant[fmt::format("{} spp", count)][name] = {{"flip", mean_and_error(f.flip)},
                                                                      {"relmse", mean_and_error(f.relmse)}};
        }
    }
    return result;
}

} // namespace blush::bench
