// The runs that are looked at side by side: the one that goes on, those that edits have ended, and stored ones. No two have the same name:
// one that is taken gets a number.
#pragma once

#include "measure/convergence.h"

#include <string>
#include <vector>

namespace blush {

struct ConvergenceRun {
    enum class Origin { live, earlier, stored };
    int id = 0; // never used again
    Origin origin = Origin::live;
    ConvergenceRecord record;
    bool shown = true;
    bool kept = false; // stays when newer ones push out the earlier ones
    size_t color = 0;  // of the plot's colours; none that another run has, while there are enough
};

class ConvergenceRuns {
public:
    static constexpr size_t most_earlier = 4;  // not counting those kept
    static constexpr size_t fewest_points = 2; // of a run that is worth remembering; they come as far apart as their cost allows

    // In the order of their beginning; the live one, if any, is the last of them, stored ones come behind it.
    const std::vector<ConvergenceRun>& all() const { return runs_; }
    const ConvergenceRun* find(int id) const;
    ConvergenceRun* find(int id);
    ConvergenceRun* live();
    const ConvergenceRun* live() const;

    // Another image is rendered from now on. The live run ends, with a mark named like what begins, unless it has too few points and is
    // not kept: of a drag that nobody waited for nothing remains. Returns the new one's id.
    int begin(const std::string& name);
    // A mark where the live run is: an edit after which it goes on.
    void mark(const std::string& label);
    void add_stored(ConvergenceRecord record);
    void rename(int id, const std::string& name); // to nothing: it keeps the one it has
    void remove(int id); // the live one cannot be removed
    void clear();        // all but the stored ones: another scene

private:
    ConvergenceRun& add(ConvergenceRun::Origin origin, ConvergenceRecord record);
    size_t free_color() const;
    std::string free_name(const std::string& name, int but_of = 0) const;

    std::vector<ConvergenceRun> runs_;
    int last_id_ = 0;
};

} // namespace blush
