#include "core/startable_threads.h"

#include <algorithm>
#include <latch>
#include <limits>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace blush {

// TBB's maximum; it prints a warning above it.
unsigned startable_threads_limit() { return std::max(256u, std::thread::hardware_concurrency()); }

unsigned startable_threads(unsigned wanted) {
    wanted = std::min(wanted, startable_threads_limit());
    static std::mutex mutex;
    static unsigned known = 1, most = std::numeric_limits<unsigned>::max();
    const std::lock_guard lock(mutex);
    if (wanted <= known || most <= known) return std::min(wanted, most);
    std::vector<std::thread> tried;
    std::latch end(1);
    try {
        tried.reserve(wanted);
        while (tried.size() + 1 < wanted) tried.emplace_back([&] { end.wait(); });
    } catch (const std::system_error&) { most = unsigned(tried.size()) + 1; } catch (const std::bad_alloc&) {
        most = unsigned(tried.size()) + 1;
    }
    end.count_down();
    for (std::thread& thread : tried) thread.join();
    known = unsigned(tried.size()) + 1;
    return std::min(wanted, most);
}

} // namespace blush
