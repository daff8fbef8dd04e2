// The built program and the shipped scenes, for tests of the command line.
#pragma once

#include "tests/support/process.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace blush::test {

inline std::string scene_file(const std::string& name) { return std::string(BLUSH_ASSETS "/scenes/") + name + ".gltf"; }

// `blush` with these arguments.
inline Finished blush(std::vector<std::string> arguments, const RunOptions& options = {}) {
    arguments.insert(arguments.begin(), BLUSH_BINARY);
    return run(arguments, options);
}

// What the command printed with `--json -`; null if that is not JSON.
// A copy of a shipped scene of two files, with this light mix saved in it.
inline std::string scene_with_mix(const TemporaryFolder& folder, const std::string& name, const nlohmann::json& mix) {
    std::ifstream in(scene_file(name));
    nlohmann::json scene = nlohmann::json::parse(in);
    scene["scenes"][0]["extras"]["blush"]["mix"] = mix;
    const std::string file = folder / (name + "-mixed.gltf");
    std::ofstream(file) << scene;
    const std::filesystem::path beside = std::filesystem::path(scene_file(name)).parent_path() / (name + ".bin");
    std::filesystem::copy_file(beside, folder / (name + ".bin"), std::filesystem::copy_options::overwrite_existing);
    return file;
}

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
