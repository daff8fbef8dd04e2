// Shared by all commands: exit codes, common options, messages on stderr.
#pragma once

#include "core/result.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace blush {

constexpr int exit_done = 0, exit_failed = 1, exit_usage = 2;

struct CommonOptions {
    std::string json;     // file, "-" for stdout, empty for none
    unsigned threads = 0; // 0: one per core
    bool quiet = false;   // only errors
};
void add_common_options(CLI::App& app, CommonOptions& options);

// Prints one line on stderr, "blush: error: FILE: what, where". Returns the exit code.
int failed(const Error& error);
int bad_usage(const std::string& what);

// Of parsed arguments: what is wrong if the value of an option begins with "--"; else empty. The parser takes the next option as the value
// of one that has none.
std::string option_as_value(const CLI::App& app);

// Prints the first ten warnings on stderr, one line each; notes are only printed by `blush info`.
void print_warnings(const std::string& file, const std::vector<Diagnostic>& diagnostics);

// `error` with its file set to `file` if it has none.
Error in_file(Error error, const std::string& file);

} // namespace blush
