// Convergence runs for comparison: the live run, earlier ones that edits have ended, and stored ones. Names are made unique with
// a number.
#pragma once

#include "measure/convergence/convergence.h"

#include <string>
#include <vector>

namespace blush {

struct ConvergenceRun {
    enum class Origin { live, earlier, stored };
    int id = 0; // never reused
    Origin origin = Origin::live;
    ConvergenceRecord record;
    bool shown = true;
    bool kept = false; // not removed by newer runs
    size_t color = 0;  // index of the plot colour; unique while there are enough colours
};

class ConvergenceRuns {
public:
    static constexpr size_t max_earlier = 4; // not counting kept runs
    static constexpr size_t min_points = 2;  // runs with fewer points are dropped

    // In order of creation; the live run comes after earlier runs, stored runs come last.
    const std::vector<ConvergenceRun>& all() const { return runs_; }
    const ConvergenceRun* find(int id) const;
    ConvergenceRun* find(int id);
    ConvergenceRun* live();
    const ConvergenceRun* live() const;

    // Starts a new live run, when another image is rendered. The previous one ends with a mark of the new name; it is dropped if
    // it has too few points and is not kept, as during a drag. Returns the new id.
    int begin(const std::string& name);
    // Adds a mark to the live run, for an edit that does not end it.
    void mark(const std::string& label);
    void add_stored(ConvergenceRecord record);
    void rename(int id, const std::string& name); // an empty name is ignored
    void remove(int id);                          // the live one cannot be removed
    void clear();                                 // removes all except stored runs, for another scene

private:
    ConvergenceRun& add(ConvergenceRun::Origin origin, ConvergenceRecord record);
    size_t free_color() const;
    std::string unique_name(const std::string& name, int but_of = 0) const;

    std::vector<ConvergenceRun> runs_;
    int last_id_ = 0;
};

} // namespace blush
