// Runs another program.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace blush {

struct RunProgramOptions {
    std::filesystem::path output = {};            // file for stdout and stderr; empty: stdout is dropped, stderr is that of this process
    const std::atomic<bool>* cancelled = nullptr; // sends SIGTERM once it is true
};

// Runs a program, from the path if its name has no slash, to its end; stdin is /dev/null. Returns its exit code, 128 if a signal ended
// it; empty: there is no such program, or its output cannot be written.
std::optional<int> run_program(std::vector<std::string> words, const RunProgramOptions& options = {});

} // namespace blush
