// Snapshot: what it is called, what there is to say about it, and its file.
#include "ui/panels/panels.h"
#include "ui/snapshot_memory.h"
#include "ui/snapshot_strip.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#include <fmt/format.h>

namespace blush {
namespace {

std::string text_of_samples(const Snapshot& s) {
    if (s.film) return fmt::format("sample {}", s.film->first_sample + s.film->samples);
    return s.place == Snapshot::Place::file && s.film_in_file ? "its samples in the file" : "the beginning";
}

void draw_facts(Fields& f, const Snapshot& s) {
    f.info("Kept", s.figures());
    if (s.pictures.frame) f.info("Size", fmt::format("{} × {}", s.pictures.frame->width, s.pictures.frame->height));
    f.info("Goes on from", text_of_samples(s),
           "Restored, rendering goes on with these samples as if it had never stopped. Without samples the same image is rendered anew.");
    if (!s.file.empty()) f.info("File", s.file.filename().string(), s.file.string().c_str());
}

void draw_memory(PanelContext& c, Fields& f, Snapshot& s) {
    constexpr double mib = 1 << 20;
    f.checkbox("Stay in memory", s.pinned, "Otherwise its picture and samples may live in its file alone, and are read again when they are wanted.");
    f.integer("Memory, MiB", c.ui.settings.snapshot_memory, 1, int64_t(1) << 30, 2048,
              "What all snapshots of the strip may take. Those not used for longest are then written, if they are not yet, and kept in their "
              "files alone.");
    f.info("Taken", fmt::format("{:.0f} MiB, {:.0f} by this one", double(bytes_of(c.ui.snapshots.list)) / mib, double(bytes_of(s)) / mib));
}

} // namespace

void draw_snapshot_panel(PanelContext& c) {
    SnapshotsView& v = c.ui.snapshots;
    const SnapshotPtr s = v.find(v.details);
    if (!s) return;
    Fields f(c.ui, "Snapshot");
    draw_layer_choice(f, *s, "Layer");
    bool renamed = f.text("Name", s->name, "As it is called in the strip.");
    renamed |= f.text("Note", s->note, "For you: what it was kept for. It goes into the file as well.");
    if (renamed && !s->file.empty()) v.requests.push_back({SnapshotRequest::What::renamed, s->id});
    if (s->layers) {
        f.info("File", s->layers->file.filename().string(), s->layers->file.string().c_str());
        f.info("Size", fmt::format("{} × {}", s->pictures.frame->width, s->pictures.frame->height));
    } else {
        draw_facts(f, *s);
    }
    if (!s->no_state.empty()) quiet_text(s->no_state);
    ImGui::BeginDisabled(s->layers != nullptr); // the file is another program's
    f.checkbox("16 bits", c.ui.settings.snapshot_half, "Colours, albedo, normals and errors as half floats: smaller, with three digits.");
    f.checkbox("With samples", c.ui.settings.snapshot_film,
               "The file holds the exact sums, so that rendering can go on from them. Larger.");
    f.checkbox("Save each", c.ui.settings.snapshot_files,
               "Every new snapshot is written to a file at once; otherwise it ends with this window.");
    draw_memory(c, f, *s);
    if (f.button("Save as EXR", "Beauty, denoised, albedo, normal, depth, error, ids, light groups, and all that restores the state."))
        v.requests.push_back({SnapshotRequest::What::save, s->id});
    ImGui::EndDisabled();
    if (f.button("Delete", "From the strip; its file stays.")) delete_snapshot(c, *s);
}

} // namespace blush
