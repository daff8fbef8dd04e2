// What image_reading.cpp and image_writing.cpp share, the only files that use OpenImageIO.
#pragma once

#include "io/image/image_io.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <new>
#include <string>

namespace blush {

struct ImageHeader {
    OIIO::ImageSpec spec;
};

// OpenImageIO's messages have several lines; joins them.
inline std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.empty() ? "unknown reason" : text;
}

// Runs work(), which returns a Result, and converts exceptions of OpenImageIO and the allocator to an Error. `name`: the file.
template <class F> auto guarded(const std::string& name, F&& work) -> decltype(work()) {
    try {
        return work();
    } catch (const std::bad_alloc&) { return Error{name, "not enough memory for the image", ""}; } catch (const std::exception& e) {
        return Error{name, one_line(e.what()), ""};
    }
}

} // namespace blush
