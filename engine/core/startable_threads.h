// How many threads the process may start.
#pragma once

namespace blush {

// `wanted`, or fewer: 256 or one per core at most, and where limits on processes or memory allow no more at the moment, as many as they do; this thread is one of them. A thread that TBB cannot start
// ends the process. Tries it out, once for each larger number: some 20 us a thread.
unsigned startable_threads(unsigned wanted);

// 256, or one per core if those are more.
unsigned startable_threads_limit();

} // namespace blush
