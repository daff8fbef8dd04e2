// Highlights of lamps in smooth surfaces that may be too small for the samples so far: an error estimate cannot know them.
#pragma once

#include "core/vec.h"
#include "render/film/edges/edge_pixels.h"

#include <array>
#include <cstdint>

namespace blush {

// Camera paths that only smooth surfaces turn meet a lamp by chance, and no other strategy finds that light. A highlight that covers a
// thousandth of a pixel is missing from most images, and from both halves of the samples alike, so that their difference does not show
// it. A pilot (highlight_pilot.h) therefore estimates how often a camera sample meets such light, and how much it adds.
struct SmallHighlights {
    // Light of about the same brightness.
    struct Band {
        double rate = 0;    // camera samples that meet it, per sample
        Vec3d sum{0, 0, 0}; // what it adds to the mean of the image, nits
        bool operator==(const Band&) const = default;
    };
    static constexpr int first_octave = -16, num_bands = 64; // a band an octave
    // Those of ordinary pixels, 0, and of pixels that take so many samples of them for each sample (edge_pixels.h). Films are saved with
    // the numbers of bands.
    static constexpr std::array samples_of_set{0, highlight_samples, bright_highlight_samples, faint_highlight_samples};
    std::array<Band, samples_of_set.size() * num_bands> bands;

    // The band of light that adds this luminance to a sample, nits, in pixels that take so many samples of it: one of `samples_of_set`.
    static size_t octave_of(double luminance);
    Band& of(double luminance, int samples = 0);
    void add(double luminance, const Band& light, int samples = 0);
    bool operator==(const SmallHighlights&) const = default;

    // The error of an image that lacks what its samples have hardly met: sums over pixels and channels of the squared error, and of that
    // over the squared true value plus 0.01 (relMSE), at most. `samples`: per pixel. A band is hardly met if fewer than 20 samples are
    // expected to, of the emission where a pixel takes more of these; its light is taken to lie in as many pixels as it covers, or in
    // one.
    struct Missed {
        double squares = 0, relative = 0;
    };
    Missed missed(double samples, int64_t pixels) const;
};

} // namespace blush
