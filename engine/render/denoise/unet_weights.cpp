#include "render/denoise/unet_weights.h"

#include "core/files.h"
#include "render/denoise/tza.h"

#include <utility>

namespace blush::denoise {
namespace {

constexpr uint64_t max_file_bytes = uint64_t(64) << 20;
constexpr uint32_t max_channels = 1024;

// Moves the layer's two tensors out of the table. False if they are missing or have the wrong shape.
bool take_layer(TensorTable& tensors, const std::string& name, int inputs, ConvolutionWeights& layer) {
    const auto kernel = tensors.find(name + ".weight"), bias = tensors.find(name + ".bias");
    if (kernel == tensors.end() || bias == tensors.end()) return false;
    const std::vector<uint32_t>& shape = kernel->second.dimensions;
    if (kernel->second.layout != "oihw" || shape[0] < 1 || shape[0] > max_channels) return false;
    if (shape != std::vector<uint32_t>{shape[0], uint32_t(inputs), 3, 3}) return false;
    if (bias->second.layout != "x" || bias->second.dimensions[0] != shape[0]) return false;
    layer = {inputs, int(shape[0]), std::move(kernel->second.values), std::move(bias->second.values)};
    return true;
}

} // namespace

UnetChannels UnetWeights::channels() const {
    UnetChannels channels{layers[0].inputs};
    for (int i = 0; i < unet_layer_count; i++) channels[i + 1] = layers[i].outputs;
    return channels;
}

Result<UnetWeights> read_unet_weights(const std::filesystem::path& file, int inputs) {
    const auto bytes = read_file(file, max_file_bytes);
    if (!bytes) return bytes.error();
    auto tensors = read_tza(*bytes, file.string());
    if (!tensors) return tensors.error();

    UnetWeights weights;
    UnetChannels channels{inputs};
    for (int i = 0; i < unet_layer_count; i++) {
        const UnetLayer& layer = unet_layers[i];
        const int layer_inputs = channels[i] + (layer.skip >= 0 ? channels[layer.skip] : 0);
        if (!take_layer(*tensors, layer.name, layer_inputs, weights.layers[i]))
            return Error{file.string(), "not the weights of this network: a tensor is missing or has the wrong shape", layer.name};
        channels[i + 1] = weights.layers[i].outputs;
    }
    if (channels.back() != 3) return Error{file.string(), "not the weights of this network: the output does not have three channels"};
    return weights;
}

} // namespace blush::denoise
