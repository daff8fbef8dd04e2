#include "tests/render/lights/lamp_rooms.h"

#include "render/integrator/kernel_settings.h"
#include "render/kernels/kernel.h"
#include "scene/changes.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace blush::test {
namespace {

constexpr int size = 32, samples = 16;

} // namespace

Transform stretched(const Vec3& position, const Vec3& scale) {
    Transform t = aimed(position, {0.3f, -0.5f, -1});
    t.scale = scale;
    return t;
}

Material glow(bool two_sided) {
    Material m = emitter(3);
    m.double_sided = two_sided;
    return m;
}

Scene room() {
    Scene scene;
    place(scene, floor_quad(4, -2), lambert(0.6f));
    place(scene, quad({-4, -2, -4}, {4, -2, -4}, {4, 4, -4}, {-4, 4, -4}), plastic(0.3f));
    place(scene, cube(false), lambert(0.4f), at({-1.8f, -1.5f, 0.2f}, 0.5f));
    scene.view = looking({0.5f, 1, 6}, {0, -0.3f, 0}, 0.9f);
    return scene;
}

CompiledLamps::CompiledLamps(const Scene& s) : settings(settings_for(size, size, samples)), expanded(expand_area_lights(s)) {
    settings.reuse = 1;
    scene.update(expanded, settings, full_plan(), workers);
}

void CompiledLamps::follow(const Scene& edited) {
    Scene after = expand_area_lights(edited);
    scene.update(after, settings, plan(diff(expanded, settings, after, settings)), workers);
    expanded = std::move(after);
}

std::vector<ClearanceBox> CompiledLamps::boxes() const {
    const LightTables& t = scene.tables().lights;
    int32_t last = -1;
    for (int32_t i = 0; i < t.count; ++i) last = std::max(last, t.lights[i].clearance);
    return t.clearances ? std::vector<ClearanceBox>(t.clearances, t.clearances + last + 1) : std::vector<ClearanceBox>{};
}

std::vector<bool> CompiledLamps::clear() const {
    std::vector<bool> all;
    for (const ClearanceBox& box : boxes()) all.push_back(std::isfinite(box.low.x));
    return all;
}

int64_t CompiledLamps::numbered_records() const {
    const LightTables& t = scene.tables().lights;
    return std::count_if(t.lights, t.lights + t.count, [](const LightRecord& light) { return light.clearance >= 0; });
}

std::vector<double> CompiledLamps::render(bool whole_rays) const {
    SceneTables tables = scene.tables();
    if (whole_rays) tables.lights.clearances = nullptr;
    const KernelContext context{&tables, &scene.accel(), kernel_settings(settings, size, size), settings.seed};
    const auto scratch = std::make_unique<TileScratch>();
    std::vector<double> values;
    for (int first = 0; first < samples; ++first) {
        const TileJob job{0, 0, size, size, first, 1};
        workers.run([&] { choose_kernel(scene.features()).render(context, job, *scratch); });
        for (const Column<double>* column : {&scratch->r, &scratch->g, &scratch->b})
            values.insert(values.end(), column->data, column->data + job.paths());
    }
    return values;
}

} // namespace blush::test
