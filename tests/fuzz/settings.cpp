#include "io/project/scene_edits_json.h"
#include "io/project/settings_json.h"
#include "scene/validate.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace blush::fuzz {

void settings(std::span<const uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (const auto render = parse_render_settings(text)) promise(validate(render->settings));
    if (const auto view = parse_view_settings(text)) promise(validate(view->settings));
    count_left_out(text);
    if (const auto scene = apply_edits_json({}, text, BLUSH_CORPUS)) promise(validate(*scene));
}

} // namespace blush::fuzz
