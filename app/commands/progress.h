// Progress of long work on stderr: a bar on a terminal, else plain lines.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace blush {

// "42 s", "3 min 05 s", "2 h 07 min"
std::string duration_text(double seconds);
// "[#######-------------]  35 %  1 min 02 s left  23 spp", cut to `columns`. Shows 100 % only for a fraction of 1.
std::string progress_bar(double fraction, double elapsed_seconds, std::string_view note, int columns);

class Progress {
public:
    // Checks whether stderr is a terminal.
    explicit Progress(bool quiet);
    // Clears the bar.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // Can be called often: a bar is redrawn ten times a second; a line is printed every 10 % or ten seconds.
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
