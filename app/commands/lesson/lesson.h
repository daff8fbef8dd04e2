// `blush lesson check FILE`: is the lesson valid, and are its claims true? `blush lesson export FILE`: its handout.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace blush {

// Adds the command to the command line. `run` is set to the function that executes it and returns the exit code.
void add_lesson_command(CLI::App& app, std::function<int()>& run);

} // namespace blush
