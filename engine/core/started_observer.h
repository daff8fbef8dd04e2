// Starts observers of TBB's threads safely where memory is short.
#pragma once

#include <memory>
#include <tbb/task_scheduler_observer.h>
#include <utility>

namespace blush {

// A new Observer(arguments...) that observes. If there is no memory to start it, it is leaked: TBB 2021.8 would crash in its destructor.
template <class Observer, class... Arguments> std::unique_ptr<Observer> start_observer(Arguments&&... arguments) {
    auto observer = std::make_unique<Observer>(std::forward<Arguments>(arguments)...);
    try {
        observer->observe(true);
    } catch (...) {
        [[maybe_unused]] const Observer* leaked = observer.release();
        throw;
    }
    return observer;
}

} // namespace blush
