// Short messages that come and go by themselves.
#pragma once

#include "ui/shortcuts.h"

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
    std::string details;           // smaller, below; may be empty
    std::optional<Command> action; // offered as a button
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
};

class Toasts {
public:
    void note(std::string text, std::string details = {}) { add({Toast::Kind::note, std::move(text), std::move(details), {}}); }
    void warn(std::string text, std::string details = {}) { add({Toast::Kind::warning, std::move(text), std::move(details), {}}); }
    void fail(std::string text, std::string details = {}) { add({Toast::Kind::failure, std::move(text), std::move(details), {}}); }
    // The same text again replaces the older toast.
    void add(Toast toast);
    void dismiss(size_t index) { toasts_.erase(toasts_.begin() + ptrdiff_t(index)); }
    // Forgets those whose time is over.
    void expire(std::chrono::steady_clock::time_point now);
    const std::vector<Toast>& all() const { return toasts_; }
    // How many were ever added: a sleeping window has something new to show when it grows.
    uint64_t added() const { return added_; }

private:
    std::vector<Toast> toasts_;
    uint64_t added_ = 0;
};

// How long a toast stays: failures and those that offer something longer than mere notes.
std::chrono::milliseconds lifetime(const Toast& toast);

} // namespace blush
