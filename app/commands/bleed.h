// `blush bleed`: who lights a pixel, a rectangle or a surface point, and how scattered light shifts its colour.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace blush {

// Adds the command to the command line. `run` is set to the function that executes it and returns the exit code.
void add_bleed_command(CLI::App& app, std::function<int()>& run);

} // namespace blush
