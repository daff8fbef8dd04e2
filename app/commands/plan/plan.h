// `blush plan`: many images, or one, on many machines.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace blush {

// Adds the command to the command line. `run` is set to the function that executes it and returns the exit code.
void add_plan_command(CLI::App& app, std::function<int()>& run);

} // namespace blush
