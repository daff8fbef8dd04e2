#include "app/editor/run_name.h"

#include <fmt/format.h>

namespace blush {
namespace {

// True if only the pose differs, or the height of an orthographic view.
bool is_navigation(const Scene& before, const Scene& after, Changes changes) {
    changes.view = false;
    if (changes.affects_image()) return false;
    Lens lens = before.view.lens;
    lens.ymag = after.view.lens.ymag;
    return lens == after.view.lens;
}

} // namespace

std::string settings_difference(const RenderSettings& before, const RenderSettings& after) {
    std::string text;
    const auto add = [&](bool differs, const auto& what) {
        if (differs) text += fmt::format("{}{}", text.empty() ? "" : ", ", what);
    };
    const auto on_off = [](const char* name, bool on) { return fmt::format("{} {}", name, on ? "on" : "off"); };
    add(before.max_bounces != after.max_bounces, "Bounces " + max_bounces_text(after.max_bounces));
    add(before.roulette != after.roulette, "Roulette " + to_string(after.roulette));
    add(before.strategy != after.strategy, fmt::format("Strategy {}", to_string(after.strategy)));
    add(before.caustics != after.caustics, fmt::format("Caustics {}", to_string(after.caustics)));
    add(before.filter != after.filter, fmt::format("Filter {}", to_string(after.filter)));
    add(before.adaptive != after.adaptive, on_off("Adaptive sampling", after.adaptive));
    add(before.reuse != after.reuse, fmt::format("Path reuse {}", reuse_text(after.reuse)));
    add(before.smooth_edges != after.smooth_edges, on_off("Smooth edges", after.smooth_edges));
    add(before.clamp != after.clamp, "Clamp " + to_string(after.clamp));
    add(before.mis_compensation != after.mis_compensation, on_off("MIS compensation", after.mis_compensation));
    add(before.energy_compensation != after.energy_compensation, on_off("Energy compensation", after.energy_compensation));
    add(before.seed != after.seed, fmt::format("Seed {}", after.seed));
    return text;
}

std::string run_name(const RunState& before, const RunState& after, const Changes& changes, const Document& document, bool undone) {
    if (changes.integrator) {
        if (std::string text = settings_difference(before.settings, after.settings); !text.empty()) return text;
    }
    if (changes.resolution) return fmt::format("Size {} × {}", after.settings.width, after.settings.height);
    if (is_navigation(before.scene, after.scene, changes)) return "Camera moved";
    const std::string step = undone ? document.redo_label() : document.undo_label();
    if (step.empty()) return "Edit";
    return undone ? "Undo: " + step : step;
}

} // namespace blush
