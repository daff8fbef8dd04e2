// What the editor does for the Convergence panel: records each picture's error, keeps the runs apart, and writes and reads their files.
#pragma once

#include "app/error_measuring.h"
#include "app/reference_keeper.h"
#include "scene/document.h"
#include "ui/ui_state.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace blush {

class EditorConvergence {
public:
    EditorConvergence(std::function<void()> wake, unsigned threads) : measuring_(wake), keeper_(wake, threads), wake_(std::move(wake)) {}

    // What the session is about to be given.
    struct Submission {
        const Document& document;
        const RenderSettings& settings;
        const PlaneSet& planes;
        uint64_t revision = 0;
        bool goes_on = false; // with the samples that there are, if lights that are mixed are all that differs
    };
    // Begins another run if another image will be rendered, named after what was changed, or `opened`, if that is not empty: the file that was
    // opened. What the image survives only marks the run.
    void submit(ConvergenceView& view, const Submission& submission, const std::string& opened);
    // From this revision on another image is rendered, of the scene as it then is.
    void begin(ConvergenceView& view, const std::string& name, uint64_t revision, const Scene& scene, const RenderSettings& settings);
    // From this revision on the samples there are, and those to come, are mixed in another way.
    void remix(const std::string& name, uint64_t revision, const Scene& scene);
    // The newest pictures: once per frame of the window.
    void look(ConvergenceView& view, const Pictures& pictures);
    // Does what the panel asked for. Files go into `folder`, named after `scene_file`.
    void obey(UiState& ui, const std::filesystem::path& folder, const std::filesystem::path& scene_file);
    void load(UiState& ui, const std::filesystem::path& file);

    // The picture should wait: all cores are at the reference, and its times would be none.
    bool renders_reference() const { return keeper_.renders(); }

private:
    void record(ConvergenceView& view, const FramePtr& frame);
    void record_denoised(ConvergenceView& view, const DenoisedPtr& picture);
    void measure(ConvergenceView& view, const FramePtr& frame);
    void save(UiState& ui, ConvergenceView::Export format, const std::filesystem::path& folder, const std::filesystem::path& scene_file);

    ErrorMeasuring measuring_;
    ReferenceKeeper keeper_;
    std::function<void()> wake_;
    uint64_t first_revision_ = 0; // of the live run
    ReferenceKeeper::Subject subject_;

    // Of the last submission.
    Scene scene_;
    RenderSettings settings_;
    PlaneSet planes_;
    size_t steps_to_redo_ = 0;

    std::string remixed_by_; // the edit after which no picture of the new mix was seen yet; empty: none
    FramePtr last_frame_;
    DenoisedPtr last_denoised_;
    double recording_seconds_ = 0;
    std::unique_ptr<BackgroundJob<Result<std::filesystem::path>>> save_job_;
};

} // namespace blush
