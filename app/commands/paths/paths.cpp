#include "app/commands/paths/paths.h"

#include "app/commands/common.h"
#include "app/commands/interrupt.h"
#include "app/commands/json_output.h"
#include "app/commands/load_scene.h"
#include "app/commands/paths/paths_json.h"
#include "app/commands/paths/paths_obj.h"
#include "app/commands/paths/paths_svg.h"
#include "app/commands/progress.h"
#include "app/commands/render/render_options.h"
#include "app/commands/render/write_image.h"
#include "core/files.h"
#include "core/text.h"
#include "io/image/image_io.h"
#include "render/diagnostics/path_arithmetic.h"
#include "render/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace blush {

double relative_difference(const PixelPaths& p) {
    const Vec3d off = p.sum.mean - p.film;
    const double scale = std::max({std::abs(p.film.x), std::abs(p.film.y), std::abs(p.film.z)});
    return scale > 0 ? std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) / scale : 0;
}

namespace {

constexpr int64_t most_paths = 100000;  // each takes some kilobytes
constexpr size_t printed_paths = 16;    // in plain text
constexpr int64_t picture_samples = 16; // of the picture in an SVG

struct PathsCommand {
    std::string scene, pixel, svg, obj;
    RenderOptions options;
    CommonOptions common;
};

// The settings of the replay: those of `blush render`, without adaptive sampling, which would choose the samples itself.
Result<RenderSettings> replay_settings(const PathsCommand& c) {
    Result<RenderSettings> settings = settings_of(c.options);
    if (!settings) return settings.error();
    if (settings->seconds > 0 || settings->error > 0) return Error{.what = "paths takes --samples or --spp, no --time or --error"};
    if (c.options.region) return Error{.what = "paths takes --pixel, no --region"};
    if (c.options.denoise) return Error{.what = "paths writes no image to denoise"};
    if (c.options.adaptive_given && settings->adaptive)
        return Error{.what = "paths replays given samples: adaptive sampling chooses its own"};
    if (settings->spp - settings->first_sample > most_paths)
        return Error{.what = fmt::format("paths replays at most {} samples", most_paths)};
    settings->adaptive = false;
    return settings;
}

Result<std::pair<int, int>> parse_pixel_position(std::string_view text, const RenderSettings& settings) {
    const std::vector<std::string_view> parts = split(text, ',');
    int x = 0, y = 0;
    if (parts.size() != 2 || !parse_number(parts[0], x) || !parse_number(parts[1], y))
        return Error{.what = fmt::format("--pixel must be X,Y, not \"{}\"", text)};
    if (x < 0 || x >= settings.width || y < 0 || y >= settings.height)
        return Error{.what = fmt::format("--pixel {},{} is outside of {}x{}", x, y, settings.width, settings.height)};
    return std::pair{x, y};
}

// What the film holds of the pixel for these samples.
Result<Vec3d> film_pixel(const PixelPaths& p, RenderSettings settings, unsigned threads, const std::atomic<bool>& interrupted) {
    const float w = float(settings.width), h = float(settings.height);
    settings.region = {float(p.x) / w, float(p.y) / h, 1 / w, 1 / h};
    Renderer renderer({.threads = threads});
    renderer.update(p.scene, settings);
    if (!renderer.render(settings.first_sample, settings.spp - settings.first_sample, [&] { return !interrupted; }))
        return Error{p.scene_file, "interrupted", ""};
    const Frame frame = renderer.resolve();
    const float* rgba = &frame.rgba[4 * (size_t(p.y) * size_t(frame.width) + size_t(p.x))];
    return Vec3d{rgba[0], rgba[1], rgba[2]};
}

RenderSettings as_replayed(RenderSettings settings) {
    settings.reuse = 1;
    settings.smooth_edges = false;
    settings.clamp = {};
    return settings;
}

Result<PixelPaths> replay(const PathsCommand& c, Scene scene, const RenderSettings& settings, int x, int y,
                          const std::atomic<bool>& interrupted) {
    PixelPaths p{.scene_file = c.scene, .scene = std::move(scene), .settings = settings, .x = x, .y = y};
    const Error stopped{c.scene, "interrupted", ""};
    Progress progress(c.common.quiet);
    const auto wanted = [&] { return !interrupted; };
    progress.update(0, "pilots");
    PathRecorder recorder(c.common.threads);
    recorder.update(p.scene, settings);
    if (settings.spp > 1 && !recorder.decide(wanted)) return stopped;
    // In parts, for the progress: light paths can take seconds for each sample.
    const int64_t count = settings.spp - settings.first_sample, part = std::max<int64_t>(count / 50, 1);
    for (int64_t done = 0; done < count;) {
        const int64_t next = std::min(part, count - done);
        auto paths = recorder.record(x, y, settings.first_sample + done, next, true, wanted);
        if (!paths) return stopped;
        std::ranges::move(*paths, std::back_inserter(p.paths));
        done += next;
        progress.update(0.5 * double(done) / double(count), fmt::format("{} paths", done));
    }
    p.sum = sum_of(p.paths);
    p.left_out = recorder.not_replayed();
    const Result<Vec3d> film = film_pixel(p, as_replayed(settings), c.common.threads, interrupted);
    if (!film) return film.error();
    p.film = *film;
    if (!p.left_out.empty()) {
        progress.update(0.75, "image");
        const Result<Vec3d> image = film_pixel(p, settings, c.common.threads, interrupted);
        if (!image) return image.error();
        p.image = *image;
    }
    return p;
}

// The scene as the render camera sees it, behind the paths of an SVG.
Result<std::vector<uint8_t>> picture_of(const PixelPaths& p, const ViewSettings& view, const ColorManagement& color, unsigned threads) {
    RenderSettings settings = recommended_settings();
    settings.width = p.settings.width;
    settings.height = p.settings.height;
    Renderer renderer({.threads = threads});
    renderer.update(p.scene, settings);
    renderer.render(0, picture_samples);
    const Frame frame = renderer.resolve();
    std::vector<float> rgb = beauty_rgb(frame);
    if (Result<void> shown = show(color, view, rgb); !shown) return shown.error();
    return encode_png(frame.width, frame.height, rgb);
}

Result<void> write_files(const PathsCommand& c, const PixelPaths& p, const ColorManagement* color) {
    if (const Result<void> written = write_json(c.common.json, paths_json(p)); !written) return written.error();
    if (!c.obj.empty())
        if (const Result<void> written = write_file(c.obj, paths_obj(p)); !written) return written.error();
    if (c.svg.empty()) return {};
    const Result<std::vector<uint8_t>> picture = picture_of(p, c.options.view, *color, c.common.threads);
    if (!picture) return in_file(picture.error(), c.svg);
    return write_file(c.svg, paths_svg(p, *picture));
}

std::string rgb_text(const Vec3d& c) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", c.x, c.y, c.z); }

void print_paths(const PixelPaths& p) {
    for (size_t k = 0; k < std::min(p.paths.size(), printed_paths); ++k) fmt::print("{}", path_text(p.paths[k], main_channel(p.paths[k])));
    if (p.paths.size() > printed_paths) fmt::print("... {} more samples; --json has all\n", p.paths.size() - printed_paths);
    fmt::print("mean of {} samples {}\n", p.sum.paths, rgb_text(p.sum.mean));
    if (p.sum.invalid > 0) fmt::print("{} samples are not finite or negative: the film leaves them out\n", p.sum.invalid);
    for (size_t k = 0; k < p.sum.by_strategy.size(); ++k)
        if (p.sum.by_strategy[k] != Vec3d{0, 0, 0}) fmt::print("  {:12} {}\n", found_by_names[k], rgb_text(p.sum.by_strategy[k]));
    fmt::print("film of these samples {}, relative difference {:.1e}\n", rgb_text(p.film), relative_difference(p));
    for (const std::string& what : p.left_out) fmt::print("not replayed: {}\n", what);
    if (p.image) fmt::print("image with that {}\n", rgb_text(*p.image));
}

Result<RenderSettings> fitted_settings(PathsCommand& c, float camera_aspect) {
    follow_aspect(c.options, camera_aspect);
    return replay_settings(c);
}

int run_paths(PathsCommand c) {
    Result<RenderSettings> settings = replay_settings(c);
    if (!settings) return bad_usage(settings.error().text());
    for (const std::string* file : {&c.svg, &c.obj})
        if (!file->empty())
            if (const Result<void> folder = expect_folder(*file); !folder) return failed(folder.error());
    const Result<std::optional<ColorManagement>> color = color_for(c.svg.empty() ? ImageFormat::exr : ImageFormat::display, c.options.view);
    if (!color) return failed(color.error());
    const InterruptGuard guard;
    Result<LoadedScene> loaded = [&] {
        Progress progress(c.common.quiet);
        return load_scene(c.scene, c.options.overrides, float(settings->width) / float(settings->height), progress, guard.interrupted());
    }();
    if (!loaded) return failed(loaded.error());
    settings = fitted_settings(c, loaded->camera_aspect);
    if (!settings) return bad_usage(settings.error().text());
    const Result<std::pair<int, int>> pixel = parse_pixel_position(c.pixel, *settings);
    if (!pixel) return bad_usage(pixel.error().text());
    if (!c.common.quiet) print_warnings(c.scene, loaded->report.diagnostics);
    const Result<PixelPaths> paths = replay(c, std::move(loaded->scene), *settings, pixel->first, pixel->second, guard.interrupted());
    if (!paths) return failed(paths.error());
    if (const Result<void> written = write_files(c, *paths, *color ? &**color : nullptr); !written) return failed(written.error());
    if (!c.common.quiet && c.common.json != "-") print_paths(*paths);
    return exit_done;
}

} // namespace

void add_paths_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<PathsCommand>();
    CLI::App* sub = app.add_subcommand("paths", "Replay samples of one pixel and write all vertices of their paths");
    sub->add_option("scene", command->scene, "glTF file (.gltf, .glb)")->required()->type_name("SCENE");
    sub->add_option("--pixel", command->pixel, "The pixel, from the upper left corner")->required()->type_name("X,Y");
    sub->add_option("--svg", command->svg, "Write the paths over a picture of the scene, as the render camera sees them")
        ->type_name("FILE");
    sub->add_option("--obj", command->obj, "Write the paths as lines in the scene, in metres, for other programs")->type_name("FILE");
    add_render_options(*sub, command->options);
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_paths(*command); }; });
}

} // namespace blush
