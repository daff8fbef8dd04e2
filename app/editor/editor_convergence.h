// Convergence runs of the editor: records the error of each image, separates the runs, and writes and reads their files.
#pragma once

#include "app/editor/error_measurement.h"
#include "app/editor/reference_provider.h"
#include "render/session/submission.h"
#include "scene/document/document.h"
#include "ui/window/ui_state.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

class EditorConvergence {
public:
    EditorConvergence(std::function<void()> wake, unsigned threads)
        : measuring_(wake), reference_provider_(wake, threads), wake_(std::move(wake)) {}

    // Call with each submission of the session, in order. Starts a new run if another image begins. Its name is the last edit, or
    // `opened` (the file just opened) if that is not empty. Edits that keep the image only add a mark.
    void submit(ConvergenceView& view, const Document& document, const SubmissionPtr& next, const std::string& opened);
    // From this submission on, another image is rendered.
    void begin(ConvergenceView& view, const std::string& name, const SubmissionPtr& next);
    // From this submission on, the samples have another light mix.
    void remix(const std::string& name, const Submission& next);
    // Call once per UI frame with the newest images.
    void update(ConvergenceView& view, const Images& images);
    // Executes requests of the panel. Files are written to `folder`, named after `scene_file`.
    void handle_requests(UiState& ui, const std::filesystem::path& folder, const std::filesystem::path& scene_file);
    void load(UiState& ui, const std::filesystem::path& file);

    // True while the reference uses all cores: the live render should pause, so that its times stay correct.
    bool is_rendering_reference() const { return reference_provider_.renders(); }

private:
    void record(ConvergenceView& view, const FramePtr& frame);
    void record_denoised(ConvergenceView& view, const DenoisedPtr& image);
    void measure(ConvergenceView& view, const FramePtr& frame);
    void save(UiState& ui, ConvergenceView::Export format, const std::filesystem::path& folder, const std::filesystem::path& scene_file);

    ErrorMeasurement measuring_;
    ReferenceProvider reference_provider_;
    std::function<void()> wake_;
    uint64_t first_revision_ = 0; // of the live run
    ReferenceProvider::Subject subject_;

    SubmissionPtr submitted_; // the last one; null: none yet
    size_t steps_to_redo_ = 0;

    std::vector<std::string> marked_pilots_; // in the live run: features that they chose
    std::string remixed_by_;                 // the last edit of the mix, until its image is seen; empty: none
    FramePtr last_frame_;
    DenoisedPtr last_denoised_;
    double recording_seconds_ = 0;
    std::unique_ptr<BackgroundJob<Result<std::filesystem::path>>> save_job_;
};

} // namespace blush
