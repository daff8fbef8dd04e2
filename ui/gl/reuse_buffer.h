// Reuses the memory of a published image once it has no more readers; the previous one may still be in use.
#pragma once

#include <memory>
#include <vector>

namespace blush {

inline std::vector<float>& writable_buffer(std::shared_ptr<std::vector<float>>& pixels) {
    if (!pixels || pixels.use_count() > 1) pixels = std::make_shared<std::vector<float>>();
    return *pixels;
}

} // namespace blush
