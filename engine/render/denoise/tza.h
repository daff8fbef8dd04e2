// The container of Open Image Denoise's weights: named tensors, half or float. The file may be hostile.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace blush::denoise {

struct Tensor {
    std::vector<uint32_t> dimensions;
    std::string layout;        // one letter a dimension: "oihw", "x"
    std::vector<float> values; // as many as the product of the dimensions, all finite
};
using TensorTable = std::map<std::string, Tensor>;

// Version 2 of the format. Errors name `file` and the byte: wrong magic or version, anything beyond the end, tensors that
// claim more bytes than the file has, an unknown type, a name given twice, values that are not finite.
Result<TensorTable> read_tza(std::span<const uint8_t> bytes, const std::string& file);

} // namespace blush::denoise
