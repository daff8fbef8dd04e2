// Converts exceptions of OpenImageIO and the allocator to errors.
#pragma once

#include "core/result.h"

#include <algorithm>
#include <exception>
#include <new>
#include <string>

namespace blush {

// OpenImageIO's messages have several lines; joins them.
inline std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.empty() ? "unknown reason" : text;
}

// Runs work(), which returns a Result, and converts its exceptions to an Error. `name`: the file.
template <class F> auto guarded(const std::string& name, F&& work) -> decltype(work()) {
    try {
        return work();
    } catch (const std::bad_alloc&) { return Error{name, "not enough memory for the image", ""}; } catch (const std::exception& e) {
        return Error{name, one_line(e.what()), ""};
    }
}

} // namespace blush
