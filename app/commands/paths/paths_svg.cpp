#include "app/commands/paths/paths_svg.h"

#include "app/commands/base64.h"
#include "core/math.h"
#include "measure/plot/plot_svg.h"
#include "render/compile/render_scene.h"
#include "scene/affine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace blush {
namespace {

struct Point {
    double x = 0, y = 0;
};

// The camera of the render, in pixels of its image.
struct Projector {
    CameraRecord camera;
    double width, height;
    static constexpr double near = 1e-3; // metres

    Vec3d in_camera(const Vec3d& world) const {
        const Vec3d d = world - to_double(camera.position), right = to_double(camera.right), up = to_double(camera.up);
        return {dot(d, right) / dot(right, right), dot(d, up) / dot(up, up), dot(d, to_double(camera.forward))};
    }
    Point on_film(const Vec3d& c) const {
        const double over = camera.orthographic ? 1 : c.z;
        return {(1 + c.x / over) / 2 * width, (1 - c.y / over) / 2 * height};
    }
    // The part of a segment before the camera.
    std::optional<std::pair<Point, Point>> line(const Vec3d& from, const Vec3d& to) const {
        Vec3d a = in_camera(from), b = in_camera(to);
        if (a.z < near && b.z < near) return {};
        const auto clip = [](Vec3d& behind, const Vec3d& before) {
            behind = behind + (before - behind) * ((near - behind.z) / (before.z - behind.z));
        };
        if (a.z < near) clip(a, b);
        if (b.z < near) clip(b, a);
        return std::pair{on_film(a), on_film(b)};
    }
};

// A linear colour at full brightness, display-encoded.
std::string hue(const Vec3& linear) {
    const float largest = max_component(linear);
    const auto byte = [&](float x) {
        return largest > 0 ? int(std::lround(255 * std::pow(std::clamp(x / largest, 0.f, 1.f), 1 / 2.2f))) : 128;
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(linear.x), byte(linear.y), byte(linear.z));
}

struct Drawing {
    const Projector& projector;
    double unit; // width of a thin line, pixels
    std::string text;

    void line(const Vec3d& from, const Vec3d& to, const std::string& color, double width, bool dashed) {
        const auto seen = projector.line(from, to);
        if (!seen) return;
        const auto& [a, b] = *seen;
        text += fmt::format("<path d='M{:.2f} {:.2f}L{:.2f} {:.2f}' stroke='{}' stroke-width='{:.2f}'{}/>\n", a.x, a.y, b.x, b.y, color,
                            width * unit, dashed ? fmt::format(" stroke-dasharray='{0:.1f} {0:.1f}'", 4 * unit) : "");
    }
    std::optional<Point> at(const Vec3d& world) const {
        const Vec3d c = projector.in_camera(world);
        return c.z < Projector::near ? std::nullopt : std::optional(projector.on_film(c));
    }
    void cross(const Vec3d& world, const std::string& color, const std::string& label) {
        const auto p = at(world);
        if (!p) return;
        const double r = 3.5 * unit;
        text += fmt::format("<path d='M{:.2f} {:.2f}L{:.2f} {:.2f}M{:.2f} {:.2f}L{:.2f} {:.2f}' stroke='{}' stroke-width='{:.2f}'/>\n",
                            p->x - r, p->y - r, p->x + r, p->y + r, p->x - r, p->y + r, p->x + r, p->y - r, color, 1.5 * unit);
        if (!label.empty())
            text +=
                fmt::format("<text x='{:.2f}' y='{:.2f}' fill='{}'>{}</text>\n", p->x + 1.5 * r, p->y + r, color, escaped_markup(label));
    }
    void square(const Vec3d& world, const std::string& color) {
        const auto p = at(world);
        if (!p) return;
        const double r = 2.5 * unit;
        text += fmt::format("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' fill='none' stroke='{}' stroke-width='{:.2f}'/>\n",
                            p->x - r, p->y - r, 2 * r, 2 * r, color, unit);
    }
};

constexpr const char* blocked_color = "#ff4040";

void draw_path(Drawing& d, const RecordedPath& path, double width) {
    d.text += fmt::format("<g id='sample-{}'>\n", path.sample);
    for (size_t k = 0; k < path.vertices.size(); ++k) {
        const PathVertex& v = path.vertices[k];
        if (k > 0) d.line(path.vertices[k - 1].position, v.position, hue(v.arriving), width, false);
        if (std::isinf(v.pdf)) d.square(v.position, hue(v.arriving));
        if (v.next_event) {
            const NextEvent& e = *v.next_event;
            d.line(v.position, e.to, e.blocked ? blocked_color : hue(e.arrived), 0.7, true);
            if (e.blocked && !e.blocker.empty()) d.cross(e.to, blocked_color, "");
        }
        if (v.end == PathEnd::roulette) d.cross(v.position, "#ffffff", fmt::format("q {:.2g}", v.survival));
    }
    d.text += "</g>\n";
}

} // namespace

std::string paths_svg(const PixelPaths& p, std::span<const uint8_t> picture_png) {
    const int width = p.settings.width, height = p.settings.height;
    const Projector projector{camera_record(p.scene.view, float(width) / float(height), {0, 0, 0}), double(width), double(height)};
    const double unit = std::max(width, height) / 900.0;
    Drawing d{projector, unit, {}};
    float brightest = 0;
    for (const RecordedPath& path : p.paths) brightest = std::max(brightest, luminance(path.radiance));
    for (const RecordedPath& path : p.paths) {
        const float light = luminance(path.radiance);
        draw_path(d, path, brightest > 0 && light > 0 ? 0.8 + 2.2 * std::sqrt(double(light / brightest)) : 0.8);
    }
    return fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='{0}' height='{1}' viewBox='0 0 {0} {1}' "
        "font-family='sans-serif' font-size='{2:.1f}'>\n<title>{3}</title>\n"
        "<image width='{0}' height='{1}' opacity='0.6' xlink:href='data:image/png;base64,{4}'/>\n"
        "<g fill='none' stroke-linecap='round'>\n{5}</g>\n"
        "<circle cx='{6}' cy='{7}' r='{8:.2f}' fill='none' stroke='#ffffff' stroke-width='{9:.2f}'/>\n</svg>\n",
        width, height, 11 * unit,
        escaped_markup(
            fmt::format("{}: pixel {},{}, samples {} to {}", p.scene_file, p.x, p.y, p.settings.first_sample, p.settings.spp - 1)),
        base64(picture_png), d.text, p.x + 0.5, p.y + 0.5, 5 * unit, unit);
}

} // namespace blush
