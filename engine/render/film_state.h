// All that a film has summed up, as a value: what another film goes on from as if it had seen the samples itself.
#pragma once

#include "core/exact_plane.h"
#include "core/result.h"
#include "render/film.h"
#include "render/frame.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

struct FilmState {
    int width = 0, height = 0;
    int64_t first_sample = 0, samples = 0; // of each pixel, on average: sample indices [first_sample, first_sample + samples)
    double seconds = 0;                    // of rendering
    // "even.R", "odd.count", "albedo.G", "depth", ...: sums over samples, and what the first sample saw. Material ids are Id<Material>.value,
    // no_material on a miss.
    std::vector<ExactPlane> planes;
    std::array<std::vector<double>, 2> shares; // SamplePlan's, once adaptive sampling has decided
    std::vector<Vec3d> marked;                 // PilotNoise's, in the second half of the pilot of adaptive sampling
    RayCounts rays;
    std::vector<PathCounts> path_counts;
    int64_t truncated = 0;
    Health health;
    // The mix in which the picture was seen; samples know nothing of it. Empty: none.
    struct MixedGroup {
        std::string name;
        Vec3 gain{1, 1, 1};
    };
    std::vector<MixedGroup> mix; // one for each group of lights

    static constexpr uint32_t no_material = 0xffffffffu;
    const ExactPlane* find(std::string_view name) const;
    ExactPlane* find(std::string_view name);
};
using FilmStatePtr = std::shared_ptr<const FilmState>;

// Planes and health of a film; the rest is whoever's who counts samples.
FilmState save_film(const Film& film);
// Into a film that was reset for the same image. Errors: another size, a plane that the film has and the state lacks.
Result<void> load_film(Film& film, const FilmState& state);
// Adds other samples of the same image to what the film holds. Sums are those of doubles; first hits stay those of the samples that were
// there before. Health is added up, the lists of the worst are those of both. Errors as above.
Result<void> add_film(Film& film, const FilmState& more);

// The picture that a film state holds, made with these settings: pixels, planes, error, health, all that Renderer::resolve() gives but for
// who rendered it. Errors as of load_film, a size that is none.
struct ResolvedFilm {
    Frame frame;
    std::vector<Vec3> error; // standard error of each pixel's mean, RGB; empty if not known
};
Result<ResolvedFilm> resolve_film(const FilmState& state, const RenderSettings& settings, unsigned threads = 0);
// The state of the samples of both, of one image and next to one another; neither may be adaptive. Errors as of add_film; ranges that
// overlap or leave a gap.
Result<FilmState> merge_films(const FilmState& a, const FilmState& b, const RenderSettings& settings);
// As if each group of lights had shone with that factor from the first sample on.
void scale_groups(FilmState& state, std::span<const Vec3> factors);

// What a film must be reset with to take up this state.
FilmSize film_size(const FilmState& state);

} // namespace blush
