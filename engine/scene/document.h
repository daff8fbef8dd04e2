// The project with its labelled history. Lives on the UI thread.
#pragma once

#include "scene/edit.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

namespace blush {

// Edits with the same non-zero gesture are one step of history: a whole drag of a slider.
using Gesture = uint64_t;
constexpr Gesture no_gesture = 0;

// The oldest steps are forgotten when there are more; the last one stays, whatever it weighs.
struct HistoryLimits {
    size_t steps = 500;
    size_t bytes = size_t(1) << 29;
};

class Document {
public:
    Document() = default;
    explicit Document(Project project, const HistoryLimits& limits = {}) : project_(project), saved_(std::move(project)), limits_(limits) {}

    const Project& project() const { return project_; }
    // Grows with every change of the project, undo and navigation included.
    uint64_t revision() const { return revision_; }

    // Replaces everything and forgets the history: opening a file.
    void reset(Project project);
    // An edit that changes nothing leaves no step.
    Result<void> apply(const Edit& edit, Gesture gesture = no_gesture);
    // Several edits as one step under one label; all of them, or none where one of them is refused.
    Result<void> apply(std::span<const Edit> edits, const std::string& label, Gesture gesture = no_gesture);
    // Takes back the step that a gesture has begun, if it is the last one: it leaves nothing to redo.
    void withdraw(Gesture gesture);
    // Camera navigation: changes the view's pose (position, rotation, pivot, orthographic height), not the history, and is no modification;
    // undo leaves it where it is.
    void navigate(const View& view);

    // The exposure that a picture was metered to: no step of the history. `from_opening`: as if the file had been opened with it, so that
    // earlier and later steps, and what counts as saved, have it where they had the project's own; else the project alone, so that undoing
    // the last step takes the exposure back with it.
    void meter(float exposure_ev, bool from_opening);

    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    // The label of the step that undo (redo) would take back (repeat); empty if none.
    std::string undo_label() const;
    std::string redo_label() const;
    // All of them for a history list: steps taken, oldest first; steps undone, the next to repeat first.
    std::vector<std::string> undo_labels() const;
    std::vector<std::string> redo_labels() const;
    bool undo();
    bool redo();

    // Differs from the project last marked as saved (or opened).
    bool modified() const;
    void mark_saved() { saved_ = project_; }
    // Of a project that was handed to a save that has finished since.
    void mark_saved(const Project& project);
    // Replaces everything as one step that can be undone.
    void replace(Project project, std::string label);

private:
    struct Step {
        Project project;
        std::string label;
        Gesture gesture = no_gesture;
        size_t bytes = 0; // that the step alone keeps alive, estimated
    };

    void step_to(Project next, std::string label, Gesture gesture);
    bool travel(std::deque<Step>& from, std::deque<Step>& to);
    void forget_oldest();

    Project project_;
    Project saved_;
    HistoryLimits limits_;
    std::deque<Step> past_, future_;
    uint64_t revision_ = 1;
};

} // namespace blush
