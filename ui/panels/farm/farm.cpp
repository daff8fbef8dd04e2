// Farm panel: makes plans from the open scene, starts and stops them, and shows how they stand.
#include "ui/panels/panels.h"
#include "ui/widgets/elided_text.h"
#include "ui/widgets/tooltip.h"
#include "ui/widgets/widgets.h"
#include "ui/widgets/wrapped_text.h"
#include "ui/window/theme.h"
#include "ui/window/time_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

using What = FarmChoices::What;
using Where = FarmChoices::Where;

constexpr size_t shown_failures = 2; // of a plan

void draw_animation_range(PanelContext& c, Fields& f, FarmChoices& choices) {
    f.integer("First frame", choices.first_frame, 0, 1000000, 0, "Frames are counted from 0, at the start of the animation.");
    f.integer("Last frame", choices.last_frame, choices.first_frame, choices.first_frame + 99999, 0, "This frame is rendered, too.");
    f.number("Frame rate", choices.frames_per_second,
             {.min = 0.01f, .max = 1000, .reset = 24, .unit = "fps", .tip = "Frames per second of the animation and of the film."});
    choices.last_frame = std::max(choices.last_frame, choices.first_frame);
    if (c.scene().clips.empty()) quiet_text("The scene has no animation.");
}

void draw_what(PanelContext& c, Fields& f, FarmChoices& choices) {
    int what = int(choices.what);
    if (f.choice("Render", what, FarmChoices::what_names,
                 "What the plan renders. All but snapshots begin with the scene as it is now, with its edits."))
        choices.what = What(what);
    if (choices.what == What::turntable)
        f.integer("Images", choices.steps, 2, 100000, 48, "The camera goes once around the centre of the scene, about the vertical.");
    if (choices.what == What::animation) draw_animation_range(c, f, choices);
    if (choices.what != What::looks) return;
    if (f.button("Choose file...", "looks.json: overrides and a matrix of them, as in the guide."))
        c.ui.commands.push_back(Command::farm_looks);
    if (!choices.looks_file.empty()) f.info("File", choices.looks_file.filename().string(), choices.looks_file.string().c_str());
}

float image_aspect(const PanelContext& c) {
    return c.ui.frame.aspect > 0 ? c.ui.frame.aspect : float(c.render_width) / float(std::max(c.render_height, 1));
}

void draw_quality(PanelContext& c, Fields& f, FarmChoices& choices) {
    f.integer("Width", choices.width, 1, 65536, 1920, "Pixels. The height follows from the aspect ratio of each image.");
    if (choices.what == What::view) {
        const double height = std::max(1.0, std::round(double(choices.width) / double(image_aspect(c))));
        f.info("", fmt::format("{} × {:.0f} pixels", choices.width, height));
    }
    static constexpr const char* stops[] = {"Samples", "Error"};
    int by_error = choices.by_error;
    if (f.choice("Stop at", by_error, stops,
                 "A number of samples per pixel; or an estimated error, in rounds: after each round the images that are not good enough "
                 "get more samples."))
        choices.by_error = by_error != 0;
    if (choices.by_error)
        f.number("Error", choices.error_per_cent,
                 {.min = 1e-6f,
                  .max = 100,
                  .reset = 0.01f,
                  .unit = "%",
                  .step = 0.001f,
                  .tip = "Upper end of the 95 % interval of the estimated relative mean squared error (relMSE)."});
    f.integer(choices.by_error ? "At most" : "Samples", choices.spp, 1, int64_t(1) << 30, 1024, "Samples per pixel.");
    f.checkbox("Adaptive", choices.adaptive,
               "Adaptive sampling: noisy pixels get more samples. It takes two rounds: a pilot, then the samples that it allocates.");
}

void draw_where(Fields& f, FarmView& view) {
    static constexpr const char* places[] = {"This machine", "Slurm"};
    int where = int(view.choices.where);
    if (view.has_slurm) {
        if (f.choice("Where", where, places, "Start runs the plan here, or submits it to Slurm as job arrays."))
            view.choices.where = Where(where);
    } else {
        view.choices.where = Where::here;
        f.info("Where", places[0], "Slurm is offered where sbatch is installed. The plan also has lists of commands for other schedulers.");
    }
    if (view.choices.where == Where::slurm)
        f.text("Options", view.choices.slurm_options, "Options of sbatch, such as --partition=farm --cpus-per-task=16.");
    else
        f.integer("Processes", view.choices.processes, 0, 1024, 0, "They share the processors. 0: one for each socket.");
}

// Why no plan can be made; empty: one can.
std::string obstacle(const PanelContext& c, const FarmView& view) {
    const FarmChoices& choices = view.choices;
    const auto& nodes = c.scene().nodes.entries();
    const bool has_camera = std::ranges::any_of(nodes, [](const auto& node) { return bool(node.value.camera); });
    if (view.is_making()) return "Another plan is being made.";
    if (choices.what == What::snapshots && saved_snapshots(c.ui.snapshots, view).empty())
        return "No snapshot in the strip is saved as a file. Take one with F12.";
    if (choices.what == What::animation && c.scene().clips.empty()) return "The scene has no animation.";
    if (choices.what == What::cameras && !has_camera) return "The scene has no camera.";
    if (choices.what == What::variants && c.scene().variants.empty()) return "The scene has no material variants.";
    if (choices.what == What::looks && choices.looks_file.empty()) return "Choose the file with the looks.";
    return {};
}

void draw_new_plan(PanelContext& c, FarmView& view) {
    Fields f(c.ui, "Farm");
    draw_what(c, f, view.choices);
    draw_quality(c, f, view.choices);
    f.info("Folder in", view.parent.filename().string(), view.parent.string().c_str());
    const std::string why_not = obstacle(c, view);
    ImGui::BeginDisabled(!why_not.empty());
    if (f.button("Make plan", "Measures what a sample costs for a few seconds, cuts the images into tasks, and writes the plan into a new "
                              "folder. Nothing is rendered yet."))
        view.requests.push_back({FarmRequest::What::make, {}});
    ImGui::EndDisabled();
    if (why_not.empty()) return;
    quiet_text(why_not);
    c.ui.probe.record_last_item("Farm/No plan");
}

// ---- plans

const char* state_name(const FarmPlan& plan) {
    switch (plan.state) {
    case FarmPlan::State::unread: return "being read";
    case FarmPlan::State::making: return "being made";
    case FarmPlan::State::stopped: return plan.fraction > 0 ? "stopped" : "ready";
    case FarmPlan::State::running: return "running";
    case FarmPlan::State::finished: return "finished";
    case FarmPlan::State::unreadable: return "failed";
    }
    return "";
}

std::string size_text(double mib) { return mib < 1024 ? fmt::format("{:.0f} MiB", std::ceil(mib)) : fmt::format("{:.1f} GiB", mib / 1024); }

// What the plan will cost, before it begins.
std::string expectation(const FarmPlan& plan) {
    std::string text = fmt::format("{} images in {} tasks, {} on disk. About {} on this machine", plan.looks.size(), plan.tasks,
                                   size_text(plan.disk_mib), guessed_time_text(plan.seconds_here));
    if (plan.knee > 1) text += fmt::format(", {} on {} like it; more hardly help", guessed_time_text(plan.seconds_knee), plan.knee);
    return text + ".";
}

std::string image_text(const FarmPlan& plan) {
    if (plan.looks.size() == 1) {
        const FarmLook& look = plan.looks.front();
        if (look.merged == 0) return {};
        return fmt::format("{} of {} spp in the strip, relMSE {}", look.merged, look.planned,
                           look.error.empty() ? "not known" : look.error);
    }
    const auto merged = std::ranges::count_if(plan.looks, [](const FarmLook& look) { return look.merged > 0; });
    const auto complete = std::ranges::count_if(plan.looks, [](const FarmLook& look) { return look.merged >= look.planned; });
    return merged == 0 ? std::string() : fmt::format("{} of {} images complete, {} begun", complete, plan.looks.size(), merged - complete);
}

void draw_buttons(PanelContext& c, const FarmPlan& plan) {
    using Request = FarmRequest::What;
    using State = FarmPlan::State;
    bool first = true;
    const auto button = [&](const char* label, Request what, const char* tip) {
        if (!std::exchange(first, false)) same_line_if_fits(ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x);
        if (ImGui::Button(label)) c.ui.farm.requests.push_back({what, plan.folder});
        c.ui.probe.record_last_item(fmt::format("Farm/{}/{}", plan.folder.filename().string(), label));
        tip_for_last_item(c.ui, tip);
    };
    if (plan.state == State::stopped)
        button(plan.fraction > 0 ? "Continue" : "Start", Request::start,
               "Renders what is missing, where chosen above. Closing the window does not stop it.");
    if (plan.state == State::running) button("Stop", Request::stop, "Ends its processes or jobs. Samples so far are kept.");
    if (plan.state == State::making) return button("Cancel", Request::stop, "Ends the measurement and removes the folder.");
    if (plan.state != State::unreadable) button("Open", Request::open, "Opens the contact sheet if there is one, else the folder.");
    if (plan.state != State::running) button("Forget", Request::forget, "Takes the plan off this list. Its files stay in the folder.");
}

void draw_plan(PanelContext& c, const FarmPlan& plan) {
    const std::string name = plan.folder.filename().string();
    ImGui::PushID(plan.folder.c_str());
    const bool failed = plan.state == FarmPlan::State::unreadable;
    const std::string state = state_name(plan);
    const float state_width = ImGui::CalcTextSize(state.c_str()).x + ImGui::GetFontSize();
    elided_text(c.ui, name, tone::text, ImGui::GetContentRegionAvail().x - state_width);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - state_width + ImGui::GetFontSize());
    elided_text(c.ui, state, failed ? tone::failure : tone::dim_text);
    c.ui.probe.record_last_item(fmt::format("Farm/{}/is {}", name, state));
    if (plan.state == FarmPlan::State::running || plan.state == FarmPlan::State::stopped)
        ImGui::ProgressBar(float(plan.fraction), {-FLT_MIN, 0},
                           plan.state == FarmPlan::State::running ? progress_text(plan).c_str()
                                                                  : fmt::format("{:.0f} %", std::floor(100 * plan.fraction)).c_str());
    if (plan.state == FarmPlan::State::stopped && plan.fraction == 0) quiet_text(expectation(plan));
    if (const std::string text = image_text(plan); !text.empty()) quiet_text(text);
    if (!plan.problem.empty()) wrapped_text(plan.problem);
    for (size_t i = 0; i < std::min(plan.failures.size(), shown_failures); ++i) wrapped_text(plan.failures[i]);
    if (plan.failures.size() > shown_failures) quiet_text(fmt::format("and {} more failed tasks", plan.failures.size() - shown_failures));
    draw_buttons(c, plan);
    ImGui::Spacing();
    ImGui::PopID();
}

} // namespace

void draw_farm_panel(PanelContext& c) {
    FarmView& view = c.ui.farm;
    if (section(c.ui, "New plan")) draw_new_plan(c, view);
    if (section(c.ui, "Start on")) {
        Fields f(c.ui, "Farm");
        draw_where(f, view);
    }
    if (!section(c.ui, "Plans")) return;
    if (view.plans.empty()) quiet_text("There is no plan of this scene yet.");
    for (size_t i = view.plans.size(); i-- > 0;) draw_plan(c, view.plans[i]);
}

} // namespace blush
