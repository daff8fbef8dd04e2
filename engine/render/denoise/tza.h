// Reads the weights container of Open Image Denoise: named tensors, half or float. Safe for hostile files.
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
    std::string layout;        // one letter per dimension: "oihw", "x"
    std::vector<float> values; // product of the dimensions, all finite
};
using TensorTable = std::map<std::string, Tensor>;

// Version 2 of the format. Errors name `file` and the byte: wrong magic or version, data beyond the end, tensors that claim more
// bytes than the file has, an unknown type, a duplicate name, non-finite values.
Result<TensorTable> read_tza(std::span<const uint8_t> bytes, const std::string& file);

} // namespace blush::denoise
