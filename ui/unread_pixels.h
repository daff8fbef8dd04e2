// Memory of a picture that was handed on, taken again once nobody reads it: the one before may still be being copied.
#pragma once

#include <memory>
#include <vector>

namespace blush {

inline std::vector<float>& unread(std::shared_ptr<std::vector<float>>& pixels) {
    if (!pixels || pixels.use_count() > 1) pixels = std::make_shared<std::vector<float>>();
    return *pixels;
}

} // namespace blush
