// The network architecture: sixteen 3x3 convolutions, each with bias and ReLU. Base and small networks differ in channels only.
#pragma once

#include <array>

namespace blush::denoise {

struct UnetLayer {
    const char* name;
    bool pool = false; // the output is max-pooled by 2x2
    // -1: input is the previous layer. Else: the previous layer upsampled by 2 (nearest), then this plane's channels
    int skip = -1;
};

inline constexpr int unet_layer_count = 16;
// Plane 0 is the network's input, plane i + 1 the output of layer i.
inline constexpr int unet_plane_count = unet_layer_count + 1;
inline constexpr std::array<UnetLayer, unet_layer_count> unet_layers{{
    {"enc_conv0"},
    {"enc_conv1", true},
    {"enc_conv2", true},
    {"enc_conv3", true},
    {"enc_conv4", true},
    {"enc_conv5a"},
    {"enc_conv5b"},
    {"dec_conv4a", false, 4},
    {"dec_conv4b"},
    {"dec_conv3a", false, 3},
    {"dec_conv3b"},
    {"dec_conv2a", false, 2},
    {"dec_conv2b"},
    {"dec_conv1a", false, 0},
    {"dec_conv1b"},
    {"dec_conv0"},
}};

// Four poolings: sides are multiples of this.
inline constexpr int unet_side_multiple = 16;
// Reach of an input pixel in the output, in pixels: half the receptive field of 174, rounded up to a multiple of the above.
inline constexpr int unet_reach = 96;

using UnetChannels = std::array<int, unet_plane_count>;

} // namespace blush::denoise
