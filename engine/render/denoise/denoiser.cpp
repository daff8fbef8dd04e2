#include "render/denoise/denoiser.h"

#include "core/parallel.h"
#include "render/denoise/convolution.h"
#include "render/denoise/exposure.h"
#include "render/denoise/networks.h"
#include "render/denoise/pixels.h"
#include "render/denoise/transfer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <new>
#include <system_error>

namespace blush {
namespace {

using namespace denoise;

constexpr std::array network_names{"rt_alb",          "rt_nrm", "rt_hdr", "rt_hdr_small", "rt_hdr_alb_nrm", "rt_hdr_alb_nrm_small",
                                   "rt_hdr_calb_cnrm"};
constexpr int max_side = 65536;

Result<void> check_plane(const PixelView& plane, const DenoiseInput& input, const char* name) {
    const size_t pixels = size_t(input.width) * input.height;
    if (plane.stride < 3 || plane.values.size() < (pixels - 1) * plane.stride + 3)
        return Error{.what = fmt::format("the {} plane to denoise has fewer than {}x{} pixels", name, input.width, input.height)};
    return {};
}

Result<void> check(const DenoiseInput& input, const DenoiseOptions& options) {
    if (input.width < 1 || input.height < 1 || input.width > max_side || input.height > max_side)
        return Error{.what = fmt::format("no image to denoise: {}x{} pixels", input.width, input.height)};
    if (auto good = check_plane(input.color, input, "colour"); !good) return good;
    if (!input.albedo.values.empty())
        if (auto good = check_plane(input.albedo, input, "albedo"); !good) return good;
    if (!input.normal.values.empty())
        if (auto good = check_plane(input.normal, input, "normal"); !good) return good;
    if (options.exposure_scale && !(*options.exposure_scale >= min_scale_factor && *options.exposure_scale <= max_scale))
        return Error{.what = fmt::format("invalid exposure scale of {} for the denoiser", *options.exposure_scale)};
    if (options.precision == DenoisePrecision::bfloat16 && !has_bfloat16())
        return Error{.what = "this processor does not support bfloat16"};
    return {};
}

Element element_for(DenoisePrecision precision) {
    if (precision == DenoisePrecision::automatic) return has_bfloat16() ? Element::bfloat16 : Element::float32;
    return precision == DenoisePrecision::bfloat16 ? Element::bfloat16 : Element::float32;
}

const float* at(const PixelView& plane, int width, int x, int y) { return &plane.values[(size_t(y) * width + x) * plane.stride]; }

// One image and the networks that it passes through.
class Passage {
public:
    Passage(const DenoiseInput& input, const DenoiseOptions& options, Networks& networks, const Workers& workers,
            const std::function<bool()>& wanted, const std::function<void(double)>& progress)
        : input_(input), options_(options), networks_(networks), workers_(workers), wanted_(wanted), progress_(progress),
          features_(!input.albedo.values.empty() && !input.normal.values.empty()),
          prefilter_(features_ && options.quality == DenoiseQuality::high), element_(element_for(options.precision)) {}

    // False: cancelled.
    Result<bool> run(Denoised& made) {
        made.exposure_scale = exposure_scale();
        const Inspection before = inspect(input_.color, input_.width, input_.height, max_network_radiance / made.exposure_scale, workers_);
        made.sanitised = before.unusual;
        made.mean_before = before.mean_luminance;
        made.network = network();
        made.precision = element_ == Element::float32 ? "float32" : "bfloat16";

        for (const bool normal : {false, true})
            if (prefilter_) {
                const auto done = prefilter(normal);
                if (!done || !*done) return done;
            }
        made.rgb.resize(size_t(input_.width) * input_.height * 3);
        NetworkJob job = this->job(made.network, features_ ? 9 : 3);
        job.source = [&](int x, int y, int count, float* row) { read(x, y, count, made.exposure_scale, row, job.inputs); };
        job.sink = [&](int x, int y, int count, const float* row) {
            decode_color(row, count, made.exposure_scale, &made.rgb[(size_t(y) * input_.width + x) * 3]);
        };
        const auto tiles = networks_.run(job, workers_, wanted_);
        if (!tiles) return tiles.error();
        made.tiles = *tiles;
        made.mean_after = inspect({made.rgb, 3}, input_.width, input_.height, 0, workers_).mean_luminance;
        return made.tiles > 0;
    }

private:
    float exposure_scale() const {
        const std::optional<float>& held = options_.exposure_scale;
        if (held && std::isinf(options_.exposure_tolerance)) return *held;
        const float measured = exposure_scale_of(input_.color, input_.width, input_.height, workers_);
        return held && std::max(measured / *held, *held / measured) <= options_.exposure_tolerance ? *held : measured;
    }

    std::string network() const {
        if (prefilter_) return "rt_hdr_calb_cnrm";
        return std::string(features_ ? "rt_hdr_alb_nrm" : "rt_hdr") + (options_.quality == DenoiseQuality::fast ? "_small" : "");
    }

    NetworkJob job(std::string network, int inputs) {
        const auto tell = [this, before = networks_run_++](double share) {
            if (progress_) progress_((before + share) / (prefilter_ ? 3 : 1));
        };
        return {.network = std::move(network),
                .inputs = inputs,
                .width = input_.width,
                .height = input_.height,
                .element = element_,
                .memory_bytes = options_.memory_bytes,
                .progress = tell};
    }

    // Denoises albedo or normals (in the network's encoding) with their own network.
    Result<bool> prefilter(bool normal) {
        std::vector<float>& clean = normal ? clean_normal_ : clean_albedo_;
        clean.resize(size_t(input_.width) * input_.height * 3);
        NetworkJob job = this->job(normal ? "rt_nrm" : "rt_alb", 3);
        job.source = [&](int x, int y, int count, float* row) {
            const PixelView& plane = normal ? input_.normal : input_.albedo;
            (normal ? encode_normal : encode_albedo)(at(plane, input_.width, x, y), plane.stride, count, row, 3);
        };
        job.sink = [&](int x, int y, int count, const float* row) {
            encode_albedo(row, 3, count, &clean[(size_t(y) * input_.width + x) * 3], 3);
        };
        const auto tiles = networks_.run(job, workers_, wanted_);
        if (!tiles) return tiles.error();
        return *tiles > 0;
    }

    void read(int x, int y, int count, float scale, float* row, int channels) const {
        encode_color(at(input_.color, input_.width, x, y), input_.color.stride, count, scale, row, channels);
        if (prefilter_) {
            encode_albedo(&clean_albedo_[(size_t(y) * input_.width + x) * 3], 3, count, row + 3, channels);
            encode_albedo(&clean_normal_[(size_t(y) * input_.width + x) * 3], 3, count, row + 6, channels);
        } else if (features_) {
            encode_albedo(at(input_.albedo, input_.width, x, y), input_.albedo.stride, count, row + 3, channels);
            encode_normal(at(input_.normal, input_.width, x, y), input_.normal.stride, count, row + 6, channels);
        }
    }

    const DenoiseInput& input_;
    const DenoiseOptions& options_;
    Networks& networks_;
    const Workers& workers_;
    const std::function<bool()>& wanted_;
    const std::function<void(double)>& progress_;
    bool features_;  // albedo and normal are present
    bool prefilter_; // and are prefiltered
    Element element_;
    int networks_run_ = 0;                           // of three (about the same size) or one
    std::vector<float> clean_albedo_, clean_normal_; // prefiltered, in the network's encoding
};

} // namespace

struct Denoiser::State {
    Networks networks;
    Workers workers;
};

Denoiser::Denoiser(std::filesystem::path weights, unsigned threads, bool low_priority)
    : state_(new State{Networks(std::move(weights)), Workers(threads, low_priority)}) {}

Denoiser::~Denoiser() = default;

Result<std::optional<Denoised>> Denoiser::denoise(const DenoiseInput& input, const DenoiseOptions& options,
                                                  const std::function<bool()>& wanted, const std::function<void(double)>& progress) {
    const auto begin = std::chrono::steady_clock::now();
    if (const auto good = check(input, options); !good) return good.error();
    try {
        Denoised made;
        const double prepared_before = state_->networks.seconds_of_preparation();
        const auto finished = Passage(input, options, state_->networks, state_->workers, wanted, progress).run(made);
        if (!finished) return finished.error();
        if (!*finished) return std::optional<Denoised>();
        made.seconds_of_preparation = state_->networks.seconds_of_preparation() - prepared_before;
        made.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return std::optional(std::move(made));
    } catch (const std::bad_alloc&) { return Error{.what = "not enough memory to denoise"}; }
}

void Denoiser::release() { state_->networks.release(); }

Result<void> find_denoiser_weights(const std::filesystem::path& weights) {
    for (const char* name : network_names) {
        const std::filesystem::path file = weights / (std::string(name) + ".tza");
        std::error_code code;
        if (!std::filesystem::is_regular_file(file, code)) return Error{file.string(), "the denoiser weights are missing"};
    }
    return {};
}

FeatureReport denoiser_feature_report(const std::filesystem::path& weights, const std::array<bool, denoise_qualities>& loaded) {
    // With albedo and normal, which all our frames have.
    struct Networks {
        DenoiseQuality quality;
        const char* name;
        std::vector<const char*> files;
    };
    const Networks networks[denoise_qualities] = {{DenoiseQuality::fast, "fast network", {"rt_hdr_alb_nrm_small"}},
                                                  {DenoiseQuality::base, "base network", {"rt_hdr_alb_nrm"}},
                                                  {DenoiseQuality::high, "high network", {"rt_alb", "rt_nrm", "rt_hdr_calb_cnrm"}}};
    FeatureReport feature_report;
    for (const Networks& n : networks) {
        const bool used = loaded[size_t(n.quality)];
        FeatureUse use{"denoiser", n.name, used, used ? "denoising is on" : "no denoising at this quality"};
        int64_t bytes = 0;
        bool all_there = true;
        for (const char* name : n.files) {
            std::error_code code;
            const uintmax_t size = std::filesystem::file_size(weights / (std::string(name) + ".tza"), code);
            all_there &= !code;
            if (!code) bytes += int64_t(size);
        }
        if (all_there) use.bytes = bytes;
        feature_report.push_back(std::move(use));
    }
    return feature_report;
}

} // namespace blush
