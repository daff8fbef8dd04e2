// Internal to core: what was written before give() may be read after receive(). TBB sees to it; this tells ThreadSanitizer, which cannot look
// into TBB. For files that are compiled without it (see CMakeLists.txt).
#pragma once

#ifdef BLUSH_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace blush {

class HandOver {
public:
#ifdef BLUSH_TSAN
    void give() const { __tsan_release(const_cast<HandOver*>(this)); }
    void receive() const { __tsan_acquire(const_cast<HandOver*>(this)); }
#else
    void give() const {}
    void receive() const {}
#endif
};

} // namespace blush
