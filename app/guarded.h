// Work for a thread that nothing may be thrown from.
#pragma once

#include "core/result.h"

#include <exception>

namespace blush {

// What `work` returns, or what it throws as an error.
template <class T, class Work> Result<T> guarded(const Work& work) {
    try {
        return work();
    } catch (const std::exception& e) { return Error{"", e.what(), ""}; }
}

} // namespace blush
