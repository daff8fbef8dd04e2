// The built program and the shipped scenes, for tests that drive them.
#pragma once

#include "support/process.h"

#include <nlohmann/json.hpp>

namespace blush::test {

inline std::string scene_file(const std::string& name) { return std::string(BLUSH_ASSETS "/scenes/") + name + ".gltf"; }

// `blush` with these arguments.
inline Finished blush(std::vector<std::string> arguments, const RunOptions& options = {}) {
    arguments.insert(arguments.begin(), BLUSH_BINARY);
    return run(arguments, options);
}

// What the command printed with `--json -`; null if that is not JSON.
inline nlohmann::json blush_json(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", "-"});
    return nlohmann::json::parse(blush(std::move(arguments)).out, nullptr, false);
}

inline bool is_one_line(const std::string& text) { return !text.empty() && text.find('\n') == text.size() - 1; }

inline std::vector<std::string> keys_of(const nlohmann::json& json) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    return keys;
}

} // namespace blush::test
