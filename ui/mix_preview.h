// A mix of lights while it is being moved: of as many pixels as there is time for, all of them when it rests.
#pragma once

#include "render/light_mix.h"
#include "render/showcase.h"

#include <functional>
#include <memory>
#include <vector>

namespace blush {

// What is moved: the groups of a frame, of what it was denoised to, or of both.
struct MovedMix {
    FramePtr frame;
    DenoisedPtr denoised;
    bool shows_raw = true, shows_denoised = false;
    int planes() const;
};

class MixPreview {
public:
    static constexpr int coarsest = 8;

    // So many pixels of each row and column make one, at most `coarsest`: the fewest that can be mixed and drawn within so many milliseconds,
    // if all goes as fast as it last did. `drawing`: milliseconds to draw so many pixels.
    int step_in_time(const MovedMix& moved, double milliseconds, const std::function<double(double pixels)>& drawing) const;

    struct Picture {
        int width = 0, height = 0;
        std::shared_ptr<const std::vector<float>> values;
    };
    // 4 values a pixel, of which the last is 1; the others mean nothing if the raw picture is not shown.
    Picture raw(const MovedMix& moved, const Gains& gains, int step);
    // 3 values a pixel.
    Picture denoised(const MovedMix& moved, const Gains& gains, int step);
    // Nothing is moved any more: frees what was kept for it.
    void forget() { raw_ = denoised_ = {}; }

private:
    // What was last taken out of planes, and memory for what is made of it.
    struct Kept {
        std::weak_ptr<const void> of;
        int step = 0;
        ThinnedPlanes planes = {};
        std::vector<float> mixed = {};
        std::shared_ptr<std::vector<float>> rgba = {}, rgb = {};
    };
    bool is_kept(const Kept& kept, const std::shared_ptr<const void>& of, int step) const;
    void thin(Kept& kept, const std::shared_ptr<const void>& of, const std::vector<PlaneSpan>& planes, int width, int height, int step);
    void mix(const Kept& kept, const Gains& gains, std::vector<float>& rgb);

    Kept raw_, denoised_;
    // Pixels of one plane in a millisecond: careful guesses at first.
    double thinning_ = 1.5e5, mixing_ = 5e5;
};

} // namespace blush
