// The project with its undo history. Used on the UI thread only.
#pragma once

#include "scene/document/edit.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

namespace blush {

// Edits with the same non-zero gesture form one undo step: for example one drag of a slider.
using Gesture = uint64_t;
constexpr Gesture no_gesture = 0;

// Above these limits the oldest undo steps are dropped; the last step is kept whatever its size.
struct HistoryLimits {
    size_t steps = 500;
    size_t bytes = size_t(1) << 29;
};

class Document {
public:
    Document() = default;
    explicit Document(Project project, const HistoryLimits& limits = {}) : project_(project), saved_(std::move(project)), limits_(limits) {}

    const Project& project() const { return project_; }
    // Incremented by every change of the project, including undo and navigation.
    uint64_t revision() const { return revision_; }

    // Replaces the project and clears the history, as when a file is opened.
    void reset(Project project);
    // Applies an edit as an undo step. An edit that changes nothing makes no step. Errors: as of apply() in edit.h.
    Result<void> apply(const Edit& edit, Gesture gesture = no_gesture);
    // Applies several edits as one undo step with one label. If one fails, none is applied.
    Result<void> apply(std::span<const Edit> edits, const std::string& label, Gesture gesture = no_gesture);
    // Reverts the step that a gesture has begun, if it is the last one. It cannot be redone.
    void withdraw(Gesture gesture);
    // Camera navigation: sets the view's pose (position, rotation, pivot, orthographic height). Makes no undo step, does not mark
    // the project as modified, and undo does not revert it.
    void navigate(const View& view);

    // Sets the exposure that auto exposure metered, without an undo step. `from_opening`: all steps and the saved project that
    // have the current exposure get the new one, as if the file had been opened with it. Otherwise only the current project gets
    // it, and undoing the last step reverts it.
    void meter(float exposure_ev, bool from_opening);

    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    // Label of the step that undo would revert (redo would repeat); empty if there is none.
    std::string undo_label() const;
    std::string redo_label() const;
    // All labels for a history list: done steps, oldest first; undone steps, the next to redo first.
    std::vector<std::string> undo_labels() const;
    std::vector<std::string> redo_labels() const;
    bool undo();
    bool redo();

    // True if the project differs from the one last saved or opened.
    bool modified() const;
    void mark_saved() { saved_ = project_; }
    // Marks a project as saved that was passed to a background save.
    void mark_saved(const Project& project);
    // Replaces the project as one undo step.
    void replace(Project project, std::string label);

private:
    struct Step {
        Project project;
        std::string label;
        Gesture gesture = no_gesture;
        size_t bytes = 0; // estimate of the memory that only this step holds
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
