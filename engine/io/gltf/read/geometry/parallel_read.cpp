#include "io/gltf/read/geometry/parallel_read.h"

#include "core/task_queue.h"

#include <atomic>
#include <optional>
#include <thread>

namespace blush {

Result<void> read_in_parallel(const GltfContext& context, const GltfPieces& pieces,
                              const std::function<Result<void>(const GltfContext& own, size_t i)>& read) {
    struct Outcome {
        ImportReport report;
        std::optional<Result<void>> read;
    };
    const size_t count = pieces.sizes.size();
    const std::thread::id reporter = std::this_thread::get_id();
    std::vector<Outcome> outcomes(count);
    std::atomic<size_t> done = 0, first_error = count;
    TaskQueue helpers(count < 2 ? 1 : pieces.threads);
    helpers.begin(pieces.sizes, pieces.large, [&](size_t i) {
        if (i > first_error) return;
        const GltfContext own = context.reporting_to(outcomes[i].report);
        outcomes[i].read = own.cancelled() ? Result<void>(own.cancel_error()) : read(own, i);
        if (!*outcomes[i].read)
            for (size_t first = first_error; i < first && !first_error.compare_exchange_weak(first, i);) {}
        ++done;
        if (std::this_thread::get_id() == reporter)
            context.progress(pieces.from + (pieces.to - pieces.from) * double(done) / double(count), pieces.what);
    });
    helpers.finish();
    for (const Outcome& outcome : outcomes) {
        context.add_all(outcome.report.diagnostics);
        if (!*outcome.read) return *outcome.read;
    }
    return {};
}

} // namespace blush
