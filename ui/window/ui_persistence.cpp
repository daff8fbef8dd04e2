#include "ui/window/ui_persistence.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace blush {
namespace {

const std::string bounce_gain = "bounces.gain.";

// visit("name", value, min, max) for each; a bool has no limits.
template <class Ui, class V> void visit_panels(Ui& ui, const V& visit) {
    visit("tab", ui.tab, InspectorTab::selection, InspectorTab::display);
    visit("denoise", ui.denoise.show, DenoiseView::Show::raw, DenoiseView::Show::difference);
    visit("denoise.blend", ui.denoise.blend, 0.f, 1.f);
    visit("exposure.f_number", ui.triangle.f_number, 0.1f, 1000.f);
    visit("exposure.iso", ui.triangle.iso, 1.f, 1e7f);
    visit("bounces.mode", ui.bounces.mode, BouncesView::Mode::image, BouncesView::Mode::gains);
    visit("bounces.bounce", ui.bounces.bounce, 0, default_bounce_planes);
    visit("health.map", ui.health.map, false, true);
    visit("roulette.map", ui.roulette.map, RouletteView::Map::none, RouletteView::Map::survival);
    visit("strategies.show", ui.strategies.show, StrategiesView::Show::image, StrategiesView::Show::mis_variance);
    visit("strategies.metric", ui.strategies.metric, ErrorMetric::rmse, ErrorMetric::relmse);
    visit("strategies.budget", ui.strategies.budget, StrategyBudget::time, StrategyBudget::samples);
    visit("integrators.show", ui.integrators.show, IntegratorsView::Show::images, IntegratorsView::Show::difference);
    visit("integrators.metric", ui.integrators.metric, ErrorMetric::rmse, ErrorMetric::relmse);
    visit("integrators.kind", ui.integrators.integrator.kind, ComparisonIntegrator::Kind::ambient, ComparisonIntegrator::Kind::metropolis);
    visit("integrators.wipe", ui.integrators.wipe, 0.f, 1.f);
    visit("snapshots", ui.snapshots.open, false, true);
    visit("compare.wipe", ui.snapshots.compare.wipe, 0.f, 1.f);
    visit("compare.kind", ui.snapshots.compare.kind, DifferenceKind::absolute, DifferenceKind::flip);
    visit("convergence.metric", ui.convergence.metric, ErrorMetric::rmse, ErrorMetric::relmse);
    visit("convergence.axis", ui.convergence.axis, ProgressAxis::seconds, ProgressAxis::spp);
    visit("convergence.target.0", ui.convergence.targets[0], 0.f, 1e9f);
    visit("convergence.target.1", ui.convergence.targets[1], 0.f, 1e9f);
    visit("convergence.denoised", ui.convergence.denoised, false, true);
    visit("convergence.reference", ui.convergence.reference, false, true);
}

} // namespace

void save_panels(const UiState& ui, WindowSettings& settings) {
    std::erase_if(settings.panels, [](const auto& entry) { return entry.first.starts_with(bounce_gain); });
    for (size_t k = 0; k < ui.bounces.gains.size(); ++k) settings.panels[bounce_gain + std::to_string(k)] = double(ui.bounces.gains[k]);
    visit_panels(ui, [&](const char* name, const auto& value, auto, auto) { settings.panels[name] = double(value); });
}

void restore_panels(const WindowSettings& settings, UiState& ui) {
    std::vector<float> gains;
    for (int k = 0; k < max_bounce_planes; ++k) {
        const auto gain = settings.panels.find(bounce_gain + std::to_string(k));
        if (gain == settings.panels.end() || !(gain->second >= 0 && gain->second <= double(max_bounce_gain))) break;
        gains.push_back(float(gain->second));
    }
    if (!gains.empty()) ui.bounces.gains = std::move(gains);
    visit_panels(ui, [&](const char* name, auto& value, auto least, auto most) {
        using T = std::remove_reference_t<decltype(value)>;
        const auto found = settings.panels.find(name);
        if (found == settings.panels.end() || !(found->second >= double(least) && found->second <= double(most))) return;
        if constexpr (std::is_floating_point_v<T>)
            value = T(found->second);
        else
            value = T(int(found->second));
    });
}

void save_scene_ui(const UiState& ui, const std::string& file, WindowSettings& settings) {
    if (file.empty()) return;
    std::erase_if(settings.scenes, [&](const SceneMemory& m) { return m.file == file; });
    SceneMemory memory;
    memory.file = file;
    memory.zoom = ui.zoom.scale;
    memory.u = ui.zoom.u;
    memory.v = ui.zoom.v;
    memory.material = ui.selected_material.value;
    memory.mix_group = ui.light_mix.unfolded;
    memory.instruments = ui.docks.open;
    for (const Id<Node> id : ui.turned) memory.turned.push_back(id.value);
    if (ui.selected) memory.selected.push_back(ui.selected.value);
    for (const Id<Node> id : ui.also_selected) memory.selected.push_back(id.value);
    for (const SnapshotPtr& s : ui.snapshots.list)
        if (!s->file.empty() && s->scene_file == file) memory.snapshots.push_back(std::filesystem::absolute(s->file).string());
    if (ui.farm.scene_file == file)
        for (const FarmPlan& plan : ui.farm.plans) {
            const auto in_strip = ui.farm.in_strip.find(plan.folder);
            if (plan.state != FarmPlan::State::making)
                memory.plans.push_back({plan.folder.string(), in_strip == ui.farm.in_strip.end() ? 0 : in_strip->second});
        }
    settings.scenes.insert(settings.scenes.begin(), std::move(memory));
    if (settings.scenes.size() > remembered_files) settings.scenes.resize(remembered_files);
}

void restore_scene_ui(const WindowSettings& settings, const std::string& file, const Scene& scene, UiState& ui) {
    ui.zoom = {};
    ui.selected = {};
    ui.also_selected.clear();
    ui.selected_material = {};
    ui.turned.clear();
    ui.light_mix.unfolded.clear();
    ui.light_mix.disabled_by_user = false;
    ui.bleed.point.reset(); // of another scene
    ui.bleed.rect.reset();
    ui.bleed.chosen = 0;
    const auto found = std::ranges::find(settings.scenes, file, &SceneMemory::file);
    if (found == settings.scenes.end()) return;
    if (found->zoom > 0)
        ui.zoom = {std::clamp(found->zoom, min_zoom, max_zoom), std::clamp(found->u, 0.0, 1.0), std::clamp(found->v, 0.0, 1.0)};
    for (const uint32_t id : found->selected) {
        if (!scene.nodes.contains({id}) || ui.is_selected({id})) continue;
        if (!ui.selected)
            ui.selected = {id};
        else
            ui.also_selected.push_back({id});
    }
    if (scene.materials.contains({found->material})) ui.selected_material = {found->material};
    for (const uint32_t id : found->turned)
        if (scene.nodes.contains({id})) ui.turned.insert({id});
    ui.light_mix.unfolded = found->mix_group;
}

} // namespace blush
