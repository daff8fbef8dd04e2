// The two functions of OpenMP that Blush calls. The header of Clang would bring a runtime of its own; oneDNN runs on that of GCC (libgomp).
#pragma once

extern "C" {
int omp_get_max_threads();
void omp_set_num_threads(int count);
}
