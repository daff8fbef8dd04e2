// ThreadSanitizer annotations. Writes before release() happen before reads after acquire(). TBB and Embree guarantee this, but
// ThreadSanitizer cannot see it, since they are not instrumented. Also for files compiled without TSan (see CMakeLists.txt).
#pragma once

#ifdef BLUSH_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace blush {

class HappensBefore {
public:
#ifdef BLUSH_TSAN
    void release() const { __tsan_release(const_cast<HappensBefore*>(this)); }
    void acquire() const { __tsan_acquire(const_cast<HappensBefore*>(this)); }
#else
    void release() const {}
    void acquire() const {}
#endif
};

} // namespace blush
