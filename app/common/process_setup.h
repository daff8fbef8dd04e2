// Process-wide setup, so that lack of memory, threads or disk space ends with one line and exit code 1.
#pragma once

#include <new>

namespace blush {

// Ignores SIGXFSZ: a write beyond the file size limit then fails with EFBIG, which the writer reports. Linking this file also
// installs, before main: a terminate handler that prints one line (for example if a thread cannot be started) and exits with code
// 1; and removal of environment variables that make libraries print to stderr.
void set_up_process();

// The message of operator new (out_of_memory.cpp); "not enough memory" for exceptions of libraries, which say no more than their name.
const char* what_was_missing(const std::bad_alloc& e) noexcept;

} // namespace blush
