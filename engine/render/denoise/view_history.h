// View history: denoised images of earlier views of the same scene, reprojected into the current one, so that a moving camera does not
// begin each image with a few coarse samples. For display only: what depends on the view, such as reflections, lags behind.
#pragma once

#include "render/first_hit_planes.h"

#include <span>
#include <vector>

namespace blush {

class Workers;

// A denoised image of full size, and what it shows.
struct ViewHistory {
    struct Pixel {
        Vec3 irradiance; // radiance over albedo; radiance where there is hardly any
        bool reflective; // albedo is not hardly any
        Vec3 normal;
        float depth;
    };

    ViewHistory() = default;
    // `rgb`: seen.width * seen.height * 3 values, finite and >= 0.
    ViewHistory(const FirstHitPlanes& seen, std::vector<float> rgb);
    bool empty() const { return pixels.empty(); }

    int width = 0, height = 0;
    WorldCamera camera;
    std::vector<Pixel> pixels;
    std::vector<float> rgb;
};

struct WithHistory {
    int width = 0, height = 0;
    std::vector<float> rgb; // width * height * 3 values
    float share = 0;        // of history, mean over the pixels
};

// Mixes history into a denoised image. If that has full size or was enlarged (joint_upsampling.h), `seen` and the result have the size of
// the history: a pixel takes the radiance over albedo of the history where its surface was seen (temporal reprojection; for example Schied
// et al. 2017, "Spatiotemporal Variance-Guided Filtering"), times its own albedo. Otherwise the result has half that size, to be in time
// for a drag: only depths around a pixel are known, and its place in the history is searched for by fixed-point iteration (Bowles et al.
// 2012, "Iterative Image Warping"). History counts if it shows the same surface, within a hundredth of the distance, and the less, the more
// the mean of the image around a pixel differs from that of the history. `is_coarse`: rendered at less than full size; else its means are
// trusted more. `rgb`: of the current image, `seen.width` * `seen.height` * 3 values, finite and >= 0. Null workers: on this thread. The
// result does not depend on the number of threads.
WithHistory with_history(std::span<const float> rgb, bool is_coarse, const FirstHitPlanes& seen, const ViewHistory& history,
                         const Workers* workers = nullptr);

} // namespace blush
