// ThreadSanitizer annotations. Writes before give() happen before reads after receive(). TBB and Embree guarantee this, but
// ThreadSanitizer cannot see it, since they are not instrumented. Also for files compiled without TSan (see CMakeLists.txt).
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
