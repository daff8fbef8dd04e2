// Runs another program.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace blush {

// Runs a program, from the path if its name has no slash, to its end; stdin and stdout are /dev/null. Returns its exit code, 128 if a
// signal ended it; empty: there is no such program.
std::optional<int> run_program(std::vector<std::string> words);

} // namespace blush
