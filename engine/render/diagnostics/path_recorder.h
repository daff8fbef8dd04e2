// Replays samples of an image and keeps all their vertices, with the estimator's own stages (replay.h): no second path tracer. Each sample
// has the radiance that the film receives for it.
#pragma once

#include "render/diagnostics/path_record.h"
#include "scene/render_settings.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

class PathRecorder {
public:
    // 0 threads: one per core.
    explicit PathRecorder(unsigned threads = 0, bool low_priority = false);
    ~PathRecorder();
    PathRecorder(const PathRecorder&) = delete;
    PathRecorder& operator=(const PathRecorder&) = delete;

    // Compiles what has changed since the last call. True if samples of before are outdated.
    bool update(const Scene& scene, const RenderSettings& settings);
    // Runs the pilots that the film runs before its second sample (LearnedSampling). Without them only sample 0 can be recorded, as a film
    // of one sample has it. False if stopped, as `wanted` returned false.
    bool decide(const std::function<bool()>& wanted = {});
    bool decided() const;
    // After the decision: sample 0 is rendered again as the pilots have decided.
    bool renews_first() const;
    // After the decision: light paths give light to the image.
    bool has_light_paths() const;

    // One sample of a pixel of the last scene. It keeps the first `most_vertices`; the radiance is of all. `light_paths`: replays the light
    // paths of the pass, too, which takes as long as they take to render the whole image.
    RecordedPath record(int x, int y, int64_t sample, bool light_paths = false);
    // Samples [first, first + count) in order, on all threads. Empty if stopped.
    std::optional<std::vector<RecordedPath>> record(int x, int y, int64_t first, int64_t count, bool light_paths,
                                                    const std::function<bool()>& wanted = {});
    static constexpr size_t most_vertices = 1000;

    // What the film does to this image that the sum over recorded samples leaves out, a sentence each.
    std::vector<std::string> not_replayed() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// What the film makes of these samples: their mean without those that it leaves out as invalid.
struct PathSum {
    int64_t paths = 0, invalid = 0;
    Vec3d mean{0, 0, 0};           // nits, RGB: of all that follows
    LightByStrategy by_strategy{}; // these sum to the mean
    std::vector<Vec3d> by_length;  // with `light_paths` these, too
    Vec3d light_paths{0, 0, 0};
};
constexpr size_t shown_path_lengths = 8; // the last one contains all longer paths

class PathSummer {
public:
    PathSummer();
    void add(const RecordedPath& path);
    PathSum sum() const;

private:
    PathSum totals_; // sums instead of means
};
PathSum sum_of(const std::vector<RecordedPath>& paths);

} // namespace blush
