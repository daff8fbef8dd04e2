// Names the instruction set a translation unit is compiled for.
// Kernels are the same templates compiled several times (x86-64-v2, v3, v4). Every function template that a kernel may use is in
// the inline namespace BLUSH_ISA, so that the linker never merges an AVX-512 copy into code for machines without it. Plain data
// is outside, so that all kernels share one scene. tests/ checks the object files for stray weak symbols.
#pragma once

#ifndef BLUSH_ISA
#define BLUSH_ISA isa_baseline
#endif
