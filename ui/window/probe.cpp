#include "ui/window/probe.h"

#include <cmath>
#include <fstream>
#include <imgui.h>
#include <nlohmann/json.hpp>

namespace blush {
namespace {

nlohmann::json to_json(const Region& r) { return {{"x", r.x}, {"y", r.y}, {"width", r.width}, {"height", r.height}}; }

std::string to_text(const nlohmann::json& json) { return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace); }

ProbeState with_mouse_and_keyboard(ProbeState state) {
    state.typing = ImGui::GetIO().WantTextInput;
    if (!ImGui::IsMousePosValid()) return state;
    state.mouse_x = int(std::lround(ImGui::GetIO().MousePos.x));
    state.mouse_y = int(std::lround(ImGui::GetIO().MousePos.y));
    return state;
}

} // namespace

void Probe::record_last_item(const std::string& name) {
    if ((!enabled() && name != watched_) || !ImGui::IsItemVisible()) return;
    const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
    record(name, {low.x, low.y, size.x, size.y});
}

void Probe::record(const std::string& name, const Region& region) {
    if (!watched_.empty() && name == watched_) watched_region_ = region;
    if (enabled()) items_.push_back({name, region});
}

void Probe::end_frame(const ProbeState& given) {
    if (!enabled()) return;
    const ProbeState state = with_mouse_and_keyboard(given);
    if (items_ == written_items_ && state == written_state_) return;
    written_items_ = items_;
    written_state_ = state;
    // One line for each widget, so that grep finds it.
    std::string items;
    for (const Item& item : items_) items += (items.empty() ? "  " : ",\n  ") + to_text(item.name) + ": " + to_text(to_json(item.region));
    const nlohmann::json shown{{"image", to_json(state.image)},  {"width", state.width},       {"height", state.height},
                               {"samples", state.samples},       {"complete", state.complete}, {"revision", state.revision},
                               {"up_to_date", state.up_to_date}, {"toast", state.toast},       {"look", state.shown},
                               {"inputs", state.inputs},         {"mouse_x", state.mouse_x},   {"mouse_y", state.mouse_y},
                               {"typing", state.typing},         {"settled", state.settled}};
    const std::filesystem::path temporary = file_.string() + ".new";
    std::ofstream(temporary) << "{\"state\": " << to_text(shown) << ",\n \"items\": {\n" << items << "\n}}\n";
    std::error_code ignored; // the next change writes it again
    std::filesystem::rename(temporary, file_, ignored);
}

} // namespace blush
