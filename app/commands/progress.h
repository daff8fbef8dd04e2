// How far long work is: a bar on a terminal, plain lines elsewhere, always on stderr.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace blush {

// "42 s", "3 min 05 s", "2 h 07 min"
std::string duration_text(double seconds);
// "[#######-------------]  35 %  1 min 02 s left  23 spp", cut to `columns`. 100 % is shown for a fraction of 1 alone.
std::string progress_bar(double fraction, double elapsed_seconds, std::string_view note, int columns);

class Progress {
public:
    // Looks whether stderr is a terminal.
    explicit Progress(bool quiet);
    // Clears the bar.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // Call as often as you like: a bar is redrawn ten times a second, a line printed every tenth of the way or ten seconds.
    void update(double fraction, std::string_view note);

private:
    using Clock = std::chrono::steady_clock;
    void print_line(double fraction, double elapsed, std::string_view note);

    bool quiet_, terminal_;
    bool drawn_ = false;
    Clock::time_point begun_ = Clock::now(), shown_at_ = begun_;
    double shown_fraction_ = 0;
};

} // namespace blush
