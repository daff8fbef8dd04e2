#include "ui/window/toasts.h"

namespace blush {

constexpr size_t max_toasts = 5;

std::chrono::milliseconds lifetime(const Toast& toast) {
    using namespace std::chrono_literals;
    if (toast.action) return 60s;
    return toast.kind == Toast::Kind::note ? 5s : 12s;
}

void Toasts::add(Toast toast) {
    ++added_;
    std::erase_if(toasts_, [&](const Toast& t) { return t.text == toast.text; });
    toasts_.push_back(std::move(toast));
    if (toasts_.size() > max_toasts) toasts_.erase(toasts_.begin());
}

void Toasts::remove_expired(std::chrono::steady_clock::time_point now) {
    std::erase_if(toasts_, [&](const Toast& t) { return now - t.since > lifetime(t); });
}

} // namespace blush
