// Replaces operator new: its std::bad_alloc says how much memory was requested and what the process limit is.
#include "core/memory_limit.h"
#include "core/sanitized.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>

// Sanitizers have their own operator new.
#ifndef BLUSH_SANITIZED

namespace {

class OutOfMemory : public std::bad_alloc {
public:
    explicit OutOfMemory(size_t wanted) {
        std::snprintf(text_, sizeof text_, "not enough memory: %.4g MB more were requested", double(wanted) / 1e6);
        thread_local bool asking = false; // the query itself allocates
        if (asking) return;
        asking = true;
        try {
            const std::string room = blush::memory_limit().text();
            std::snprintf(text_, sizeof text_, "not enough memory: %.4g MB more were requested, %s", double(wanted) / 1e6, room.c_str());
        } catch (...) {} // the message without the limit
        asking = false;
    }
    const char* what() const noexcept override { return text_; }

private:
    char text_[200];
};

void* allocated(size_t size) {
    if (void* memory = std::malloc(std::max<size_t>(size, 1))) return memory;
    throw OutOfMemory(size);
}

void* allocated(size_t size, std::align_val_t alignment) {
    const size_t step = size_t(alignment), rounded = (std::max<size_t>(size, 1) + step - 1) / step * step;
    if (rounded >= size)
        if (void* memory = std::aligned_alloc(step, rounded)) return memory;
    throw OutOfMemory(size);
}

} // namespace

// The other operators call these.
void* operator new(size_t size) { return allocated(size); }
void* operator new(size_t size, std::align_val_t alignment) { return allocated(size, alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }

#endif
