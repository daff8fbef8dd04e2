// `blush paths`: replays samples of one pixel and writes all their vertices, without a window.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace blush {

// Adds the command to the command line. `run` is set to the function that executes it and returns the exit code.
void add_paths_command(CLI::App& app, std::function<int()>& run);

} // namespace blush
