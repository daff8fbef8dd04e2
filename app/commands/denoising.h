// What `blush render --denoise` and `blush denoise` share.
#pragma once

#include "app/commands/json_output.h"
#include "core/result.h"
#include "render/denoiser.h"

#include <atomic>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// "fast" or "high". Errors: anything else.
Result<DenoiseQuality> parse_denoise_quality(std::string_view text);

// Loads the weights that images with albedo and normal need and denoises one pixel: weights that are absent or damaged are found out
// before hours of rendering. Errors: as Denoiser::denoise.
Result<void> try_denoiser(Denoiser& denoiser, DenoiseQuality quality);

// Each of the inputs. Shows that it is busy; `interrupted` is looked at between the networks' layers. Errors: as Denoiser::denoise, or
// interrupted.
Result<std::vector<Denoised>> denoise_with_progress(Denoiser& denoiser, std::span<const DenoiseInput> inputs, DenoiseQuality quality, bool quiet,
                                                    const std::atomic<bool>& interrupted);

// {network, precision, tiles, seconds, energy_change_percent, sanitised}
OrderedJson denoised_json(const Denoised& denoised);
// "rt_hdr_alb_nrm, bfloat16": how it was made, for metadata.
std::string denoised_by(const Denoised& denoised);
// "denoised by rt_hdr_alb_nrm, bfloat16 in 0.31 s, mean energy +0.12 %, 3 pixels sanitised": for people.
std::string denoised_summary(const Denoised& denoised);

} // namespace blush
