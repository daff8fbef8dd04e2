// The Khronos glTF validator, run by node.
#pragma once

#include "core/text.h"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace blush::test {

inline std::string node_program() {
    const char* path = std::getenv("PATH");
    for (const std::string_view folder : split(path ? path : "", ':')) {
        std::string program = std::string(folder) + "/node";
        if (std::filesystem::exists(program)) return program;
    }
    return {};
}

// Reason why the validator cannot run, or "".
inline std::string validator_problem() {
    if (!std::filesystem::exists(BLUSH_VALIDATOR "/index.js")) return "no glTF validator: packaging/setup fetches it";
    return node_program().empty() ? "no node to run the glTF validator with" : "";
}

// Skips the test where the validator is missing; fails it in CI (BLUSH_CI), where it is required.
#define REQUIRE_VALIDATOR()                                                                                                                \
    if (const std::string why = validator_problem(); !why.empty()) {                                                                       \
        if (std::getenv("BLUSH_CI")) FAIL() << why;                                                                                        \
        GTEST_SKIP() << why;                                                                                                               \
    }

} // namespace blush::test
