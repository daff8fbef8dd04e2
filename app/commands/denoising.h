// Shared by `blush render --denoise` and `blush denoise`.
#pragma once

#include "app/commands/json_output.h"
#include "core/result.h"
#include "render/denoise/denoiser.h"

#include <atomic>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// Parses "fast" or "high". Errors: other text.
Result<DenoiseQuality> parse_denoise_quality(std::string_view text);

// Loads the weights for images with albedo and normal and denoises one pixel, so that missing or damaged weights are found before
// a long render. Errors: as Denoiser::denoise.
Result<void> try_denoiser(Denoiser& denoiser, DenoiseQuality quality);

// Denoises each input, with a progress display; `interrupted` is checked between the layers of the network. Errors: as
// Denoiser::denoise, or interrupted.
Result<std::vector<Denoised>> denoise_with_progress(Denoiser& denoiser, std::span<const DenoiseInput> inputs, DenoiseQuality quality,
                                                    bool quiet, const std::atomic<bool>& interrupted);

// {network, precision, tiles, seconds, bias_corrected, energy_change_percent, sanitised}
OrderedJson denoised_json(const Denoised& denoised);
// "rt_hdr_alb_nrm, bfloat16, bias corrected": network and precision, for metadata.
std::string denoised_by(const Denoised& denoised);
// "denoised by rt_hdr_alb_nrm, bfloat16, bias corrected in 0.31 s, mean energy +0.12 %, 3 pixels sanitised": for the terminal.
std::string denoised_summary(const Denoised& denoised);

} // namespace blush
