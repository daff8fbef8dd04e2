// The weights of one network, with checked shapes.
#pragma once

#include "core/result.h"
#include "render/denoise/unet_layers.h"

#include <array>
#include <filesystem>
#include <vector>

namespace blush::denoise {

struct ConvolutionWeights {
    int inputs = 0, outputs = 0;
    std::vector<float> kernel; // outputs * inputs * 3 * 3, in that order
    std::vector<float> bias;   // outputs
};

struct UnetWeights {
    std::array<ConvolutionWeights, unet_layer_count> layers;

    UnetChannels channels() const;
};

// Reads a .tza file for a network with `inputs` input channels and three output channels. Errors: the file cannot be read, is
// invalid (read_tza), or its tensors do not form such a network.
Result<UnetWeights> read_unet_weights(const std::filesystem::path& file, int inputs);

} // namespace blush::denoise
