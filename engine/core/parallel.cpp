#include "core/parallel.h"

#include "core/startable_threads.h"
#include "core/started_observer.h"
#include "core/tsan_annotations.h"

#include <atomic>
#include <cstdint>
#include <pmmintrin.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>

#ifdef __linux__
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace blush {
namespace {

class ThreadSetup : public tbb::task_scheduler_observer {
public:
    ThreadSetup(tbb::task_arena& arena, bool low_priority) : tbb::task_scheduler_observer(arena), low_priority_(low_priority) {}
    ~ThreadSetup() override { observe(false); }

    void on_scheduler_entry(bool is_worker) override {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
        if (is_worker && low_priority_) lower_priority_of_this_thread();
    }

private:
    bool low_priority_;
};

} // namespace

void lower_priority_of_this_thread() {
#ifdef __linux__
    // On Linux the nice value is per thread. Failure is harmless: the UI is only less smooth.
    constexpr int nice = 10;
    (void)setpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid)), nice);
    // Since Linux 6.12 a waking thread preempts threads with longer time slices immediately; otherwise it may wait for the end of
    // a slice several times per frame. No effect on older kernels.
    constexpr uint64_t slice_nanoseconds = 4'000'000; // default slices are up to 2.8 ms
    // First version of Linux' struct sched_attr; its header conflicts with that of glibc.
    struct {
        uint32_t size = 48, policy = SCHED_OTHER;
        uint64_t flags = 0;
        int32_t nice = 0;
        uint32_t priority = 0;
        uint64_t runtime = 0, deadline = 0, period = 0;
    } attributes;
    static_assert(sizeof attributes == 48);
    attributes.nice = nice;
    attributes.runtime = slice_nanoseconds;
    (void)syscall(SYS_sched_setattr, 0, &attributes, 0u);
#endif
}

struct Workers::State {
    tbb::task_arena arena;
    std::unique_ptr<ThreadSetup> setup;
    State(unsigned threads, bool low_priority) : arena(int(threads)), setup(start_observer<ThreadSetup>(arena, low_priority)) {}
};

Workers::Workers(unsigned threads, bool low_priority)
    : threads_(startable_threads(threads ? threads : std::max(1u, std::thread::hardware_concurrency()))),
      state_(std::make_unique<State>(threads_, low_priority)) {
    if (low_priority) lower_priority_of_this_thread();
}

Workers::~Workers() = default;

bool Workers::for_each(int64_t count, const std::function<bool()>& wanted, const std::function<void(int64_t, unsigned)>& task) const {
    // One long-running task per worker that takes items from a counter: items are coarse, and a worker index must be unique since
    // workers own scratch memory.
    std::atomic<int64_t> next{0}, done{0};
    const HappensBefore to_workers, from_workers;
    to_workers.release();
    state_->arena.execute([&] {
        tbb::parallel_for(
            0u, threads_,
            [&](unsigned worker) {
                to_workers.acquire();
                for (int64_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
                    if (wanted && !wanted()) break;
                    task(i, worker);
                    done.fetch_add(1, std::memory_order_relaxed);
                }
                from_workers.release();
            },
            tbb::simple_partitioner());
    });
    from_workers.acquire();
    return done == count;
}

void Workers::run(const std::function<void()>& task) const { state_->arena.execute(task); }

} // namespace blush
