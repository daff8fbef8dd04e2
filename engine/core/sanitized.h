// BLUSH_SANITIZED is defined in builds with AddressSanitizer or ThreadSanitizer: they handle running out of memory themselves, and need
// much address space.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) // GCC
#define BLUSH_SANITIZED
#elif defined(__has_feature) // Clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BLUSH_SANITIZED
#endif
#endif
