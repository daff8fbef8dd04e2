// The shape of the network: sixteen 3x3 convolutions, each with bias and ReLU. Base and small networks differ in channels only.
#pragma once

#include <array>

namespace blush::denoise {

struct UnetLayer {
    const char* name;
    bool pool = false; // what it makes is halved: the largest of 2x2 pixels
    int skip = -1;     // -1: reads what the layer before made. Else: that doubled (nearest), and this plane's channels after it
};

inline constexpr int unet_layer_count = 16;
// Plane 0 is the network's input, plane i + 1 what layer i makes.
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
// How far, in pixels, an input reaches into the output: half the receptive field of 174, as a multiple of the above.
inline constexpr int unet_reach = 96;

using UnetChannels = std::array<int, unet_plane_count>;

} // namespace blush::denoise
