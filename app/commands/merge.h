// `blush merge`: renders of one scene with different sample ranges, as one picture.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace blush {

// Adds the command to the command line; `run` becomes what to do, and returns the exit code, if it is the one that was asked for.
void add_merge_command(CLI::App& app, std::function<int()>& run);

} // namespace blush
