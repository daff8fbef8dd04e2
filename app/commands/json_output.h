// JSON for scripts: what `--json` writes.
#pragma once

#include "core/result.h"
#include "render/renderer.h"

#include <nlohmann/json.hpp>

#include <string>

namespace blush {

// Keys stay in the order in which they are set. Numbers that are not finite become null.
using OrderedJson = nlohmann::ordered_json;

// To a file, whole or not at all, or to stdout for "-"; nothing for an empty name.
Result<void> write_json(const std::string& target, const OrderedJson& json);

// {name, features: [names of what the kernel has], left_out: [{part, name, why, saves_mib, saves_ms}], made: [{part, name, why, mib, ms}]};
// figures that are not known are null.
OrderedJson kernel_json(const std::string& kernel, const Ledger& ledger);

} // namespace blush
