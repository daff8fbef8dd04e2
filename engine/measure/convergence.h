// Error against run time: what is recorded while a picture converges, and what a series of such records says.
#pragma once

#include "measure/intervals.h"

#include <cstdint>
#include <string>
#include <vector>

namespace blush {

// The error of a picture at one moment, estimated or measured against a reference.
struct ConvergencePoint {
    double seconds = 0; // of rendering, measuring not included
    int64_t spp = 0;
    double relmse = 0, low = 0, high = 0; // low = high = relmse where no interval is known
    double rmse = 0;
    bool denoised = false;
};

// A moment worth a mark in the plot: an edit, a change of settings.
struct ConvergenceMark {
    double seconds = 0;
    std::string label;
};

// One curve. Points are kept when the samples have grown by a tenth since the last one of their kind: evenly in a log-log plot, and about
// two hundred of them however long it runs.
class ConvergenceRecord {
public:
    std::string name;

    // False if the point was left out.
    bool add(const ConvergencePoint& point);
    void mark(const ConvergenceMark& mark) { marks_.push_back(mark); }
    void clear();

    const std::vector<ConvergencePoint>& points() const { return points_; }
    const std::vector<ConvergenceMark>& marks() const { return marks_; }
    // RMSE against seconds, or samples, of the raw or of the denoised picture.
    PowerFit fit_seconds(bool denoised = false) const;
    PowerFit fit_spp(bool denoised = false) const;

private:
    std::vector<ConvergencePoint> points_;
    std::vector<ConvergenceMark> marks_;
};

// Seconds from the last point until relmse is `target`, as the fitted slope goes on; 0 if it is there already, negative if that cannot be
// told.
double seconds_left(const ConvergenceRecord& record, double target);

// name,seconds,spp,relmse,low,high,rmse,denoised; one line per point.
std::string to_csv(const std::vector<ConvergenceRecord>& records);

// A name as one field of a CSV line.
std::string csv_field(const std::string& text);

// ---- fair measuring of several settings side by side

// Whose turn it is: the one that has rendered for the shortest time among those not done, so that whatever slows the machine down slows all
// alike. `seconds` so far; -1 for those that are done. -1 if all are.
int next_turn(const std::vector<double>& seconds);

// When to look at the error: first when something is there, then whenever time has doubled.
class DoublingTimes {
public:
    // True if now, at this much time, it is due; the next is then due at twice that.
    bool due(double seconds);

private:
    double next_ = 0;
};

} // namespace blush
