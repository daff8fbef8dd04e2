#include "tests/support/process.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace blush::test {
namespace {

struct Stream {
    int read_end = -1, write_end = -1;
};

Stream open_pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    return {ends[0], ends[1]};
}

Stream open_terminal() {
    int leader = -1, follower = -1;
    if (openpty(&leader, &follower, nullptr, nullptr, nullptr) != 0) throw std::runtime_error("no terminal");
    fcntl(leader, F_SETFD, FD_CLOEXEC);
    fcntl(follower, F_SETFD, FD_CLOEXEC);
    return {leader, follower};
}

[[noreturn]] void become(const std::vector<std::string>& command, int out, int err) {
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
}

// Appends what can be read; false at the end. A terminal whose other side is closed reads as an error.
bool read_some(int fd, std::string& text) {
    char buffer[4096];
    const ssize_t n = read(fd, buffer, sizeof buffer);
    if (n <= 0) return false;
    text.append(buffer, size_t(n));
    return true;
}

} // namespace

bool terminals_exist() {
    int leader = -1, follower = -1;
    if (openpty(&leader, &follower, nullptr, nullptr, nullptr) != 0) return false;
    close(leader);
    close(follower);
    return true;
}

Finished run(const std::vector<std::string>& command, const RunOptions& options) {
    const Stream out = open_pipe(), err = options.stderr_is_terminal ? open_terminal() : open_pipe();
    const pid_t pid = fork();
    if (pid < 0) throw std::runtime_error("no process");
    if (pid == 0) become(command, out.write_end, err.write_end);
    close(out.write_end);
    close(err.write_end);

    Finished finished;
    pollfd watched[] = {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}};
    while (watched[0].fd >= 0 || watched[1].fd >= 0) {
        poll(watched, 2, -1);
        if (watched[0].revents && !read_some(out.read_end, finished.out)) watched[0].fd = -1;
        if (watched[1].revents) {
            if (!read_some(err.read_end, finished.err))
                watched[1].fd = -1;
            else if (options.on_stderr)
                options.on_stderr(finished.err, pid);
        }
    }
    close(out.read_end);
    close(err.read_end);
    int status = 0;
    waitpid(pid, &status, 0);
    finished.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return finished;
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "blush-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace blush::test
