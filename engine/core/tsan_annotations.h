// ThreadSanitizer annotations. Writes before release() happen before reads after acquire(). TBB and Embree guarantee this, but
// ThreadSanitizer cannot see it, since they are not instrumented. Also for files compiled without TSan (see CMakeLists.txt).
#pragma once

#ifdef BLUSH_TSAN
#include <sanitizer/tsan_interface.h>
// No header of GCC declares them.
extern "C" void AnnotateIgnoreWritesBegin(const char* file, int line);
extern "C" void AnnotateIgnoreWritesEnd(const char* file, int line);
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

// While it exists, ThreadSanitizer ignores what this thread writes: for an object that a library makes, and whose threads read it later.
class IgnoredWrites {
public:
#ifdef BLUSH_TSAN
    IgnoredWrites() { AnnotateIgnoreWritesBegin(__FILE__, __LINE__); }
    ~IgnoredWrites() { AnnotateIgnoreWritesEnd(__FILE__, __LINE__); }
#else
    IgnoredWrites() {}
    ~IgnoredWrites() {}
#endif
    IgnoredWrites(const IgnoredWrites&) = delete;
    IgnoredWrites& operator=(const IgnoredWrites&) = delete;
};

} // namespace blush
