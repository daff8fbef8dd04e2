#include "render/diagnostics/path_arithmetic.h"

#include "core/math.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

std::string digits(float x) { return fmt::format("{:.4g}", x); }

// The product of the factors so far.
struct Product {
    RgbChannel channel;
    std::string text = {};

    float of(const Vec3& color) const { return channel_of(color, channel); }
    void times(float factor) { text += (text.empty() ? "" : " x ") + digits(factor); }
    void over(float divisor) { text += " / " + digits(divisor); }
    // What the path carries behind a vertex, or up to it.
    void pass(const PathVertex& v) {
        if (const float passed = of(v.passed); passed != 1) times(passed);
    }
    void scatter(const PathVertex& v) {
        times(of(v.factor));
        if (v.roulette && v.survival != 1) over(v.survival);
    }
};

struct Terms {
    RgbChannel channel;
    std::vector<PathTerm> all = {};

    float of(const Vec3& color) const { return channel_of(color, channel); }
    // `weighted`: the contribution; `sent`: before the MIS weight.
    void add(size_t vertex, FoundBy by, const Product& product, float radiance, float mis, float value, bool blocked) {
        Product whole = product;
        whole.times(radiance);
        std::string text = whole.text;
        const float sent = mis > 0 ? value / mis : 0;
        if (text.find(" x ") != std::string::npos || text.find(" / ") != std::string::npos) text += " = " + digits(sent);
        if (mis != 1) text += fmt::format("; x {} (MIS weight) = {}", digits(mis), digits(value));
        if (blocked) text += "; blocked = 0";
        all.push_back({vertex, by, std::move(text), blocked ? 0 : value});
    }
    void add_lump(size_t vertex, FoundBy by, const Vec3& light, const char* what) {
        if (of(light) != 0) all.push_back({vertex, by, fmt::format("{} ({})", digits(of(light)), what), of(light)});
    }
    void add_next_event(size_t k, const NextEvent& e, Product product) {
        if (of(e.sent) == 0) return;
        product.times(of(e.f_cos) / e.light_pdf);
        const float sent = of(e.sent), arrived = of(e.arrived);
        add(k, FoundBy::nee, product, of(e.radiance), e.mis, sent, e.blocked);
        if (e.blocked || !(arrived < 0.9999f * sent)) return;
        all.back().text += fmt::format("; x {} (panes and blended surfaces) = {}", digits(arrived / sent), digits(arrived));
        all.back().value = arrived;
    }
};

} // namespace

std::string_view to_string(RgbChannel channel) {
    constexpr std::string_view names[] = {"red", "green", "blue"};
    return names[size_t(channel)];
}

float channel_of(const Vec3& color, RgbChannel channel) {
    return channel == RgbChannel::red ? color.x : channel == RgbChannel::green ? color.y : color.z;
}

RgbChannel main_channel(const RecordedPath& path) {
    const auto largest = [](const Vec3& c) {
        return c.x >= c.y && c.x >= c.z ? RgbChannel::red : c.y >= c.z ? RgbChannel::green : RgbChannel::blue;
    };
    if (max_component(path.radiance) > 0 || path.vertices.empty()) return largest(path.radiance);
    return largest(path.vertices.back().arriving);
}

std::vector<PathTerm> terms_of(const RecordedPath& path, RgbChannel channel) {
    Terms terms{channel};
    Product product{channel};
    for (size_t k = 0; k < path.vertices.size(); ++k) {
        const PathVertex& v = path.vertices[k];
        terms.add_lump(k, FoundBy::camera_hit, v.panes, "emission of panes");
        terms.add_lump(k, FoundBy::camera_hit, v.past, "background behind blended surfaces");
        product.pass(v);
        const FoundBy found = v.guided > 0.5f ? FoundBy::guided : FoundBy::camera_hit;
        if (v.emits && terms.of(v.emission) != 0)
            terms.add(k, found, product, terms.of(v.radiance), v.emission_mis, terms.of(v.emission), false);
        if (v.next_event) terms.add_next_event(k, *v.next_event, product);
        terms.add_lump(k, FoundBy::manifold, v.chains, "manifold sampling");
        terms.add_lump(k, FoundBy::light_vertex, v.light_vertices, "light vertices");
        if (v.end == PathEnd::none) product.scatter(v);
    }
    terms.add_lump(path.vertices.empty() ? 0 : path.vertices.size() - 1, FoundBy::light_path, path.light_paths, "light paths");
    return std::move(terms.all);
}

std::string step_text(const PathVertex& v, RgbChannel channel) {
    std::string text;
    if (const float passed = channel_of(v.passed, channel); passed != 1) text = fmt::format("passes x {}, ", digits(passed));
    if (v.end == PathEnd::roulette) return text + fmt::format("dies by roulette, q = {}", digits(v.survival));
    if (v.end != PathEnd::none)
        return text + std::string(v.end == PathEnd::escaped ? "escapes"
                                  : v.end == PathEnd::light ? "is a light"
                                                            : fmt::format("ends: {}", to_string(v.end)));
    if (v.scatters == ScatterKind::delta_reflection) text += "mirrors ";
    if (v.scatters == ScatterKind::delta_transmission) text += "refracts ";
    text += "x " + digits(channel_of(v.factor, channel));
    if (v.roulette && v.survival != 1) text += fmt::format(" / {} (roulette)", digits(v.survival));
    return text;
}

std::string path_text(const RecordedPath& path, RgbChannel channel) {
    const std::vector<PathTerm> terms = terms_of(path, channel);
    std::string text = fmt::format("sample {}, {}: {} vertices\n", path.sample, to_string(channel), path.vertices.size());
    for (const PathTerm& term : terms)
        text += fmt::format("  vertex {} {:12} {}\n", term.vertex, found_by_names[size_t(term.by)], term.text);
    if (terms.empty()) text += "  finds no light\n";
    if (terms.size() > 1) text += fmt::format("  sum {}\n", digits(channel_of(path.total(), channel)));
    if (!path.is_valid()) text += "  the film leaves it out: it is not finite or negative\n";
    return text;
}

} // namespace blush
