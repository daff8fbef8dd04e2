#include "render/diagnostics/path_recorder.h"

#include "core/parallel.h"
#include "render/compile/expand_area_lights.h"
#include "render/diagnostics/light_path_replay.h"
#include "render/diagnostics/vertex_recorder.h"
#include "render/integrator/kernel_settings.h"
#include "render/pilots/learned_sampling.h"
#include "scene/changes.h"
#include "scene/reuse_setting.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace blush {

struct PathRecorder::State {
    Workers workers;
    std::vector<std::unique_ptr<TileScratch>> scratch;
    ExpandedMeshes meshes;
    std::optional<Scene> expanded;
    RenderScene scene;
    RenderSettings settings;
    LearnedSampling learned;
    bool decided = false;

    State(unsigned threads, bool low_priority) : workers(threads, low_priority), scratch(workers.threads()) {}

    KernelContext context(const SceneTables& tables) const {
        return {&tables, &scene.accel(), kernel_settings(settings, settings.width, settings.height), settings.seed};
    }
    SceneTables tables_for(int64_t sample) const {
        if (!decided) return learned.tables(scene.tables(), 0);
        return learned.tables(scene.tables(), learned.renews_first() ? std::max<int64_t>(sample, 1) : sample);
    }
    RecordedPath record(int x, int y, int64_t sample, bool light_paths, TileScratch& tile) const;
};

// Call it from within Workers::run or for_each.
RecordedPath PathRecorder::State::record(int x, int y, int64_t sample, bool light_paths, TileScratch& tile) const {
    const SceneTables tables = tables_for(sample);
    const KernelContext with = context(tables);
    VertexRecorder recorder(*expanded, scene, with);
    RecordedPath path{.x = x, .y = y, .sample = sample};
    path.radiance = replay_sample(with, x, y, sample, max_path_length + 1, tile, [&](const ReplayedVertex& vertex) {
        if (path.vertices.empty()) path.eye = recorder.world(vertex.path.ray.origin);
        if (path.vertices.size() >= most_vertices)
            path.shortened = true;
        else
            path.vertices.push_back(recorder.record(vertex, path.vertices.empty() ? nullptr : &path.vertices.back()));
        return true;
    });
    if (!light_paths || !learned.light_paths().pays()) return path;
    const LightPathPass pass = learned.light_path_pass(scene.tables());
    const Kernel& kernel = choose_kernel(scene.features().with(Feature::light_paths));
    path.light_paths = replay_light_paths(context(pass.tables), kernel, *pass.emission, pass.paths, sample, x, y, tile).light;
    return path;
}

PathRecorder::PathRecorder(unsigned threads, bool low_priority) : state_(std::make_unique<State>(threads, low_priority)) {}
PathRecorder::~PathRecorder() = default;

bool PathRecorder::update(const Scene& scene, const RenderSettings& settings) {
    State& s = *state_;
    Scene now = expand_area_lights(scene, &s.meshes, &s.workers);
    const std::optional<Changes> changes = s.expanded ? std::optional(diff(*s.expanded, s.settings, now, settings)) : std::nullopt;
    const bool outdated = !changes || changes->affects_image() || !same_image(s.settings, settings);
    if (outdated) {
        s.scene.update(now, settings, changes ? plan(*changes) : full_plan(), s.workers);
        s.learned = LearnedSampling(settings, s.scene, FilmSize{settings.width, settings.height});
        s.decided = false;
    }
    s.expanded = std::move(now);
    s.settings = settings;
    return outdated;
}

bool PathRecorder::decide(const std::function<bool()>& wanted) {
    State& s = *state_;
    if (s.decided) return true;
    const KernelContext context = s.context(s.scene.tables());
    s.decided =
        s.learned.decide(std::numeric_limits<int64_t>::max(), context, choose_kernel(s.scene.features()), s.workers, s.scratch, wanted);
    return s.decided;
}

bool PathRecorder::decided() const { return state_->decided; }
bool PathRecorder::renews_first() const { return state_->decided && state_->learned.renews_first(); }
bool PathRecorder::has_light_paths() const { return state_->decided && state_->learned.light_paths().pays(); }

RecordedPath PathRecorder::record(int x, int y, int64_t sample, bool light_paths) {
    return std::move(record(x, y, sample, 1, light_paths)->front());
}

std::optional<std::vector<RecordedPath>> PathRecorder::record(int x, int y, int64_t first, int64_t count, bool light_paths,
                                                              const std::function<bool()>& wanted) {
    State& s = *state_;
    std::vector<RecordedPath> paths(static_cast<size_t>(count));
    const bool all = s.workers.for_each(count, wanted, [&](int64_t i, unsigned worker) {
        if (!s.scratch[worker]) s.scratch[worker] = std::make_unique<TileScratch>();
        paths[size_t(i)] = s.record(x, y, first + i, light_paths, *s.scratch[worker]);
    });
    return all ? std::optional(std::move(paths)) : std::nullopt;
}

std::vector<std::string> PathRecorder::not_replayed() const {
    const State& s = *state_;
    std::vector<std::string> notes;
    if (s.settings.reuse != 1 && !s.learned.excludes_reuse())
        notes.push_back("path reuse: where the film shares the light of paths among pixels, a pixel also holds shares of its neighbours");
    if (s.settings.smooth_edges)
        notes.push_back("smooth edges: in a pixel at the edge of an emitter the film takes more camera rays for the emission");
    if (s.decided && s.learned.splits(AdjointChoice::first_sample))
        notes.push_back(
            "splitting: from sample 4 on the film follows a path in several copies where that pays; one is recorded, with the same "
            "light in the mean");
    if (s.settings.clamp.limit > 0) notes.push_back("clamping: the film limits the light of a sample");
    if (!s.scene.catchers().empty()) notes.push_back("shadow catcher: the film shows its shadow instead of its light");
    return notes;
}

PathSummer::PathSummer() { totals_.by_length.assign(shown_path_lengths, Vec3d{0, 0, 0}); }

void PathSummer::add(const RecordedPath& path) {
    if (!path.is_valid()) {
        ++totals_.invalid;
        return;
    }
    const auto add = [](Vec3d& to, const Vec3d& light) { to = to + light; };
    ++totals_.paths;
    add(totals_.mean, to_double(path.radiance) + to_double(path.light_paths));
    add(totals_.light_paths, to_double(path.light_paths));
    const LightByStrategy found = by_strategy(path);
    for (size_t k = 0; k < found.size(); ++k) add(totals_.by_strategy[k], found[k]);
    const std::vector<Vec3d> lengths = by_length(path, shown_path_lengths);
    for (size_t k = 0; k < lengths.size(); ++k) add(totals_.by_length[k], lengths[k]);
}

PathSum PathSummer::sum() const {
    PathSum sum = totals_;
    if (sum.paths == 0) return sum;
    const double share = 1 / double(sum.paths);
    for (Vec3d* c : {&sum.mean, &sum.light_paths}) *c = *c * share;
    for (Vec3d& c : sum.by_strategy) c = c * share;
    for (Vec3d& c : sum.by_length) c = c * share;
    return sum;
}

PathSum sum_of(const std::vector<RecordedPath>& paths) {
    PathSummer summer;
    for (const RecordedPath& path : paths) summer.add(path);
    return summer.sum();
}

} // namespace blush
