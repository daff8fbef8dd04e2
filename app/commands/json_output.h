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

// {name, features: [names], left_out: [{name, why}]}
OrderedJson kernel_json(const CompiledInfo& info);

} // namespace blush
