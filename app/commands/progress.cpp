#include "app/commands/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
    return std::chrono::duration<double>(b - a).count();
}

int percent(double fraction) { return fraction >= 1 ? 100 : std::min(99, int(100 * std::max(0.0, fraction))); }

std::string time_left(double fraction, double elapsed) {
    // too early for a prediction
    if (fraction < 0.01 || elapsed < 0.5 || fraction >= 1) return {};
    return duration_text(elapsed * (1 - fraction) / fraction) + " left";
}

int terminal_columns() {
    winsize size = {};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

} // namespace

std::string duration_text(double seconds) {
    const int64_t s = int64_t(std::ceil(std::clamp(seconds, 0.0, 1e9)));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
    return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

std::string progress_bar(double fraction, double elapsed_seconds, std::string_view note, int columns) {
    constexpr int cells = 20;
    const int full = percent(fraction) * cells / 100;
    std::string text = fmt::format("[{:#<{}}{:-<{}}] {:3} %", "", full, "", cells - full, percent(fraction));
    if (const std::string left = time_left(fraction, elapsed_seconds); !left.empty()) text += "  " + left;
    if (!note.empty()) text += fmt::format("  {}", note);
    return text.substr(0, size_t(std::max(columns, 0)));
}

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (drawn_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(double fraction, std::string_view note) {
    if (quiet_) return;
    const Clock::time_point now = Clock::now();
    const double elapsed = seconds_between(begun_, now), since_shown = seconds_between(shown_at_, now);
    if (terminal_) {
        if (drawn_ && since_shown < 0.1 && fraction < 1) return;
        fmt::print(stderr, "\r\033[K{}", progress_bar(fraction, elapsed, note, terminal_columns() - 1));
        std::fflush(stderr);
        drawn_ = true;
    } else {
        if (since_shown < 1 || (fraction < shown_fraction_ + 0.1 && since_shown < 10)) return;
        print_line(fraction, elapsed, note);
    }
    shown_at_ = now;
    shown_fraction_ = fraction;
}

void Progress::print_line(double fraction, double elapsed, std::string_view note) {
    const std::string left = time_left(fraction, elapsed);
    fmt::print(stderr, "blush: {} %{}{}, {}\n", percent(fraction), left.empty() ? "" : ", ", left, note);
}

} // namespace blush
