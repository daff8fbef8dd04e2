// The path tool: whose paths are shown, and how (ui/panels/paths, ui/viewport/path_lines.h).
#pragma once

#include "render/diagnostics/path_arithmetic.h"
#include "scene/image_region.h"
#include "ui/jobs/path_runner.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct PathsView {
    enum class ShownChannel { brightest, red, green, blue };
    static constexpr const char* channels[] = {"Brightest", "Red", "Green", "Blue"};
    static constexpr int64_t most_samples = 4096, default_samples = 256;

    bool open = false;
    // Scene, view and settings as they were at the click: the paths stay where they are while the view moves.
    std::optional<PathWork::Input> request;
    ImageRegion region;                 // of the image at the click
    View view;                          // likewise
    std::shared_ptr<PathRunner> runner; // null while the panel is closed
    PathRunner::State state;

    int64_t samples = default_samples; // of each pixel
    int64_t path = 0;                  // index of the shown path
    int64_t steps = 0;                 // of its vertices are shown; 0: all
    bool others = true;                // shows the other paths, too
    bool playing = false;
    float speed = 4;     // vertices per second
    double step_due = 0; // time of the next step
    ShownChannel channel = ShownChannel::brightest;

    const PathSet* set() const { return state.output.get(); }
    // The shown path; null before the first.
    const RecordedPath* shown() const;
    // How many of its vertices are shown.
    size_t shown_vertices() const;
    RgbChannel channel_of(const RecordedPath& path) const;
};

// At most 64 pixels, spread evenly over a region of a width x height image.
std::vector<TracedPixel> traced_pixels(const ImageRegion& region, int width, int height);
// Steps the playback on when it is due: vertex by vertex, then to the next path. Returns the seconds until the next step.
double play(PathsView& view, double now);

} // namespace blush
