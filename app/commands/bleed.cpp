#include "app/commands/bleed.h"

#include "app/commands/common.h"
#include "app/commands/interrupt.h"
#include "app/commands/json_output.h"
#include "app/commands/load_scene.h"
#include "app/commands/progress.h"
#include "app/commands/render/render_options.h"
#include "core/text.h"
#include "measure/metrics/bleed_text.h"
#include "render/compile/surface_clearance.h"
#include "scene/affine.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace blush {
namespace {

struct BleedCommand {
    std::string scene, pixel, rect, point, normal, error;
    int64_t samples = 0; // 0: not given
    RenderOptions options;
    CommonOptions common;
};

constexpr double default_error = 0.01;
// Ends a measurement whose error does not fall.
constexpr int64_t most_paths = int64_t(1) << 22;
// Without any light by then, none arrives.
constexpr int64_t dark_paths = int64_t(1) << 17;
// Student's interval of few groups of batches is not reliable.
constexpr int64_t least_paths = 2 * 16 * bleed_batch_paths;

// N numbers between commas.
template <class T, size_t N> std::optional<std::array<T, N>> parse_numbers(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    std::array<T, N> numbers{};
    if (parts.size() != N) return {};
    for (size_t i = 0; i < N; ++i)
        if (!parse_number(parts[i], numbers[i])) return {};
    return numbers;
}
std::optional<Vec3d> parse_vector(std::string_view text) {
    const auto v = parse_numbers<double, 3>(text);
    if (!v || !std::isfinite((*v)[0] + (*v)[1] + (*v)[2])) return {};
    return Vec3d{(*v)[0], (*v)[1], (*v)[2]};
}

// "1%" or "0.01"
std::optional<double> parse_error(std::string_view text) {
    const bool percent = text.ends_with('%');
    double error = 0;
    if (!parse_number(percent ? text.substr(0, text.size() - 1) : text, error)) return {};
    if (percent) error /= 100;
    return error > 0 && error < 1 ? std::optional(error) : std::nullopt;
}

struct Request {
    RenderSettings settings;
    std::optional<PixelRect> pixels;
    std::optional<Vec3d> point, normal;
    double error = default_error; // stops when BleedReport::error() is this small; 0: never
    int64_t paths = most_paths;
};

Error unreadable(const char* option, const char* form, const std::string& text) {
    return {.what = fmt::format("{} must be {}, not \"{}\"", option, form, text)};
}

Result<void> read_place(const BleedCommand& c, Request& r) {
    if (int(!c.pixel.empty()) + int(!c.rect.empty()) + int(!c.point.empty()) != 1)
        return Error{.what = "bleed needs one of --pixel X,Y, --rect X,Y,W,H and --point X,Y,Z"};
    if (!c.normal.empty() && c.point.empty()) return Error{.what = "--normal is that of --point"};
    const auto pixel = parse_numbers<int, 2>(c.pixel);
    if (!c.pixel.empty() && !pixel) return unreadable("--pixel", "X,Y", c.pixel);
    const auto rect = parse_numbers<int, 4>(c.rect);
    if (!c.rect.empty() && (!rect || (*rect)[2] < 1 || (*rect)[3] < 1)) return unreadable("--rect", "X,Y,WIDTH,HEIGHT", c.rect);
    r.point = parse_vector(c.point);
    if (!c.point.empty() && !r.point) return unreadable("--point", "X,Y,Z in metres", c.point);
    r.normal = parse_vector(c.normal);
    if (!c.normal.empty() && (!r.normal || !(length(*r.normal) > 0))) return unreadable("--normal", "X,Y,Z", c.normal);
    if (pixel) r.pixels = PixelRect{(*pixel)[0], (*pixel)[1], (*pixel)[0] + 1, (*pixel)[1] + 1};
    if (rect) {
        const auto& [x, y, w, h] = *rect;
        const int width = r.settings.width, height = r.settings.height;
        if (x < 0 || y < 0 || w > width - x || h > height - y)
            return Error{.what = fmt::format("--rect {} is not within {}x{}", c.rect, width, height)};
        r.pixels = PixelRect{x, y, x + w, y + h};
    }
    if (pixel && (r.pixels->x0 < 0 || r.pixels->y0 < 0 || r.pixels->x0 >= r.settings.width || r.pixels->y0 >= r.settings.height))
        return Error{.what = fmt::format("--pixel {} is outside of {}x{}", c.pixel, r.settings.width, r.settings.height)};
    return {};
}

Result<Request> request_of(const BleedCommand& c) {
    Request r;
    const Result<RenderSettings> settings = settings_of(c.options);
    if (!settings) return settings.error();
    r.settings = *settings;
    if (const Result<void> place = read_place(c, r); !place) return place.error();
    if (c.samples > 0) {
        if (!c.error.empty()) return Error{.what = "bleed takes --error or --samples, not both"};
        r.error = 0;
        r.paths = c.samples;
    } else if (!c.error.empty()) {
        const std::optional<double> error = parse_error(c.error);
        if (!error) return unreadable("--error", "a share such as 1% or 0.01", c.error);
        r.error = *error;
    }
    return r;
}

// The surface next to the point, or the point itself with the given normal.
Result<BleedTarget> target_at(const Scene& scene, const Request& r) {
    const std::optional<RayHit> near = nearest_surface(scene, *r.point, to_double(scene.view.position));
    if (!near) return Error{.what = "there is no surface near --point"};
    BleedTarget target;
    target.kind = BleedTarget::Kind::incoming;
    target.position = r.normal ? *r.point : near->position;
    target.normal = r.normal ? normalize(*r.normal) : near->normal;
    target.clearance = surface_clearance(scene, *near);
    return target;
}

Result<std::vector<BleedTarget>> targets_of(const Scene& scene, const Request& r) {
    if (r.pixels) return std::vector{BleedTarget{.pixels = *r.pixels}};
    Result<BleedTarget> incoming = target_at(scene, r);
    if (!incoming) return incoming.error();
    BleedTarget outgoing = *incoming;
    outgoing.kind = BleedTarget::Kind::outgoing;
    return std::vector{*incoming, outgoing};
}

struct Measured {
    std::vector<BleedTarget> targets;
    std::vector<BleedReport> reports; // of the targets
    double seconds = 0;
    bool done = false; // the goal is reached
};

double error_of(const std::vector<BleedReport>& reports) {
    double error = 0;
    for (const BleedReport& report : reports)
        if (report.whole.value > 0 || (report.lit && report.paths < dark_paths)) error = std::max(error, report.error());
    return error;
}

Measured measure(const BleedCommand& c, const Request& r, const Scene& scene, const std::vector<BleedTarget>& targets,
                 const std::atomic<bool>& interrupted) {
    using Clock = std::chrono::steady_clock;
    Measured m;
    m.targets = targets;
    BleedProbe probe(c.common.threads);
    probe.begin(scene, r.settings, targets);
    const auto begun = Clock::now();
    Progress progress(c.common.quiet);
    while (!interrupted && !m.done && probe.paths() < r.paths && probe.round([&] { return !interrupted; })) {
        m.reports.clear();
        for (size_t i = 0; i < targets.size(); ++i) m.reports.push_back(probe.report(i));
        const double error = error_of(m.reports), paths = double(probe.paths());
        m.done = probe.paths() >= least_paths && error <= r.error;
        // The error falls with the square root of the number of paths.
        const double by_error = std::isfinite(error) && error > 0 ? r.error * r.error / (error * error) : 0;
        progress.update(std::min(0.99, r.error > 0 ? by_error : paths / double(r.paths)),
                        std::isfinite(error) ? fmt::format("± {:.2g} %", 100 * error) : std::string());
    }
    m.done = m.done || (r.error == 0 && probe.paths() >= r.paths);
    m.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
    return m;
}

// ---- JSON

OrderedJson interval_json(const Interval& i) {
    if (!i.known) return {{"value", i.value}, {"low", nullptr}, {"high", nullptr}};
    return {{"value", i.value}, {"low", i.low}, {"high", i.high}};
}
OrderedJson vector_json(const Vec3d& v) { return {v.x, v.y, v.z}; }

OrderedJson shift_json(const ColorShift& s) {
    return {{"u", interval_json(s.u)},
            {"v", interval_json(s.v)},
            {"length", interval_json(s.length)},
            {"towards", s.length.known ? OrderedJson(s.towards) : OrderedJson()},
            {"delta_e_hue", interval_json(s.hue)},
            {"delta_e", interval_json(s.delta_e)}};
}

const char* kind_text(SentBy by) { return by == SentBy::itself ? "itself" : by == SentBy::light ? "light" : "object"; }

OrderedJson share_json(const BleedShare& row, bool sender) {
    OrderedJson json;
    json["name"] = row.name;
    if (sender) json["kind"] = kind_text(row.by);
    json["luminance"] = interval_json(row.light);
    json["share"] = interval_json(row.share);
    json["rgb"] = vector_json(row.rgb);
    json["shift"] = shift_json(row.shift);
    if (sender) json[row.infinite ? "direction" : "place"] = vector_json(row.place);
    return json;
}

OrderedJson report_json(const BleedReport& report, BleedTarget::Kind kind, const RenderSettings& settings) {
    OrderedJson json;
    json["quantity"] = kind == BleedTarget::Kind::incoming ? "irradiance" : "radiance";
    json["unit"] = kind == BleedTarget::Kind::incoming ? "lx" : "nits";
    json["luminance"] = interval_json(report.whole);
    json["rgb"] = vector_json(report.rgb);
    json["place"] = report.has_place ? vector_json(report.place) : OrderedJson();
    json["direct"] = share_json(report.direct, false);
    json["indirect"] = share_json(report.indirect, false);
    for (const char* list : {"senders", "lights", "bounces"}) json[list] = OrderedJson::array();
    for (const BleedShare& row : report.senders) json["senders"].push_back(share_json(row, true));
    for (const BleedShare& row : report.lights) json["lights"].push_back(share_json(row, false));
    for (const BleedShare& row : report.bounces) json["bounces"].push_back(share_json(row, false));
    json["summary"] = summary_of(report, kind);
    json["not_included"] = limits_of(report, settings);
    json["error"] = report.error();
    json["dropped"] = report.dropped;
    return json;
}

OrderedJson bleed_json(const BleedCommand& c, const Request& r, const Measured& m) {
    OrderedJson json;
    json["scene"] = c.scene;
    json["width"] = r.settings.width;
    json["height"] = r.settings.height;
    json["paths"] = m.reports.front().paths;
    json["seconds"] = m.seconds;
    json["complete"] = m.done;
    json["results"] = OrderedJson::array();
    for (size_t i = 0; i < m.reports.size(); ++i) json["results"].push_back(report_json(m.reports[i], m.targets[i].kind, r.settings));
    return json;
}

// ---- text

void print_rows(const char* title, const std::vector<BleedShare>& rows, BleedTarget::Kind kind, bool senders) {
    fmt::print("\n{}\n", title);
    for (const BleedShare& row : rows) {
        const std::string name = senders && row.by == SentBy::light ? row.name + ", direct" : row.name;
        fmt::print("  {:<28} {:>18}   {}\n", name, percent_text(row.share), light_text(row.light, kind));
    }
}

void print_report(const BleedReport& report, BleedTarget::Kind kind, const RenderSettings& settings) {
    const char* title = kind == BleedTarget::Kind::incoming   ? "Light that arrives"
                        : kind == BleedTarget::Kind::outgoing ? "Light towards the camera"
                                                              : "Light that the camera sees";
    fmt::print("\n{}: {}\n{}\n", title, light_text(report.whole, kind), summary_of(report, kind));
    for (const BleedShare& row : report.senders)
        if (row.by == SentBy::object && row.share.value >= 0.01) fmt::print("{}\n", sentence_of(row, kind));
    print_rows("Sent by", report.senders, kind, true);
    print_rows("From light", report.lights, kind, false);
    print_rows("Scattered", report.bounces, kind, false);
    const std::vector<std::string> limits = limits_of(report, settings);
    if (!limits.empty()) fmt::print("\nNot included\n");
    for (const std::string& limit : limits) fmt::print("  {}\n", limit);
}

std::string place_text(const Request& r, const std::vector<BleedTarget>& targets) {
    const BleedTarget& t = targets.front();
    const auto metres = [](const Vec3d& v) { return fmt::format("{:.4g}, {:.4g}, {:.4g}", v.x, v.y, v.z); };
    if (!r.pixels) return fmt::format("point {} with the normal {}", metres(t.position), metres(t.normal));
    const PixelRect& p = *r.pixels;
    if (p.x1 - p.x0 == 1 && p.y1 - p.y0 == 1) return fmt::format("pixel {}, {} of {}x{}", p.x0, p.y0, r.settings.width, r.settings.height);
    return fmt::format("{}x{} pixels from {}, {} of {}x{}", p.x1 - p.x0, p.y1 - p.y0, p.x0, p.y0, r.settings.width, r.settings.height);
}

void print_measured(const BleedCommand& c, const Request& r, const Measured& m) {
    fmt::print("{}: {}, {} paths in {:.2f} s", c.scene, place_text(r, m.targets), m.reports.front().paths, m.seconds);
    if (!m.done) fmt::print(", stopped at ± {:.2g} %", 100 * error_of(m.reports));
    fmt::print("\n");
    for (size_t i = 0; i < m.reports.size(); ++i) print_report(m.reports[i], m.targets[i].kind, r.settings);
}

int run_bleed(BleedCommand c) {
    Result<Request> request = request_of(c);
    if (!request) return bad_usage(request.error().text());
    const InterruptGuard guard;
    Result<LoadedScene> loaded = [&] {
        Progress progress(c.common.quiet);
        const float aspect = float(request->settings.width) / float(request->settings.height);
        return load_scene(c.scene, c.options.overrides, aspect, progress, guard.interrupted());
    }();
    if (!loaded) return failed(loaded.error());
    if (loaded->camera_aspect > 0 && !(c.options.width_given && c.options.height_given)) {
        follow_aspect(c.options, loaded->camera_aspect);
        request = request_of(c);
        if (!request) return bad_usage(request.error().text());
    }
    if (!c.common.quiet) print_warnings(c.scene, loaded->report.diagnostics);
    const Result<std::vector<BleedTarget>> targets = targets_of(loaded->scene, *request);
    if (!targets) return failed(in_file(targets.error(), c.scene));
    const Measured measured = measure(c, *request, loaded->scene, *targets, guard.interrupted());
    if (measured.reports.empty()) return failed({.file = c.scene, .what = "interrupted before the first result"});
    if (const Result<void> written = write_json(c.common.json, bleed_json(c, *request, measured)); !written) return failed(written.error());
    if (!c.common.quiet && c.common.json != "-") print_measured(c, *request, measured);
    return exit_done;
}

} // namespace

void add_bleed_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<BleedCommand>();
    CLI::App* sub = app.add_subcommand("bleed", "Measure who lights a pixel, a rectangle or a surface point, and how its colour bleeds");
    sub->add_option("scene", command->scene, "glTF file (.gltf, .glb)")->required()->type_name("SCENE");
    sub->add_option("--pixel", command->pixel, "Probe the light that the camera sees in this pixel")->type_name("X,Y");
    sub->add_option("--rect", command->rect, "Probe the mean of a rectangle of pixels")->type_name("X,Y,W,H");
    sub->add_option("--point", command->point,
                    "Probe the light that arrives at the surface point nearest to this one, in metres, and leaves it towards the camera")
        ->type_name("X,Y,Z");
    sub->add_option("--normal", command->normal, "Take --point as it is, facing this way [the nearest surface, facing the camera]")
        ->type_name("X,Y,Z");
    sub->add_option("--error", command->error,
                    "Stop when the 95 % interval of the whole and of each sender is at most this share of the whole to either side [1%]")
        ->type_name("E");
    sub->add_option("--samples", command->samples, "Stop at N paths instead, rounded up to a whole round")
        ->check(CLI::Range(int64_t(1), most_paths))
        ->type_name("N");
    add_probe_options(*sub, command->options);
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_bleed(*command); }; });
}

} // namespace blush
