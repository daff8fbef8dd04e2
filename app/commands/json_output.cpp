#include "app/commands/json_output.h"

#include "core/files.h"

#include <cstdio>

namespace blush {

Result<void> write_json(const std::string& target, const OrderedJson& json) {
    if (target.empty()) return {};
    const std::string text = json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
    if (target != "-") return write_file(target, text);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        return Error{.file = "-", .what = "stdout cannot be written to"};
    return {};
}

OrderedJson kernel_json(const CompiledInfo& info) {
    OrderedJson features = OrderedJson::array(), left_out = OrderedJson::array();
    for (const FeatureUse& feature : info.features) {
        if (feature.used)
            features.push_back(feature.name);
        else
            left_out.push_back({{"name", feature.name}, {"why", feature.why}});
    }
    return {{"name", info.kernel}, {"features", features}, {"left_out", left_out}};
}

} // namespace blush
