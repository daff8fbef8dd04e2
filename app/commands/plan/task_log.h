// The log of a task: LOGS/NUMBER.log. Its last line says how the task stands, whatever runs it.
#pragma once

#include <filesystem>
#include <string>

namespace blush {

// Appends lines to the log. Holds a lock on it while it exists, so that a task whose process was killed does not seem to run. A log
// that cannot be written, on a full disk for example, is no error: the part itself tells whether a task is done.
class TaskLog {
public:
    TaskLog(const std::filesystem::path& folder, size_t number);
    ~TaskLog();
    TaskLog(const TaskLog&) = delete;
    TaskLog& operator=(const TaskLog&) = delete;
    void line(const std::string& text);

private:
    int file_ = -1;
};

// In the last line of a task that was told to end.
constexpr const char* stopped_by_signal = "stopped by a signal";

// How a task stands that is not done.
struct TaskState {
    bool begun = false;   // it has a log
    bool running = false; // a process holds the log
    std::string last_line = {};
};
TaskState task_state(const std::filesystem::path& folder, size_t number);

} // namespace blush
