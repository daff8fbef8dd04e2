#include "app/farm/plan_arguments.h"

#include <fmt/format.h>

namespace blush {
namespace {

using Words = std::vector<std::string>;

void add(Words& words, std::initializer_list<std::string> more) { words.insert(words.end(), more); }

void add_looks(Words& words, const FarmChoices& c, const FarmSource& source) {
    switch (c.what) {
    case FarmChoices::What::view:
    case FarmChoices::What::snapshots: return;
    case FarmChoices::What::turntable: return add(words, {"--turntable", std::to_string(c.steps)});
    case FarmChoices::What::animation:
        if (source.animation) add(words, {"--animation", std::to_string(*source.animation)});
        return add(words,
                   {"--frames", fmt::format("{}:{}", c.first_frame, c.last_frame), "--fps", fmt::format("{:g}", c.frames_per_second)});
    case FarmChoices::What::cameras: return add(words, {"--cameras", "all"});
    case FarmChoices::What::variants: return add(words, {"--variants", "all"});
    case FarmChoices::What::looks: return add(words, {"--looks", c.looks_file.string()});
    }
}

void add_view(Words& words, const ViewSettings& view) {
    if (view.exposure_ev != 0) words.push_back(fmt::format("--exposure={:g}", view.exposure_ev)); // may begin with a minus
    if (view.white != Vec3{1, 1, 1}) add(words, {"--white", fmt::format("{:g},{:g},{:g}", view.white.x, view.white.y, view.white.z)});
    for (const auto& [name, value] : {std::pair{"--view", view.view}, {"--look", view.look}, {"--display", view.display}})
        if (!value.empty()) add(words, {name, value});
}

} // namespace

std::vector<std::string> plan_arguments(const FarmChoices& c, const FarmSource& source) {
    Words words{"plan", "-o", source.folder.string(), "--snapshots"};
    words.insert(words.end(), source.snapshots.begin(), source.snapshots.end());
    add_looks(words, c, source);
    add(words, {"--size", fmt::format("{}x", c.width), "--spp", std::to_string(c.spp)});
    if (c.by_error) add(words, {"--error", fmt::format("{:g}", double(c.error_per_cent) / 100)});
    add(words, {"--adaptive", c.adaptive ? "on" : "off"});
    add_view(words, source.view);
    if (source.threads > 0) add(words, {"--threads", std::to_string(source.threads)});
    words.push_back("--quiet");
    return words;
}

} // namespace blush
