// Runs a program like a shell and collects its output.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace blush::test {

struct Finished {
    int exit_code = -1; // 128 + signal if one ended it
    std::string out, err;
};

struct RunOptions {
    bool stderr_is_terminal = false;
    // Called with all of stderr so far, whenever it grows, and the process id: for sending signals.
    std::function<void(const std::string& err, int pid)> on_stderr;
};

// True if this machine has pseudo-terminals; bare containers may not.
bool terminals_exist();

// `command[0]` is a path. Stdin is empty. Returns when the program ends.
Finished run(const std::vector<std::string>& command, const RunOptions& options = {});

// A temporary folder that is deleted with the object.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace blush::test
