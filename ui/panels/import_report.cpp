// Import report panel: supported, approximated and ignored glTF features, and warnings with their place in the file; below them
// the warnings about the scene as it is rendered now.
#include "io/gltf/read/import.h"
#include "ui/panels/panels.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <algorithm>
#include <fmt/format.h>
#include <imgui.h>

namespace blush {
namespace {

void draw_extensions(const char* verdict, const std::vector<std::string>& names) {
    if (names.empty()) return;
    ImGui::TextUnformatted(verdict);
    for (const std::string& name : names) {
        ImGui::Bullet();
        ImGui::TextWrapped("%s", name.c_str());
    }
}

// The finding on one line, its place in the file below.
void draw_findings(PanelContext& c, const char* title, const std::vector<Diagnostic>& all, Diagnostic::Severity severity) {
    if (std::ranges::count(all, severity, &Diagnostic::severity) == 0 || !section(c.ui, title)) return;
    for (const Diagnostic& d : all) {
        if (d.severity != severity) continue;
        ImGui::TextWrapped("%s", d.what.c_str());
        if (!d.where.empty()) quiet_text(d.where);
    }
}

// Of the scene with its edits, in contrast to the file.
void draw_scene_warnings(PanelContext& c) {
    if (!c.frame || !c.frame->warnings) return;
    draw_findings(c, "Scene as rendered", *c.frame->warnings, Diagnostic::Severity::warning);
}

void draw_report(PanelContext& c, const ImportReport& report) {
    quiet_text(fmt::format("{}, read in {:.2g} s", c.ui.import_report.file, report.seconds));
    if (!report.extensions_used.empty() && section(c.ui, "Extensions")) {
        draw_extensions("Honoured", report.extensions_honoured);
        draw_extensions("Approximated", report.extensions_approximated);
        draw_extensions("Ignored", report.extensions_ignored);
    }
    draw_findings(c, "Warnings", report.diagnostics, Diagnostic::Severity::warning);
    draw_findings(c, "Notes", report.diagnostics, Diagnostic::Severity::note);
    if (report.diagnostics.empty()) quiet_text("Everything in the file is supported.");
}

} // namespace

void draw_import_report(PanelContext& c) {
    if (!c.ui.import_report.report) return quiet_text("No file opened yet.");
    draw_report(c, *c.ui.import_report.report);
    draw_scene_warnings(c);
}

} // namespace blush
