#include "app/commands/paths/paths_json.h"

#include "render/diagnostics/path_arithmetic.h"

#include <cmath>

namespace blush {
namespace {

template <class T> OrderedJson triple(const Vec<T>& v) { return {v.x, v.y, v.z}; }

OrderedJson next_event_json(const NextEvent& e) {
    return {{"light", e.light},
            {"from", triple(e.from)},
            {"to", triple(e.to)},
            {"infinite", e.infinite},
            {"blocked", e.blocked},
            {"blocker", e.blocker.empty() ? OrderedJson() : OrderedJson(e.blocker)},
            {"f_cos", triple(e.f_cos)},
            {"radiance", triple(e.radiance)},
            {"light_pdf", e.light_pdf},
            {"bsdf_pdf", e.bsdf_pdf},
            {"mis_weight", e.mis},
            {"unblocked", triple(e.sent)},
            {"contribution", triple(e.arrived)}};
}

OrderedJson vertex_json(const PathVertex& v) {
    OrderedJson json{{"bounce", v.bounce},
                     {"met", to_string(v.met)},
                     {"object", v.object},
                     {"material", v.material.empty() ? OrderedJson() : OrderedJson(v.material)},
                     {"position", triple(v.position)},
                     {"direction", triple(v.direction)},
                     {"distance", v.distance},
                     {"normal", v.met == Met::surface ? triple(v.normal) : OrderedJson()},
                     {"shading_normal", v.met == Met::surface ? triple(v.ns) : OrderedJson()},
                     {"color", triple(v.color)},
                     {"passed", triple(v.passed)},
                     {"arriving", triple(v.arriving)},
                     {"guided", v.guided}};
    json["emission"] =
        !v.emits ? OrderedJson()
                 : OrderedJson{{"radiance", triple(v.radiance)}, {"mis_weight", v.emission_mis}, {"contribution", triple(v.emission)}};
    json["next_event"] = v.next_event ? next_event_json(*v.next_event) : OrderedJson();
    json["panes"] = triple(v.panes);
    json["past_blended"] = triple(v.past);
    json["manifold"] = triple(v.chains);
    json["light_vertices"] = triple(v.light_vertices);
    const bool sampled = v.scatters != ScatterKind::none, delta = std::isinf(v.pdf);
    json["scatters"] = to_string(v.scatters);
    json["delta"] = delta;
    json["factor"] = sampled ? triple(v.factor) : OrderedJson();
    json["pdf"] = sampled && !delta ? OrderedJson(v.pdf) : OrderedJson();
    json["roulette"] = v.roulette ? OrderedJson{{"survival", v.survival}, {"survived", v.end == PathEnd::none}} : OrderedJson();
    json["beta"] = sampled ? triple(v.beta) : OrderedJson();
    json["end"] = v.end == PathEnd::none ? OrderedJson() : OrderedJson(to_string(v.end));
    return json;
}

OrderedJson arithmetic_json(const RecordedPath& path) {
    OrderedJson json;
    for (const RgbChannel channel : {RgbChannel::red, RgbChannel::green, RgbChannel::blue}) {
        OrderedJson terms = OrderedJson::array();
        for (const PathTerm& term : terms_of(path, channel))
            terms.push_back(
                {{"vertex", term.vertex}, {"strategy", found_by_names[size_t(term.by)]}, {"text", term.text}, {"value", term.value}});
        json[std::string(to_string(channel))] = std::move(terms);
    }
    return json;
}

OrderedJson path_json(const RecordedPath& path) {
    OrderedJson json{{"sample", path.sample},
                     {"valid", path.is_valid()},
                     {"radiance", triple(path.radiance)},
                     {"light_paths", triple(path.light_paths)},
                     {"eye", triple(path.eye)},
                     {"arithmetic", arithmetic_json(path)},
                     {"vertices", OrderedJson::array()},
                     {"shortened", path.shortened}};
    for (const PathVertex& v : path.vertices) json["vertices"].push_back(vertex_json(v));
    return json;
}

OrderedJson sum_json(const PathSum& sum) {
    OrderedJson json{{"paths", sum.paths}, {"invalid", sum.invalid}, {"mean", triple(sum.mean)}};
    for (size_t k = 0; k < sum.by_strategy.size(); ++k) json["strategies"][std::string(found_by_names[k])] = triple(sum.by_strategy[k]);
    json["lengths"] = OrderedJson::array();
    for (const Vec3d& light : sum.by_length) json["lengths"].push_back(triple(light));
    return json;
}

} // namespace

OrderedJson paths_json(const PixelPaths& p) {
    OrderedJson json{{"scene", p.scene_file},
                     {"width", p.settings.width},
                     {"height", p.settings.height},
                     {"pixel", {p.x, p.y}},
                     {"samples", {p.settings.first_sample, p.settings.spp}},
                     {"seed", p.settings.seed},
                     {"paths", OrderedJson::array()},
                     {"sum", sum_json(p.sum)}};
    for (const RecordedPath& path : p.paths) json["paths"].push_back(path_json(path));
    json["film"] = {{"mean", triple(p.film)},
                    {"difference", relative_difference(p)},
                    {"left_out", p.left_out},
                    {"image", p.image ? triple(*p.image) : OrderedJson()}};
    return json;
}

} // namespace blush
