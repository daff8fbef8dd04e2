// Number of threads that the process can start.
#pragma once

namespace blush {

// `wanted`, limited by startable_threads_limit() and by the current limits on processes and memory; includes the calling thread.
// TBB ends the process if it cannot start a thread, so this tries to start them: about 20 us per thread, once per larger number.
unsigned startable_threads(unsigned wanted);

// 256 or the number of cores, whichever is larger.
unsigned startable_threads_limit();

} // namespace blush
