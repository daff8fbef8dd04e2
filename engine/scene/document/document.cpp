#include "scene/document/document.h"

#include "scene/document/history_memory.h"

namespace blush {
namespace {

// Copies the part of a view that navigation changes; the lens is changed by edits only.
void set_pose(View& view, const View& pose) {
    view.position = pose.position;
    view.rotation = pose.rotation;
    view.pivot_distance = pose.pivot_distance;
    view.lens.ymag = pose.lens.ymag; // dolly of an orthographic view
}

} // namespace

void Document::reset(Project project) {
    project_ = saved_ = std::move(project);
    past_.clear();
    future_.clear();
    ++revision_;
}

Result<void> Document::apply(const Edit& edit, Gesture gesture) {
    Result<Project> next = blush::apply(project_, edit);
    if (!next) return next.error();
    step_to(*std::move(next), blush::label(edit, project_), gesture);
    return {};
}

Result<void> Document::apply(std::span<const Edit> edits, const std::string& label, Gesture gesture) {
    Project next = project_;
    for (const Edit& edit : edits) {
        Result<Project> applied = blush::apply(next, edit);
        if (!applied) return applied.error();
        next = *std::move(applied);
    }
    step_to(std::move(next), label, gesture);
    return {};
}

void Document::step_to(Project next, std::string label, Gesture gesture) {
    if (next == project_) return;
    const bool continues = gesture != no_gesture && future_.empty() && !past_.empty() && past_.back().gesture == gesture;
    if (!continues) {
        past_.push_back({project_, std::move(label), gesture, bytes_held(project_, next)});
        future_.clear();
        forget_oldest();
    }
    project_ = std::move(next);
    ++revision_;
}

void Document::withdraw(Gesture gesture) {
    if (gesture == no_gesture || past_.empty() || past_.back().gesture != gesture) return;
    project_ = std::move(past_.back().project);
    past_.pop_back();
    ++revision_;
}

void Document::replace(Project project, std::string label) { step_to(std::move(project), std::move(label), no_gesture); }

void Document::forget_oldest() {
    size_t bytes = 0;
    for (const Step& step : past_) bytes += step.bytes;
    while (past_.size() > 1 && (past_.size() > limits_.steps || bytes > limits_.bytes)) {
        bytes -= past_.front().bytes;
        past_.pop_front();
    }
}

void Document::navigate(const View& view) {
    View moved = project_.scene.view;
    set_pose(moved, view);
    if (moved == project_.scene.view) return;
    project_.scene.view = moved;
    // Sets the pose in all steps, so that undo and redo do not move the camera unless the step itself did.
    for (Step& step : past_) set_pose(step.project.scene.view, view);
    for (Step& step : future_) set_pose(step.project.scene.view, view);
    set_pose(saved_.scene.view, view);
    ++revision_;
}

void Document::meter(float exposure_ev, bool from_opening) {
    const float before = project_.view.exposure_ev;
    if (exposure_ev == before) return;
    const auto follow = [&](Project& p) {
        if (p.view.exposure_ev == before) p.view.exposure_ev = exposure_ev;
    };
    if (from_opening) {
        for (Step& step : past_) follow(step.project);
        for (Step& step : future_) follow(step.project);
        follow(saved_);
    }
    project_.view.exposure_ev = exposure_ev;
    ++revision_;
}

std::string Document::undo_label() const { return past_.empty() ? std::string() : past_.back().label; }
std::string Document::redo_label() const { return future_.empty() ? std::string() : future_.back().label; }

std::vector<std::string> Document::undo_labels() const {
    std::vector<std::string> labels;
    for (const Step& step : past_) labels.push_back(step.label);
    return labels;
}

std::vector<std::string> Document::redo_labels() const {
    std::vector<std::string> labels;
    for (auto step = future_.rbegin(); step != future_.rend(); ++step) labels.push_back(step->label);
    return labels;
}

// Each step stores the project on its other side: undo and redo swap it with the current project and move the step to the other
// stack.
bool Document::travel(std::deque<Step>& from, std::deque<Step>& to) {
    if (from.empty()) return false;
    Step step = std::move(from.back());
    from.pop_back();
    std::swap(step.project, project_);
    to.push_back(std::move(step));
    ++revision_;
    return true;
}

bool Document::undo() { return travel(past_, future_); }
bool Document::redo() { return travel(future_, past_); }

void Document::mark_saved(const Project& project) {
    saved_ = project;
    set_pose(saved_.scene.view, project_.scene.view); // navigation does not modify the project
}

bool Document::modified() const { return project_ != saved_; }

} // namespace blush
