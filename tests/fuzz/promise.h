#pragma once

#include "core/result.h"

#include <cstdio>
#include <cstdlib>

namespace blush::fuzz {

// Aborts the process with the error message, as fuzzers require, if an invariant is violated.
template <class T> void promise(const Result<T>& holds) {
    if (holds) return;
    std::fprintf(stderr, "invariant violated: %s\n", holds.error().text().c_str());
    std::abort();
}

} // namespace blush::fuzz
