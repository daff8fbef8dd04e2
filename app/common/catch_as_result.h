// Converts exceptions of background work to errors.
#pragma once

#include "core/result.h"

#include <exception>

namespace blush {

// Returns the result of `work`, or its exception as an error.
template <class T, class Work> Result<T> catch_as_result(const Work& work) {
    try {
        return work();
    } catch (const std::exception& e) { return Error{"", e.what(), ""}; }
}

} // namespace blush
