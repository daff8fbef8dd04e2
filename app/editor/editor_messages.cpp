#include "app/editor/editor_messages.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace blush {
namespace {

constexpr const char* where_to_find = "File > Import report lists all warnings";

void show(const std::vector<Diagnostic>& warnings, Toasts& toasts) {
    constexpr size_t max_listed = 4;
    const auto text_of = [](const Diagnostic& d) { return Error{{}, d.what, d.where}.text(); };
    if (warnings.empty()) return;
    if (warnings.size() == 1) return toasts.warn(text_of(warnings[0]), where_to_find);
    std::string details;
    for (size_t i = 0; i < std::min(warnings.size(), max_listed); ++i) details += text_of(warnings[i]) + "\n";
    if (warnings.size() > max_listed) details += fmt::format("and {} more\n", warnings.size() - max_listed);
    toasts.warn(fmt::format("{} warnings about the scene", warnings.size()), details + where_to_find);
}

} // namespace

void EditorMessages::update(const Frame& frame, const Scene& scene, Toasts& toasts) {
    if (frame.warnings && frame.warnings != known_) {
        std::vector<Diagnostic> fresh;
        for (const Diagnostic& d : *frame.warnings)
            if (!known_ || std::ranges::count(*known_, d) == 0) fresh.push_back(d);
        known_ = frame.warnings;
        show(fresh, toasts);
    }
    // Every pixel's first hits, of enough samples that thin objects are among them.
    constexpr int64_t enough_samples = 4;
    if (!checks_visible_objects_ || frame.divider != 1 || (frame.samples < enough_samples && !frame.complete)) return;
    checks_visible_objects_ = false;
    const bool sees_one = frame.depth.empty() || std::ranges::any_of(frame.depth, [](float depth) { return depth > 0; });
    if (!sees_one && !scene.meshes.empty())
        toasts.add(
            {Toast::Kind::warning, "The camera sees no object of the scene", "The image shows only the background.", Command::frame_all});
}

void EditorMessages::update(const SessionStatus& status, UiState& ui) {
    if (std::exchange(last_not_continued_, status.restart_reason) != status.restart_reason && !status.restart_reason.empty())
        ui.toasts.warn("The snapshot is rendered from the start", status.restart_reason);
    const std::string& failure = status.denoiser_failure;
    if (failure.empty() || !ui.denoise.wants_denoised()) return;
    ui.denoise.show = DenoiseView::Show::raw;
    ui.toasts.fail("The image cannot be denoised", failure);
}

} // namespace blush
