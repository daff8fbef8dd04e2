#include "app/commands/json_output.h"

#include "core/files.h"

#include <cstdio>

namespace blush {

Result<void> write_json(const std::string& target, const OrderedJson& json) {
    if (target.empty()) return {};
    const std::string text = json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
    if (target != "-") return write_file(target, text);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        return Error{.file = "-", .what = "cannot write to stdout"};
    return {};
}

OrderedJson kernel_json(const std::string& kernel, const FeatureReport& feature_report) {
    const auto known = [](const auto& value, double scale) { return value ? OrderedJson(double(*value) * scale) : OrderedJson(); };
    OrderedJson features = OrderedJson::array(), left_out = OrderedJson::array(), made = OrderedJson::array();
    OrderedJson pilots = OrderedJson::array();
    for (const FeatureUse& use : feature_report) {
        const OrderedJson mib = known(use.bytes, 1.0 / 1048576), ms = known(use.seconds, 1e3);
        if (const auto& p = use.pilot)
            pilots.push_back({{"name", use.name},
                              {"used", use.used},
                              {"mse", p->mse},
                              {"relmse", p->relmse},
                              {"typical", p->typical},
                              {"work", p->work},
                              {"group_size", p->group_size},
                              {"cost", p->cost()}});
        if (!use.used)
            left_out.push_back({{"part", use.part}, {"name", use.name}, {"why", use.why}, {"saves_mib", mib}, {"saves_ms", ms}});
        else if (use.part == "kernel")
            features.push_back(use.name);
        else
            made.push_back({{"part", use.part}, {"name", use.name}, {"why", use.why}, {"mib", mib}, {"ms", ms}});
    }
    return {{"name", kernel}, {"features", features}, {"left_out", left_out}, {"made", made}, {"pilots", pilots}};
}

} // namespace blush
