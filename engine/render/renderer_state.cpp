#include "render/renderer_state.h"

#include "render/compile/expanded_lights.h"
#include "render/film/film_state.h"
#include "render/integrator/irradiance.h"
#include "render/integrator/kernel_settings.h"
#include "render/integrator/reuse_groups.h"
#include "scene/affine.h"
#include "scene/changed_records.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace blush {
namespace {

// True during the pilot, after its first half was stored.
bool in_mid_pilot(int64_t samples) { return samples >= SampleAllocation::pilot_samples / 2 && samples < SampleAllocation::pilot_samples; }

// True if the camera sees the same surfaces with the same albedo. The background counts as no surface.
bool keeps_first_hits(const Scene& before, const Scene& after, const Changes& changes) {
    if (!changes.only_light()) return false;
    // The camera sees lights with a radius as spheres.
    const auto same_shape = [](const Light& a, const Light& b) {
        return a.kind == b.kind && a.radius == b.radius && a.enabled == b.enabled && a.visible_to_camera == b.visible_to_camera;
    };
    const auto same_albedo = [](const Material& a, const Material& b) { return same_but_for_emission(a, b); };
    return all_keep(before.lights, after.lights, changes.lights, same_shape) &&
           all_keep(before.materials, after.materials, changes.materials, same_albedo);
}

} // namespace

Renderer::Renderer(const RendererOptions& options) : state_(std::make_unique<State>(options)) {}
Renderer::~Renderer() = default;

Renderer::State::Outdated Renderer::State::compile(const Scene& whole, const RenderSettings& now, LightGroupsPtr groups_of_scene) {
    Scene now_expanded = expand_area_lights(whole, &meshes, &workers);
    // Not the changes of a submission: the renderer skips submissions, and expansion spreads a change to records that it does not name.
    // Solo switches other lights off, a clip moves nodes, a normal map gives meshes tangents, one more disk changes all disks.
    const std::optional<Changes> changes = expanded ? std::optional(diff(*expanded, settings, now_expanded, now)) : std::nullopt;
    const UpdatePlan todo = changes ? plan(*changes) : full_plan();
    groups = std::move(groups_of_scene);
    mixing = groups ? mixing_of(*groups, whole, {}).value() : Mixing{};
    Film::require_memory({now.width, now.height, options.planes, false, now.adaptive, int(mixing.gains.size())});
    scene.update(now_expanded, now, todo, workers, groups.get());
    field_effect = {};
    field_effect.dropped = true;
    if (changes && options.begins_trained && learned.has_kept())
        field_effect = effect_on_field(*expanded, now_expanded, *changes, scene.tables().casters, scene.origin());
    if (!changes || !keeps_first_hits(*expanded, now_expanded, *changes)) first_hits.reset();
    if (groups) scene.aim(mixing.gains);
    expanded = std::move(now_expanded);
    settings = now;
    if (todo.features) kernel = &choose_kernel(scene.features());
    if (!todo.clear_film) return Outdated::nothing;
    return changes && changes->only_view() ? Outdated::view : Outdated::film;
}

void Renderer::State::begin_film(Clock::time_point begun, Outdated outdated) {
    clear();
    splats = false;
    edges = EdgeChoice(settings, scene, transparent());
    begin_learning(field_effect, outdated != Outdated::film);
    highlights.reset();
    info.reset();
    kernel_name = name_of(kernel_for(tables_for(0)));
    seconds_setup = std::chrono::duration<double>(Clock::now() - begun).count();
}

void Renderer::State::begin_learning(const FieldEffect& effect, bool same_photons) {
    LearnedSampling before = std::exchange(learned, LearnedSampling(settings, scene, full_film(), options.caustics));
    if (same_photons) learned.keep_from(before);
    if (options.begins_trained) learned.keep_learned(std::move(before), effect, scene.origin());
}

bool Renderer::update(const Scene& scene, const RenderSettings& asked) {
    State& s = *state_;
    const RenderSettings settings = s.kernel_settings_for(asked);
    const bool other_bounces = s.replacement && std::exchange(s.max_bounces, asked.max_bounces) != asked.max_bounces;
    const auto begun = State::Clock::now();
    if (s.apply_mix(scene, settings)) return false;
    const bool mixed = scene.mix.grouping != LightMix::Grouping::none;
    auto outdated = s.compile(scene, settings, mixed ? std::make_shared<const LightGroups>(make_light_groups(scene)) : nullptr);
    if (other_bounces) outdated = State::Outdated::film;
    if (outdated != State::Outdated::nothing) s.begin_film(begun, outdated);
    return outdated != State::Outdated::nothing;
}

void Renderer::begin_image(const Scene& scene, const RenderSettings& settings, LightGroupsPtr groups) {
    const auto begun = State::Clock::now();
    state_->max_bounces = settings.max_bounces;
    const auto outdated = state_->compile(scene, state_->kernel_settings_for(settings), std::move(groups));
    state_->begin_film(begun, outdated);
}

void Renderer::set_mix(const Mixing& mixing) { state_->set_mix(mixing); }

void Renderer::select_lights_by_mix() {
    State& s = *state_;
    if (!s.groups) return;
    s.scene.aim(s.mixing.gains);
    // What its other light paths would follow is forgotten, so the first sample is rendered again with the next.
    if (s.first_is_incomplete()) {
        s.first_is_trained = true;
        s.first_as_others = false;
        s.first_pass_tiles = 0;
    }
    s.begin_learning({}, false);
}

void Renderer::set_planes(const PlaneSet& planes) {
    State& s = *state_;
    if (planes == s.options.planes) return;
    const bool covered = s.options.planes.covers(planes);
    s.options.planes = planes;
    s.info.reset();
    s.feature_report.reset();
    if (!covered) {
        clear();
        s.splats = false;
        s.begin_learning({}, false); // some planes exclude light paths
    } else if (!s.film_is_stale)
        s.film.keep_only(planes);
}

void Renderer::set_divider(int divider) {
    if (divider == state_->divider) return;
    state_->divider = divider;
    clear();
}

int Renderer::divider() const { return state_->divider; }
void Renderer::clear() { state_->clear(); }

const CompiledInfo& Renderer::info() {
    State& s = *state_;
    if (!s.info) {
        s.info = s.scene.info();
        s.info->kernel = s.kernel_name;
        if (const std::string& missing =
                s.scene.missing_light(s.learned.light_paths().may_be_used() ? CausticFinders::light_paths : CausticFinders::none);
            !missing.empty())
            s.info->warnings.push_back({Diagnostic::Severity::warning, missing, ""});
        s.info->seconds_setup = s.seconds_setup;
    }
    s.info->features = *feature_report();
    return *s.info;
}

std::shared_ptr<const FeatureReport> Renderer::feature_report() {
    State& s = *state_;
    if (!s.feature_report) {
        FilmSize film = s.full_film();
        film.light_paths = film.light_paths || (s.divider == 1 && s.learned.light_paths().pays()); // before the film has its splats
        FeatureReport feature_report = s.scene.feature_report(s.expanded ? *s.expanded : Scene{}, film);
        feature_report.push_back(s.edges.report());
        for (FeatureUse& use : s.learned.report(s.uses_kept())) feature_report.push_back(std::move(use));
        s.feature_report = std::make_shared<const FeatureReport>(std::move(feature_report));
    }
    return s.feature_report;
}

std::vector<Vec3> Renderer::resolve_error() {
    state_->clear_stale_film();
    return state_->film.standard_error();
}

ReuseCovariance Renderer::reuse_covariance() {
    state_->clear_stale_film();
    if (state_->correlates_pixels()) return measure_block_covariance(state_->film);
    const int group_size = state_->film_group_size();
    return group_size > 1 ? measure_reuse_covariance(state_->film, reuse_groups(group_size)) : measure_sampler_covariance(state_->film);
}

bool Renderer::has_light() const { return state_->scene.has_light(); }

Vec3d Renderer::irradiance(const MeterPlace& place, uint32_t replicate, int samples) {
    State& s = *state_;
    const KernelContext context{&s.scene.tables(), &s.scene.accel(), kernel_settings(s.settings, 1, 1), s.settings.seed};
    const Vec3d position = place.position + place.normal * place.clearance - s.scene.origin();
    const MeterPoint receiver{to_float(position), to_float(place.normal)};
    if (!s.replays[0]) s.replays[0] = std::make_unique<TileScratch>();
    Vec3d mean{0, 0, 0};
    s.workers.run([&] { mean = estimate_irradiance(context, receiver, replicate, samples, *s.replays[0]); });
    return mean;
}

void Renderer::resolve(Frame& frame) {
    State& s = *state_;
    s.clear_stale_film();
    s.film.resolve(frame, s.workers);
    for (uint32_t& id : frame.object_id) id &= ~expanded_id_bit;
    for (uint32_t& id : frame.material_id) {
        const uint32_t material = s.scene.material_id(int32_t(id) - 1).value;
        id = material & expanded_id_bit ? 0 : material;
    }
    frame.light_groups = s.groups;
    frame.group_names = s.mixing.names;
    frame.divider = s.divider;
    frame.whole = s.settings.region == ImageRegion{};
    frame.samples = s.samples;
    frame.light_path_share = s.first_pass_tiles > 0 ? s.share_of_pass(s.first_pass_tiles) : 1;
    frame.rays = s.rays;
    frame.stages = s.stages;
    frame.path_counts = s.options.planes.roulette ? s.path_counts : std::vector<PathCounts>();
    frame.health.truncated = s.truncated;
    frame.kernel = s.kernel_name;
    frame.feature_report = feature_report();
    frame.missing_light = s.scene.missing_light(s.caustic_finders());
    frame.warnings = s.scene.warnings();
}

Frame Renderer::resolve() {
    Frame frame;
    resolve(frame);
    frame.error = estimate_error();
    frame.error_samples = frame.samples;
    return frame;
}

ErrorEstimate Renderer::estimate_error() {
    State& s = *state_;
    s.clear_stale_film();
    const int group_size = s.film_group_size();
    ErrorEstimate error = s.correlates_pixels()
                              ? s.film.estimate_error(s.workers, measure_block_covariance(s.film).products)
                              : blush::estimate_error(s.film, group_size, s.workers, s.divider == 1 ? s.edges.pixels(1) : nullptr);
    // Both halves miss the same light, so their difference does not show that error.
    if (!s.scene.missing_light(s.caustic_finders()).empty()) {
        error.known = error.known && error.high > 0;
        error.rmse_known = error.rmse_known && error.rmse_high > 0;
    }
    if (s.highlights) include_small_highlights(error, *s.highlights, double(s.samples), s.film.width(), s.film.height());
    return error;
}

Result<FilmState> Renderer::save_film(int64_t first) const {
    const State& s = *state_;
    if (s.film_is_stale || s.samples == 0) return Error{"", "no samples are rendered yet", ""};
    if (s.film_is_uneven) return Error{"", "rendering was stopped in the middle of a sample", ""};
    if (s.divider != 1) return Error{"", "the image is not yet at full resolution", ""};
    if (s.first_is_trained || s.first_is_incomplete()) return Error{"", "the first sample is not settled", ""};
    FilmState state = blush::save_film(s.film);
    // A saved film starts with the current emission; mix channels are saved separately.
    if (std::ranges::any_of(s.mixing.factors, [](const Vec3& f) { return f != Vec3{1, 1, 1}; })) scale_groups(state, s.mixing.factors);
    if (LosslessPlane* material = state.find("material"))
        for (uint32_t& index : material->words)
            if (index != FilmState::no_material) index = s.scene.material_id(int32_t(index)).value;
    state.first_sample = first;
    state.first_is_rough = s.first_is_rough && s.samples == 1;
    state.samples = s.samples;
    state.shares = s.sample_allocation.shares();
    if (s.settings.adaptive && first == 0 && in_mid_pilot(s.samples)) state.marked = s.pilot_variance.marked();
    state.reuse_pilot = s.learned.reuse().pilot();
    state.highlights = s.highlights;
    state.rays = s.rays;
    state.path_counts = s.path_counts;
    state.truncated = s.truncated;
    for (size_t k = 0; k < s.mixing.names.size(); ++k) state.mix.push_back({s.mixing.names[k], s.mixing.channels[k]});
    return state;
}

Result<void> Renderer::load_film(const FilmState& state) {
    State& s = *state_;
    s.divider = 1;
    s.clear();
    const bool light_paths = film_size(state).light_paths;
    s.early_splats = light_paths && state.first_is_rough; // saved before the pilots
    s.splats = light_paths && !s.early_splats;
    s.clear_stale_film();
    const auto refused = [&](Error error) {
        s.clear();
        return error;
    };
    if (state.samples < 1) return refused({"", "there are no samples", ""});
    const bool marked = s.settings.adaptive && state.first_sample == 0 && in_mid_pilot(state.samples);
    if (marked && state.marked.size() != 2 * size_t(s.film.width()) * size_t(s.film.height()))
        return refused({"", "the saved samples lack the pilot of adaptive sampling", ""});
    const bool decided = s.settings.adaptive && state.first_sample + state.samples >= SampleAllocation::pilot_samples;
    if (decided && !s.sample_allocation.restore(state.shares))
        return refused({"", "the saved samples lack the plan of adaptive sampling", ""});
    if (const auto loaded = blush::load_film(s.film, state); !loaded) return refused(loaded.error());
    s.film.each_material([&](int32_t& index) {
        if (uint32_t(index) != FilmState::no_material) index = s.scene.material_index(Id<Material>{uint32_t(index)});
    });
    if (marked) s.pilot_variance.restore(state.marked);
    if (state.reuse_pilot) s.learned.decide_reuse(*state.reuse_pilot);
    if (state.highlights) s.highlights = state.highlights;
    s.first_is_rough = state.first_is_rough;
    s.samples = state.samples;
    s.loaded_first = state.first_sample;
    s.rays = state.rays;
    s.path_counts = state.path_counts;
    s.truncated = state.truncated;
    return {};
}

std::vector<std::string> available_isas() {
    const auto isas = runnable_isas();
    return {isas.begin(), isas.end()};
}

} // namespace blush
