// All sums of a film as a value, from which another film continues as if it had rendered the samples itself.
#pragma once

#include "core/lossless_plane.h"
#include "core/result.h"
#include "render/error/small_highlights.h"
#include "render/film/film.h"
#include "render/frame.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

struct FilmState {
    int width = 0, height = 0;
    int64_t first_sample = 0, samples = 0; // of each pixel, on average: sample indices [first_sample, first_sample + samples)
    double seconds = 0;                    // of rendering
    bool first_is_rough = false;           // the only sample is that of before the pilots: the next one refines it
    // "even.R", "odd.count", "albedo.G", "depth", ...: sums over samples, or values of the first sample. Material ids are
    // Id<Material>.value, no_material on a miss.
    std::vector<LosslessPlane> planes;
    std::array<std::vector<double>, 2> shares; // SampleAllocation's, once adaptive sampling has decided
    std::array<int64_t, 2> passes{};           // of light paths, in the even and odd half; 0 without light paths
    std::vector<Vec3d> marked;                 // PilotVariance's, in the second half of the pilot of adaptive sampling
    std::optional<PilotFigures> reuse_pilot;   // ReuseChoice's, if a pilot has decided
    std::optional<SmallHighlights> highlights; // if a pilot has searched for them
    RayCounts rays;
    std::vector<PathCounts> path_counts;
    int64_t truncated = 0;
    Health health;
    // The light mix of the saved image, for display only. Empty: none.
    struct MixedGroup {
        std::string name;
        Vec3 gain{1, 1, 1};
    };
    std::vector<MixedGroup> mix; // one entry per light group

    static constexpr uint32_t no_material = 0xffffffffu;
    const LosslessPlane* find(std::string_view name) const;
    LosslessPlane* find(std::string_view name);
};
using FilmStatePtr = std::shared_ptr<const FilmState>;

// Returns the planes and health of a film; the caller fills in the sample counts.
FilmState save_film(const Film& film);
// Loads into a film that was reset for the same image. Errors: another size, light paths only in one of both (their samples have
// other MIS weights), or a missing plane.
Result<void> load_film(Film& film, const FilmState& state);
// The same into a film that is reset for it first, with PlaneSet::half_difference as asked. Errors as above; no samples; not enough
// memory.
Result<void> load_new_film(Film& film, const FilmState& state, const RenderSettings& settings, bool half_difference = false);
// Adds other samples of the same image to the film: as if it had rendered them. First hits stay those of the earlier samples.
// Health counts are added, the lists of worst samples merged. Errors as above.
Result<void> add_film(Film& film, const FilmState& more);

// The image of a film state made with these settings: pixels, planes, error, health; all that Renderer::resolve() gives except
// the data of the renderer. `half_difference`: with Frame::half_difference. Errors as load_film, or an invalid size.
struct ResolvedFilm {
    Frame frame;
    std::vector<Vec3> error; // standard error of each pixel's mean, RGB; empty if not known
};
Result<ResolvedFilm> resolve_film(const FilmState& state, const RenderSettings& settings, unsigned threads = 0,
                                  bool half_difference = false);
// Scales each light group by its factor, as if rendered so from the first sample.
void scale_groups(FilmState& state, std::span<const Vec3> factors);

// The configuration with which a film must be reset to load this state.
FilmSize film_size(const FilmState& state);

} // namespace blush
