#include "ui/probe.h"

#include <fstream>
#include <imgui.h>
#include <nlohmann/json.hpp>

namespace blush {
namespace {

nlohmann::json to_json(const Region& r) { return {{"x", r.x}, {"y", r.y}, {"width", r.width}, {"height", r.height}}; }

} // namespace

void Probe::record_last_item(const std::string& name) {
    if (!enabled() || !ImGui::IsItemVisible()) return;
    const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
    items_.push_back({name, {low.x, low.y, size.x, size.y}});
}

void Probe::end_frame(const ProbeState& state) {
    if (!enabled() || (items_ == written_items_ && state == written_state_)) return;
    written_items_ = items_;
    written_state_ = state;
    nlohmann::json items = nlohmann::json::object();
    for (const Item& item : items_) items[item.name] = to_json(item.region);
    const nlohmann::json json{{"image", to_json(state.image)}, {"width", state.width},           {"height", state.height},
                              {"samples", state.samples},      {"complete", state.complete},     {"up_to_date", state.up_to_date},
                              {"toast", state.toast},          {"items", std::move(items)}};
    const std::filesystem::path temporary = file_.string() + ".new";
    std::ofstream(temporary) << json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    std::error_code ignored; // the next change writes it again
    std::filesystem::rename(temporary, file_, ignored);
}

} // namespace blush
