// Snapshot panel: name, note and file of a snapshot.
#include "ui/panels/panels.h"
#include "ui/snapshots/snapshot_memory.h"
#include "ui/snapshots/snapshot_strip.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <fmt/format.h>

namespace blush {
namespace {

std::string text_of_samples(const Snapshot& s) {
    if (s.film) return fmt::format("sample {}", s.film->first_sample + s.film->samples);
    return s.place == Snapshot::Place::file && s.film_in_file ? "samples in its file" : "sample 0";
}

void draw_facts(Fields& f, const Snapshot& s) {
    f.info("Contents", s.figures());
    if (s.images.frame) f.info("Size", fmt::format("{} × {}", s.images.frame->width, s.images.frame->height));
    f.info("Resumes from", text_of_samples(s),
           "After Restore, rendering continues with these samples. Without samples the image is rendered from the start.");
    if (!s.file.empty()) f.info("File", s.file.filename().string(), s.file.string().c_str());
}

void draw_memory(PanelContext& c, Fields& f, Snapshot& s) {
    constexpr double mib = 1 << 20;
    f.checkbox("Stay in memory", s.pinned,
               "Keep image and samples in memory. Otherwise they can be unloaded and are read from the file when needed.");
    f.integer("Memory, MiB", c.ui.settings.snapshot_memory, 1, int64_t(1) << 30, 2048,
              "Memory limit for all snapshots of the strip. Above it, those not used for longest are written, if they are not yet, and "
              "unloaded.");
    f.info("Used", fmt::format("{:.0f} MiB, {:.0f} by this one", double(bytes_of(c.ui.snapshots.list)) / mib, double(bytes_of(s)) / mib));
}

} // namespace

void draw_snapshot_panel(PanelContext& c) {
    SnapshotsView& v = c.ui.snapshots;
    const SnapshotPtr s = v.find(v.details);
    if (!s) return;
    Fields f(c.ui, "Snapshot");
    draw_layer_choice(f, *s, "Layer");
    bool renamed = f.text("Name", s->name, "Name in the strip.");
    renamed |= f.text("Note", s->note, "Your note. It is saved in the file.");
    if (renamed && !s->file.empty()) v.requests.push_back({SnapshotRequest::What::renamed, s->id});
    if (s->layers) {
        f.info("File", s->layers->file.filename().string(), s->layers->file.string().c_str());
        f.info("Size", fmt::format("{} × {}", s->images.frame->width, s->images.frame->height));
    } else {
        draw_facts(f, *s);
    }
    if (!s->no_state.empty()) quiet_text(s->no_state);
    ImGui::BeginDisabled(s->layers != nullptr); // the file was made by another program
    f.checkbox("16 bits", c.ui.settings.snapshot_half,
               "Colours, albedo, normals and errors as half floats: smaller files with three significant digits.");
    f.checkbox("With samples", c.ui.settings.snapshot_film,
               "Save the sums of the samples, so that rendering can be resumed. Larger files.");
    f.checkbox("Save each", c.ui.settings.snapshot_files,
               "Save every new snapshot to a file. Otherwise it is lost when the window is closed.");
    draw_memory(c, f, *s);
    if (f.button("Save as EXR", "Beauty, denoised, albedo, normal, depth, error, ids, light groups, and the state for Restore."))
        v.requests.push_back({SnapshotRequest::What::save, s->id});
    ImGui::EndDisabled();
    if (f.button("Delete", "Remove from the strip. Its file is not deleted.")) delete_snapshot(c, *s);
}

} // namespace blush
