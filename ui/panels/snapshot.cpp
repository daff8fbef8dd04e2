// Snapshot: what it is called, what there is to say about it, and its file.
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>

namespace blush {
namespace {

void draw_facts(Fields& f, const Snapshot& s) {
    const Frame& frame = *s.pictures.frame;
    f.info("Kept", s.figures());
    f.info("Size", fmt::format("{} × {}", frame.width, frame.height));
    if (s.film)
        f.info("Goes on from", fmt::format("sample {}", s.film->first_sample + s.film->samples),
               "Restored, rendering goes on with these samples as if it had never stopped.");
    else
        f.info("Goes on from", "the beginning", "It was kept without its samples: restored, the same image is rendered anew.");
    if (!s.file.empty()) f.info("File", s.file.filename().string(), s.file.string().c_str());
}

} // namespace

void draw_snapshot_panel(PanelContext& c) {
    SnapshotsView& v = c.ui.snapshots;
    const SnapshotPtr s = v.find(v.details);
    if (!s) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({em * 24, 0});
    bool open = true;
    if (ImGui::Begin("Snapshot", &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
        Fields f(c.ui, "Snapshot");
        f.text("Name", s->name, "As it is called in the strip.");
        f.text("Note", s->note, "For you: what it was kept for. It goes into the file as well.");
        if (s->pictures.frame) draw_facts(f, *s);
        if (!s->no_state.empty()) quiet_text(s->no_state);
        f.checkbox("16 bits", c.ui.settings.snapshot_half, "Colours, albedo, normals and errors as half floats: smaller, with three digits.");
        f.checkbox("With samples", c.ui.settings.snapshot_film, "The file holds the exact sums, so that rendering can go on from them. Larger.");
        f.checkbox("Save each", c.ui.settings.snapshot_files, "Every new snapshot is written to a file at once; otherwise it ends with this window.");
        if (f.button("Save as EXR", "Beauty, denoised, albedo, normal, depth, error, ids, and all that restores the state.")) v.requests.push_back({SnapshotRequest::What::save, s->id});
        if (f.button("Delete", "From the strip; its file stays.")) v.remove(s->id);
    }
    ImGui::End();
    if (!open) v.details = 0;
}

} // namespace blush
