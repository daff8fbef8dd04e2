// Preview of a light mix while it is edited: at a reduced resolution that fits the time budget, in full when the edit pauses.
#pragma once

#include "render/light_mix/light_mix.h"
#include "render/session/published_frames.h"

#include <functional>
#include <memory>
#include <vector>

namespace blush {

// The source: the groups of a frame, of its denoised image, or of both.
struct MixPreviewSource {
    FramePtr frame;
    DenoisedPtr denoised;
    bool shows_raw = true, shows_denoised = false;
    int planes() const;
};

class MixPreview {
public:
    static constexpr int coarsest = 8;

    // Step between the pixels that are mixed, per axis, at most `coarsest`: the smallest that can be mixed and drawn within the
    // given milliseconds, at the last measured speed. `drawing`: milliseconds to draw this many pixels.
    int step_in_time(const MixPreviewSource& moved, double milliseconds, const std::function<double(double pixels)>& drawing) const;

    struct Preview {
        int width = 0, height = 0;
        std::shared_ptr<const std::vector<float>> values;
    };
    // 4 values per pixel, the last is 1; the others are unspecified if the raw image is not shown.
    Preview raw(const MixPreviewSource& moved, const Gains& gains, int step);
    // 3 values per pixel.
    Preview denoised(const MixPreviewSource& moved, const Gains& gains, int step);
    // The edit has ended: frees the cached planes.
    void forget() { raw_ = denoised_ = {}; }

private:
    // The planes last read, and reused output buffers.
    struct Kept {
        std::weak_ptr<const void> of;
        int step = 0;
        SubsampledPlanes planes = {};
        std::vector<float> mixed = {};
        std::shared_ptr<std::vector<float>> rgba = {}, rgb = {};
    };
    bool is_kept(const Kept& kept, const std::shared_ptr<const void>& of, int step) const;
    void subsample(Kept& kept, const std::shared_ptr<const void>& of, const std::vector<PlaneSpan>& planes, int width, int height,
                   int step);
    void mix(const Kept& kept, const Gains& gains, std::vector<float>& rgb);

    Kept raw_, denoised_;
    // Pixels of one plane per millisecond: conservative initial values.
    double subsampling_ = 1.5e5, mixing_ = 5e5;
};

} // namespace blush
