#include "core/task_queue.h"

#include "core/parallel.h"
#include "core/startable_threads.h"
#include "core/started_observer.h"
#include "core/tsan_annotations.h"

#include <algorithm>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#include <thread>
#include <utility>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace blush {
namespace {

// On Linux a nice value belongs to a thread.
bool this_thread_has_low_priority() {
#ifdef __linux__
    return getpriority(PRIO_PROCESS, id_t(syscall(SYS_gettid))) > 0;
#else
    return false;
#endif
}

class SamePriority : public tbb::task_scheduler_observer {
public:
    explicit SamePriority(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena), low_(this_thread_has_low_priority()) {}
    ~SamePriority() override { observe(false); }

    void on_scheduler_entry(bool is_worker) override {
        if (is_worker && low_) lower_priority_of_this_thread();
    }

private:
    bool low_;
};

} // namespace

struct TaskQueue::State {
    unsigned threads;
    std::vector<std::function<void()>> waiting; // used without other threads
    tbb::task_arena arena;
    std::unique_ptr<SamePriority> priority;
    tbb::task_group group;
    HappensBefore to_helpers, from_helpers;

    explicit State(unsigned count) : threads(count), arena(int(count)), priority(start_observer<SamePriority>(arena)) {
        if (!alone()) arena.initialize(); // initialised here to capture this thread's floating-point settings
    }

    bool alone() const { return threads == 1; }
    void begin(std::function<void()> work) {
        if (alone()) return waiting.push_back(std::move(work));
        auto held = std::make_shared<std::function<void()>>(std::move(work));
        to_helpers.release();
        group.run([this, held = std::move(held)] {
            to_helpers.acquire();
            try {
                (*held)();
            } catch (...) {
                from_helpers.release(); // also after an exception
                throw;
            }
            from_helpers.release();
            *held = nullptr; // released here, since the order of destruction in TBB is undefined
        });
    }
};

TaskQueue::TaskQueue(unsigned threads)
    : state_(std::make_unique<State>(startable_threads(threads ? threads : std::max(1u, std::thread::hardware_concurrency())))) {}

TaskQueue::~TaskQueue() {
    try {
        finish();
    } catch (...) {} // exceptions are dropped, see the header
}

void TaskQueue::begin(const std::vector<int64_t>& sizes, int64_t large, std::function<void(size_t)> task) {
    using Task = std::function<void(size_t)>;
    const auto forget = [state = state_.get()](const Task* done) {
        state->from_helpers.acquire(); // the last owner
        delete done;
    };
    const std::shared_ptr<const Task> shared(new Task(std::move(task)), forget);
    std::vector<size_t> one_by_one, side_by_side;
    for (size_t i = 0; i < sizes.size(); ++i) (sizes[i] > large ? one_by_one : side_by_side).push_back(i);
    const auto begin_all = [&] {
        if (!one_by_one.empty())
            state_->begin([shared, one_by_one] {
                for (const size_t i : one_by_one) (*shared)(i);
            });
        // Enough chunks to balance the load, but not millions.
        const size_t piece = side_by_side.size() / (64 * size_t(state_->threads)) + 1;
        for (size_t first = 0; first < side_by_side.size(); first += piece) {
            const auto begin = side_by_side.begin() + std::ptrdiff_t(first),
                       end = begin + std::ptrdiff_t(std::min(piece, side_by_side.size() - first));
            state_->begin([shared, part = std::vector<size_t>(begin, end)] {
                for (const size_t i : part) (*shared)(i);
            });
        }
    };
    if (state_->alone())
        begin_all();
    else
        state_->arena.execute(begin_all);
}

void TaskQueue::finish() {
    for (const auto& work : std::exchange(state_->waiting, {})) work();
    if (state_->alone()) return;
    try {
        state_->arena.execute([this] { state_->group.wait(); });
    } catch (...) {
        state_->from_helpers.acquire();
        throw;
    }
    state_->from_helpers.acquire();
}

} // namespace blush
