// `blush check`: the stability battery.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace blush {

// Adds the command to the command line; `run` becomes what to do, and returns the exit code, if it is the one that was asked for.
void add_check_command(CLI::App& app, std::function<int()>& run);

} // namespace blush
