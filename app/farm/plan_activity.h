// What runs of a plan, and what its scripts said at their end.
#pragma once

#include <filesystem>
#include <string>

namespace blush {

constexpr const char* local_log = "local.out";  // of run-local.sh, in the folder of a plan
constexpr const char* slurm_log = "submit.out"; // of submit-slurm.sh

// True while run-local.sh or a task of it runs on this machine.
bool runs_here(const std::filesystem::path& folder);
// True while a job of the plan waits or runs in Slurm.
bool runs_in_slurm(const std::filesystem::path& folder);

// The message with which a script or program ended, as the last line of its log says; empty: none.
std::string last_words(const std::filesystem::path& log);

} // namespace blush
