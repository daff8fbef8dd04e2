#include "render/compile/feature_report.h"

#include <fmt/format.h>

namespace blush {

std::string cost_text(const FeatureUse& use) {
    std::string text;
    if (use.bytes && *use.bytes >= 1 << 20)
        text = fmt::format("{:.2f} MiB", double(*use.bytes) / (1 << 20));
    else if (use.bytes && *use.bytes > 0)
        text = fmt::format("{:.2f} KiB", double(*use.bytes) / (1 << 10));
    if (use.seconds) text += fmt::format("{}{:.1f} ms", text.empty() ? "" : ", ", *use.seconds * 1e3);
    if (use.used) return text;
    if (text.empty()) return use.bytes ? "saves nothing" : "not measured";
    return "saves " + text;
}

} // namespace blush
