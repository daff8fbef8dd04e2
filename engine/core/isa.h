// Names the instruction set a translation unit is compiled for.
//
// The kernels are the same templates compiled several times (x86-64-v2, v3, v4). Every function template
// that may end up in a kernel lives in the inline namespace BLUSH_ISA, so that the linker can never fold a
// copy with AVX-512 in it into code that must run on a machine without. Plain data lives outside it, so that
// one scene serves all kernels. tests/ checks the object files for stray weak symbols.
#pragma once

#ifndef BLUSH_ISA
#define BLUSH_ISA isa_baseline
#endif
