#include "app/commands/lesson/states.h"

#include "app/commands/load_scene.h"
#include "app/commands/progress.h"

#include <fmt/format.h>

#include <map>

namespace blush {
namespace {

Error at_line(const Lesson& lesson, size_t line, const std::string& what) {
    return {.file = fmt::format("{}:{}", lesson.file.string(), line + 1), .what = what};
}

Result<void> check_places(const Lesson& lesson, const LessonStep& step, const RenderSettings& settings) {
    for (const LessonClaim& claim : step.claims) {
        const auto& [x, y, w, h] = claim.rect;
        if (claim.setting.empty() && (x + w > settings.width || y + h > settings.height))
            return at_line(lesson, claim.line,
                           fmt::format("the rectangle {},{},{},{} is not within {}x{}", x, y, w, h, settings.width, settings.height));
    }
    return {};
}

} // namespace

ViewSettings view_in_window(const LessonStep& step, ViewSettings view) {
    if (!step.settings.contains("exposure") && !step.settings.contains("auto-exposure")) view.auto_exposure = AutoExposure::average;
    return view;
}

Result<std::vector<Project>> states_of(const Lesson& lesson, Progress& progress, const std::atomic<bool>& interrupted) {
    std::map<std::filesystem::path, ImportedScene> scenes;
    std::vector<Project> states;
    for (const LessonStep& step : lesson.steps) {
        const size_t scene_line = step.lines.at("scene");
        if (!scenes.contains(step.file)) {
            Result<ImportedScene> imported = import_scene(step.file, {}, progress, interrupted);
            if (!imported) return at_line(lesson, scene_line, imported.error().text());
            scenes.emplace(step.file, *std::move(imported));
        }
        Result<RenderOptions> options = options_of_step(step);
        if (!options) return at_line(lesson, step.line, options.error().text());
        if (!options->size_given) {
            options->settings.width = claim_width;
            options->settings.height = claim_height;
        }
        RenderSettings& settings = options->settings;
        if (const Result<void> inside = check_places(lesson, step, settings); !inside) return inside.error();
        const float aspect = float(settings.width) / float(settings.height);
        Result<LoadedScene> loaded = overridden(scenes.at(step.file), step.file, options->overrides, aspect);
        const size_t camera_line = step.lines.contains("camera") ? step.lines.at("camera") : scene_line;
        if (!loaded) return at_line(lesson, camera_line, loaded.error().what);
        states.push_back({std::move(loaded->scene), settings, options->view});
    }
    return states;
}

} // namespace blush
