#include "app/editor/editor_convergence.h"

#include "app/common/unique_filename.h"
#include "app/editor/run_name.h"
#include "core/files.h"
#include "io/image/image_io.h"
#include "measure/convergence/convergence_csv.h"
#include "measure/plot/plot_svg.h"
#include "ui/views/convergence_image.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;
using Kind = ConvergencePoint::Kind;

constexpr uint64_t max_table_bytes = uint64_t(8) << 20; // bytes

std::vector<ConvergenceRecord> shown_records(const ConvergenceRuns& runs) {
    std::vector<ConvergenceRecord> records;
    for (const ConvergenceRun& r : runs.all())
        if (r.shown && !r.record.points().empty()) records.push_back(r.record);
    return records;
}

// The features that pilots have switched on for this image, "Pilots: light paths, path reuse"; empty: none, or they have not run.
// Names what pilots chose and is not in `marked`, and adds it there; empty: nothing.
std::string pilots_label(const Frame& frame, std::vector<std::string>& marked) {
    std::string names;
    if (frame.feature_report)
        for (const FeatureUse& use : *frame.feature_report)
            if (use.pilot && use.used && std::find(marked.begin(), marked.end(), use.name) == marked.end()) {
                names += (names.empty() ? "Pilots: " : ", ") + use.name;
                marked.push_back(use.name);
            }
    return names;
}

} // namespace

void EditorConvergence::submit(ConvergenceView& view, const Document& document, const SubmissionPtr& next, const std::string& opened) {
    const size_t steps_to_redo = document.redo_labels().size();
    const bool undone = steps_to_redo > std::exchange(steps_to_redo_, steps_to_redo);
    const SubmissionPtr last = std::exchange(submitted_, next);
    if (!opened.empty() || !last) {
        view.runs.clear();
        return begin(view, opened, next);
    }
    const Changes& changes = next->changes;
    if (changes.affects_image()) {
        const std::string name = run_name({last->scene, last->settings}, {next->scene, next->settings}, changes, document, undone);
        next->continues_image ? remix(name, *next) : begin(view, name, next);
    } else if (!last->planes.covers(next->planes)) {
        begin(view, "Other layers", next);
    } else if (changes.stop_rules) {
        view.runs.mark("Stop rules");
    }
}

void EditorConvergence::begin(ConvergenceView& view, const std::string& name, const SubmissionPtr& next) {
    submitted_ = next;
    first_revision_ = next->revision;
    subject_ = {next->scene, next->settings};
    remixed_by_.clear();
    marked_pilots_.clear();
    recording_seconds_ = 0;
    view.cost = {};
    measuring_.begin(view.runs.begin(name));
    reference_provider_.forget();
}

// The same samples with other weights: earlier errors, and the reference, belong to another image.
void EditorConvergence::remix(const std::string& name, const Submission& next) {
    first_revision_ = next.revision;
    subject_.scene = next.scene;
    remixed_by_ = name;
    measuring_.forget_images();
    reference_provider_.forget();
}

void EditorConvergence::update(ConvergenceView& view, const Images& images) {
    const auto begin = Clock::now();
    const FramePtr& frame = images.frame;
    // The error of a coarse image is not comparable.
    const bool ours = frame && frame->revision >= first_revision_ && frame->divider == 1 && view.runs.live();
    if (ours && frame != last_frame_) record(view, frame);
    if (ours && images.denoised && images.denoised != last_denoised_) record_denoised(view, images.denoised);
    last_frame_ = frame;
    last_denoised_ = images.denoised;
    recording_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
    measure(view, ours ? frame : nullptr);
    if (ours) view.cost = {frame->error_seconds, recording_seconds_, measuring_.seconds(), frame->seconds};
}

void EditorConvergence::record(ConvergenceView& view, const FramePtr& frame) {
    ConvergenceRecord& record = view.runs.live()->record;
    const ConvergencePoint point = estimated_point(*frame);
    const bool known = point.rmse.known || point.relmse.known, remixed = !remixed_by_.empty();
    // Adds a point when a run ends or the mix changes, even if none is due.
    if (known && (frame->complete || remixed))
        record.set(point);
    else if (known)
        record.add(point);
    if (frame->samples > 1) // most pilots run before the second sample, that of roulette before the fifth
        if (std::string label = pilots_label(*frame, marked_pilots_); !label.empty())
            record.mark({frame->seconds, frame->samples, std::move(label)});
    if (known && remixed) record.mark({point.seconds, point.spp, std::exchange(remixed_by_, {}), true});
    if (view.reference && reference_provider_.reference() && (frame->complete || record.is_due(Kind::measured, frame->samples)))
        measuring_.add_raw(frame);
}

void EditorConvergence::record_denoised(ConvergenceView& view, const DenoisedPtr& image) {
    if (!view.denoised || image->revision < first_revision_ || image->divider != 1) return;
    measuring_.add_denoised(image);
}

void EditorConvergence::measure(ConvergenceView& view, const FramePtr& frame) {
    const ConvergenceRun* live = view.runs.live();
    // Not while a drag changes the image: each key would read the whole scene.
    const bool settled = live && live->record.points(Kind::estimated).size() >= ConvergenceRuns::min_points;
    if (view.open && view.reference && settled && frame) {
        subject_.settings.width = frame->width;
        subject_.settings.height = frame->height;
        subject_.settings.resolution_scale = 1;
        reference_provider_.find(subject_);
    }
    if (reference_provider_.poll() && frame) measuring_.add_raw(frame);
    measuring_.poll(view.runs, view.reference ? reference_provider_.reference() : nullptr, frame);
    view.reference_status = reference_provider_.status();
    view.waiting = live ? measuring_.waiting(live->record) : 0;
}

void EditorConvergence::handle_requests(UiState& ui, const std::filesystem::path& folder, const std::filesystem::path& scene_file) {
    ConvergenceView& view = ui.convergence;
    using Request = ConvergenceView::ReferenceRequest;
    const Request request = std::exchange(view.wanted_reference, Request::none);
    if (request == Request::stop) reference_provider_.stop();
    if (request == Request::render && last_frame_) reference_provider_.render(subject_, std::max<int64_t>(64, 2 * last_frame_->samples));
    if (reference_provider_.renders()) ui.seconds_to_next_frame = std::min(ui.seconds_to_next_frame, 0.2);
    if (const auto format = std::exchange(view.wanted_export, std::nullopt)) save(ui, *format, folder, scene_file);
    if (!save_job_) return;
    if (const auto saved = save_job_->take()) {
        save_job_.reset();
        if (*saved)
            ui.toasts.note("Saved " + (*saved)->filename().string(), (*saved)->parent_path().string());
        else
            ui.toasts.fail(saved->error().text());
    }
}

// Drawn here, because ImGui is on this thread; written in the background.
void EditorConvergence::save(UiState& ui, ConvergenceView::Export format, const std::filesystem::path& folder,
                             const std::filesystem::path& scene_file) {
    const std::vector<ConvergenceRecord> records = shown_records(ui.convergence.runs);
    if (records.empty()) return ui.toasts.warn("No convergence data to save yet");
    std::function<Result<void>(const std::filesystem::path&)> write;
    const char* extension = "";
    const ConvergencePlot chart = export_chart(ui.convergence, scene_file.filename().string());
    switch (format) {
    case ConvergenceView::Export::csv:
        extension = ".csv";
        write = [text = to_csv(records)](const auto& file) { return write_file(file, text); };
        break;
    case ConvergenceView::Export::svg:
        extension = ".svg";
        write = [text = to_svg(chart.plot)](const auto& file) { return write_file(file, text); };
        break;
    case ConvergenceView::Export::png:
        extension = ".png";
        write = [image = draw_chart_image(chart.plot)](const auto& file) {
            return write_display_image(file, image.width, image.height, image.rgb);
        };
        break;
    }
    save_job_ = std::make_unique<BackgroundJob<Result<std::filesystem::path>>>(
        "Saving the chart",
        [=, stem = scene_file.stem().string() + "-convergence"](JobProgress&) -> Result<std::filesystem::path> {
            const auto file = unique_filename(folder, stem, extension);
            if (!file) return file;
            if (const auto written = write(*file); !written) return written.error();
            return *file;
        },
        wake_);
}

void EditorConvergence::load(UiState& ui, const std::filesystem::path& file) {
    const auto bytes = read_file(file, max_table_bytes);
    if (!bytes) return ui.toasts.fail(bytes.error().text());
    auto records = parse_convergence_csv({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!records) return ui.toasts.fail(file.filename().string() + ": " + records.error().text());
    for (ConvergenceRecord& r : *records) ui.convergence.runs.add_stored(std::move(r));
    ui.convergence.open = true;
}

} // namespace blush
