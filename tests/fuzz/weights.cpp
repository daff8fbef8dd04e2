#include "render/denoise/tza.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace blush::fuzz {

void weights(std::span<const uint8_t> bytes) {
    const auto tensors = denoise::read_tza(bytes, "weights.tza");
    if (!tensors) return;
    for (const auto& [name, tensor] : *tensors) {
        uint64_t values = 1;
        for (const uint32_t dimension : tensor.dimensions) values *= dimension;
        if (values != tensor.values.size() || tensor.layout.size() != tensor.dimensions.size())
            promise(Result<void>(Error{"", "a tensor does not have its size", name}));
    }
}

} // namespace blush::fuzz
