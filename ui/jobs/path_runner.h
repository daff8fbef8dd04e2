// Replays the samples of chosen pixels on its own thread, for the path tool (path_recorder.h).
#pragma once

#include "measure/statistics/path_statistics.h"
#include "render/diagnostics/path_recorder.h"
#include "ui/jobs/image_input.h"
#include "ui/jobs/round_runner.h"

#include <memory>
#include <string>
#include <vector>

namespace blush {

struct TracedPixel {
    int x = 0, y = 0; // from the upper left corner of the image
    bool operator==(const TracedPixel&) const = default;
};

// The paths so far and their statistics. Never changed once it is published.
struct PathSet {
    std::vector<std::shared_ptr<const RecordedPath>> paths; // sample by sample; those of a sample in the order of the pixels
    PathSum sum;
    std::vector<RunningMean> means;    // of the luminance, nits
    LogHistogram contributions;        // of the luminance, nits
    std::vector<std::string> left_out; // PathRecorder::not_replayed(); and light paths, which are not replayed here
    bool complete = false;
};

class PathWork {
public:
    struct Input : ImageInput {
        std::vector<TracedPixel> pixels; // none: only compiles the scene and runs the pilots, so that the first path appears at once
        int64_t samples = 0;             // of each pixel
        bool has_same_result(const Input& other) const;
    };
    using Output = std::shared_ptr<const PathSet>; // null before the first path

    void begin(const Input& input);
    bool round(const std::function<bool()>& wanted);
    Output output() const { return output_; }
    static bool is_good(const Output& set) { return set && set->complete; }

private:
    bool decide(const std::function<bool()>& wanted);
    void trace(const std::function<bool()>& wanted);
    void publish();

    PathRecorder recorder_{1, true};
    std::vector<TracedPixel> pixels_;
    int64_t wanted_paths_ = 0;
    std::vector<std::shared_ptr<const RecordedPath>> paths_;
    std::vector<double> luminances_;
    PathSummer summer_;
    Output output_;
};

using PathRunner = RoundRunner<PathWork>;

} // namespace blush
