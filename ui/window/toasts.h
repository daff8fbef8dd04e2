// Toasts: short messages that disappear by themselves.
#pragma once

#include "ui/window/shortcuts.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct Toast {
    enum class Kind { note, warning, failure };
    Kind kind = Kind::note;
    std::string text;
    std::string details;           // smaller text below; may be empty
    std::optional<Command> action; // offered as a button
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
};

class Toasts {
public:
    void note(std::string text, std::string details = {}) { add({Toast::Kind::note, std::move(text), std::move(details), {}}); }
    void warn(std::string text, std::string details = {}) { add({Toast::Kind::warning, std::move(text), std::move(details), {}}); }
    void fail(std::string text, std::string details = {}) { add({Toast::Kind::failure, std::move(text), std::move(details), {}}); }
    // A toast with the same text replaces the older one.
    void add(Toast toast);
    void dismiss(size_t index) { toasts_.erase(toasts_.begin() + ptrdiff_t(index)); }
    // Removes expired toasts.
    void remove_expired(std::chrono::steady_clock::time_point now);
    const std::vector<Toast>& all() const { return toasts_; }
    // Number of toasts ever added: the window needs a new frame when it grows.
    uint64_t added() const { return added_; }

private:
    std::vector<Toast> toasts_;
    uint64_t added_ = 0;
};

// Display time of a toast: longer for failures and those with an action.
std::chrono::milliseconds lifetime(const Toast& toast);

} // namespace blush
