// Entry point of libFuzzer: one program per target.
#include "tests/fuzz/targets.h"

#include <cstddef>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    blush::fuzz::BLUSH_FUZZ_TARGET({data, size});
    return 0;
}
