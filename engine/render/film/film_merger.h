// Merges parts of one image, films of adjacent sample ranges, in the memory of one film. The sums are exact (exact_sum.h), so the
// result is bit for bit the film of a single render, however the samples were split.
#pragma once

#include "core/result.h"
#include "render/film/film.h"
#include "render/film/film_state.h"
#include "render/film/pilot_variance.h"

#include <span>

namespace blush {

class FilmMerger {
public:
    // The settings of the image.
    explicit FilmMerger(const RenderSettings& settings) : settings_(settings) {}

    // Adds the part that begins with the next sample. Errors: another sample comes next; the part does not fit the others
    // (add_film()). If pilots decided differently about path reuse, which only happens between versions of the program, the sum is
    // unbiased and continues as the first part. Of adaptive images, the parts must have one allocation (SampleAllocation); it is
    // that of a single render if parts of the pilot end at its half and at its end.
    Result<void> add(const FilmState& part);
    // All parts so far; at least one.
    FilmState sum() const;

private:
    void measure_pilot();

    RenderSettings settings_;
    Film film_;
    FilmState state_; // without planes and health
    PilotVariance pilot_;
};

// Of two states with adjacent ranges, in any order. Errors as above.
Result<FilmState> merge_films(const FilmState& a, const FilmState& b, const RenderSettings& settings);

} // namespace blush
