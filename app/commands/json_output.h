// JSON output of `--json`.
#pragma once

#include "core/result.h"
#include "render/renderer.h"

#include <nlohmann/json.hpp>

#include <string>

namespace blush {

// Keys keep their insertion order. Non-finite numbers become null.
using OrderedJson = nlohmann::ordered_json;

// Writes to a file, atomically, or to stdout for "-"; does nothing for an empty name.
Result<void> write_json(const std::string& target, const OrderedJson& json);

// {name, features: [names of the kernel's features], left_out: [{part, name, why, saves_mib, saves_ms}], made: [{part, name, why,
// mib, ms}]}; unknown values are null.
OrderedJson kernel_json(const std::string& kernel, const FeatureReport& feature_report);

} // namespace blush
