// Entry point. Exit codes: 0 done, 1 failed (one line on stderr), 2 bad usage.
#include "app/commands/bleed.h"
#include "app/commands/check.h"
#include "app/commands/common.h"
#include "app/commands/compare.h"
#include "app/commands/converge/converge.h"
#include "app/commands/denoise.h"
#include "app/commands/info.h"
#include "app/commands/lesson/lesson.h"
#include "app/commands/merge.h"
#include "app/commands/paths/paths.h"
#include "app/commands/plan/plan.h"
#include "app/commands/render/render.h"
#include "app/commands/render/render_options.h"
#include "app/common/assets_dir.h"
#include "app/common/process_setup.h"
#include "app/editor/editor.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <memory>

namespace blush {
namespace {

struct EditorCommand {
    std::string scene;
    RenderOptions options;
    CommonOptions common;
    bool exposure_given = false;
};

int edit(const EditorCommand& c) {
    const Result<RenderSettings> settings = settings_of(c.options);
    if (!settings) return bad_usage(settings.error().text());
    EditorOptions editor;
    editor.assets = assets_dir();
    editor.settings_given = *settings != *settings_of(RenderOptions{});
    editor.view_given = c.exposure_given || c.options.view != ViewSettings{};
    editor.exposure_given = c.exposure_given;
    editor.weights = weights_dir();
    editor.scene = c.scene;
    editor.render = *settings;
    // In the window, rendering has no sample limit by default.
    if (!c.options.spp_given && !c.options.samples_given && settings->spp > 0) editor.render.spp = 1024;
    editor.view = c.options.view;
    editor.overrides = c.options.overrides;
    editor.denoise = c.options.denoise.has_value(); // the session chooses the quality by the available time
    editor.follow_viewport = !c.options.size_given;
    editor.threads = c.common.threads;
    return run_editor(editor);
}

// Without a command the program is the editor, which also accepts the options of `render`.
void add_editor(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<EditorCommand>();
    app.add_option("scene", command->scene, "Scene to open in the editor (.gltf, .glb) [card-and-mug]")->type_name("SCENE");
    add_render_options(app, command->options);
    add_common_options(app, command->common);
    run = [command, &app] {
        command->exposure_given = app.count("--exposure") + app.count("--auto-exposure") > 0;
        return edit(*command);
    };
}

int run_command_line(int argc, char** argv) {
    CLI::App app("Blush: an interactive lighting editor for glTF scenes.\nWithout a command it opens the editor.", "blush");
    app.set_version_flag("--version", std::string("blush " BLUSH_VERSION));
    app.set_help_flag("--help,-h", "Print this help");
    app.require_subcommand(0, 1); // a word after a command is its argument, even if it is the name of another: blush plan merge
    std::function<int()> run;
    add_editor(app, run);
    add_render_command(app, run);
    add_compare_command(app, run);
    add_check_command(app, run);
    add_converge_command(app, run);
    add_info_command(app, run);
    add_denoise_command(app, run);
    add_merge_command(app, run);
    add_plan_command(app, run);
    add_paths_command(app, run);
    add_bleed_command(app, run);
    add_lesson_command(app, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) { return bad_usage(error.what()); }
    if (const std::string wrong = option_as_value(app); !wrong.empty()) return bad_usage(wrong);
    return run();
}

} // namespace
} // namespace blush

int main(int argc, char** argv) {
    blush::set_up_process();
    try {
        return blush::run_command_line(argc, argv);
    } catch (const std::bad_alloc& error) {
        return blush::failed({.what = blush::what_was_missing(error)});
    } catch (const std::exception& error) { return blush::failed({.what = error.what()}); }
}
