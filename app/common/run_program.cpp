#include "app/common/run_program.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace blush {
namespace {

class FileActions {
public:
    explicit FileActions(const std::filesystem::path& output) {
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        const char* file = output.empty() ? "/dev/null" : output.c_str();
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (!output.empty()) posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;
    posix_spawn_file_actions_t actions;
};

// The state of the process at its end.
int wait_for(pid_t pid, const std::atomic<bool>* cancelled) {
    constexpr std::chrono::milliseconds pause{20};
    int state = 0;
    bool told = false;
    while (cancelled && !told) {
        const pid_t ended = waitpid(pid, &state, WNOHANG);
        if (ended == pid) return state;
        if (*cancelled) {
            kill(pid, SIGTERM);
            told = true;
        } else {
            std::this_thread::sleep_for(pause);
        }
    }
    while (waitpid(pid, &state, 0) < 0 && errno == EINTR) {}
    return state;
}

} // namespace

std::optional<int> run_program(std::vector<std::string> words, const RunProgramOptions& options) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const FileActions files(options.output);
    pid_t pid = 0;
    if (posix_spawnp(&pid, arguments[0], &files.actions, nullptr, arguments.data(), environ) != 0) return {};
    const int state = wait_for(pid, options.cancelled);
    return WIFEXITED(state) ? WEXITSTATUS(state) : 128;
}

} // namespace blush
