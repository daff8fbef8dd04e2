#include "render/denoiser.h"

#include <array>
#include <system_error>

namespace blush {
namespace {

constexpr std::array network_names{"rt_alb",         "rt_nrm",           "rt_hdr",         "rt_hdr_small",
                                   "rt_hdr_alb",     "rt_hdr_alb_small", "rt_hdr_alb_nrm", "rt_hdr_alb_nrm_small",
                                   "rt_hdr_calb_cnrm"};

} // namespace

struct Denoiser::State {
    std::filesystem::path weights;
};

Denoiser::Denoiser(std::filesystem::path weights, unsigned, bool) : state_(std::make_unique<State>(State{std::move(weights)})) {}

Denoiser::~Denoiser() = default;

Result<std::optional<Denoised>> Denoiser::denoise(const DenoiseInput&, const DenoiseOptions&, const std::function<bool()>&) {
    if (const auto found = find_denoiser_weights(state_->weights); !found) return found.error();
    return Error{.what = "this build cannot denoise"};
}

void Denoiser::release() {}

Result<void> find_denoiser_weights(const std::filesystem::path& weights) {
    for (const char* name : network_names) {
        const std::filesystem::path file = weights / (std::string(name) + ".tza");
        std::error_code code;
        if (!std::filesystem::is_regular_file(file, code)) return Error{file.string(), "the denoiser's weights are not there"};
    }
    return {};
}

} // namespace blush
