#include "ui/snapshots/aov_view.h"

#include <algorithm>
#include <fmt/format.h>

namespace blush {
namespace {

using Show = ImageView::Show;

std::string bounce_name(int k) {
    const bool last = k + 1 == default_bounce_planes;
    return fmt::format("Bounce {}{}", k, last ? "+" : k == 0 ? ": emission" : k == 1 ? ": direct light" : "");
}

} // namespace

std::string strategy_name(FoundBy by) {
    switch (by) {
    case FoundBy::camera_hit: return "Camera hits";
    case FoundBy::guided: return "Path guiding";
    case FoundBy::nee: return "Next event estimation";
    case FoundBy::manifold: return "Manifold sampling";
    case FoundBy::light_vertex: return "Light vertices";
    case FoundBy::light_path: return "Light paths";
    }
    return {};
}

bool needs_bounces(ImageView::Show show) {
    return show == Show::bounces || show == Show::two_piles || show == Show::indirect_share || show == Show::bleed;
}

std::vector<AovEntry> aov_list(const Frame* frame) {
    std::vector<AovEntry> list{{{Show::beauty}, "Beauty"}, {{Show::albedo}, "Albedo"},     {{Show::normal}, "Normal"},
                               {{Show::depth}, "Depth"},   {{Show::object_id}, "Objects"}, {{Show::material_id}, "Materials"},
                               {{Show::error}, "Error"},   {{Show::samples}, "Samples"}};
    if (frame && !frame->groups.empty())
        for (size_t k = 0; k < frame->groups.size(); ++k)
            list.push_back({{Show::group, int(k)}, fmt::format("Group {}", frame->group_names[k])});
    else
        list.push_back({{Show::group}, "Light groups", "Needs light groups: open the light mix (Ctrl+M)", false});
    const bool has_bounces = frame && !frame->bounces.empty();
    const int bounces = has_bounces ? int(frame->bounces.size()) : default_bounce_planes;
    for (int k = 0; k < bounces; ++k)
        list.push_back({{Show::bounces, k}, bounce_name(k), has_bounces ? "" : "Needs bounce AOVs: the render restarts"});
    for (const auto& [show, name] :
         {std::pair{Show::two_piles, "Two piles"}, {Show::indirect_share, "Indirect share"}, {Show::bleed, "Bleed"}})
        list.push_back({{show}, name, has_bounces ? "" : "Needs bounce AOVs: the render restarts"});
    for (int k = 0; k < found_by_count; ++k)
        list.push_back({{Show::strategy, k},
                        strategy_name(FoundBy(k)),
                        frame && !frame->strategies.empty() ? "" : "Needs strategy AOVs: the render restarts"});
    return list;
}

std::string name_of(const AovView& view, const Frame* frame) {
    const std::vector<AovEntry> list = aov_list(frame);
    const auto it = std::ranges::find(list, view, &AovEntry::view);
    return it == list.end() ? "Beauty" : it->name;
}

AovView stepped(const AovView& view, const Frame* frame, int by) {
    std::vector<AovEntry> list = aov_list(frame);
    std::erase_if(list, [](const AovEntry& e) { return !e.possible; });
    const auto it = std::ranges::find(list, view, &AovEntry::view);
    const int n = int(list.size()), at = it == list.end() ? 0 : int(it - list.begin());
    return list[size_t(((at + by) % n + n) % n)].view;
}

ImageView image_view(const AovView& view, int bounce_planes) {
    if (view.show == Show::group) return {.show = Show::group, .group = view.index};
    if (view.show == Show::strategy) return {.show = Show::strategy, .strategy = view.index};
    if (view.show != Show::bounces) return {.show = view.show};
    std::vector<float> gains(size_t(bounce_planes), 0.f);
    if (view.index < bounce_planes) gains[size_t(view.index)] = 1;
    return {.show = Show::bounces, .gains = gains};
}

PlaneSet planes_of(const AovView& view) {
    return {.bounces = needs_bounces(view.show) ? default_bounce_planes : 0,
            .error = view.show == Show::error,
            .strategies = view.show == Show::strategy};
}

} // namespace blush
