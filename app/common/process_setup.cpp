#include "app/common/process_setup.h"

#include "core/startable_threads.h"

#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <system_error>
#include <tbb/global_control.h>
#include <unistd.h>

namespace blush {
namespace {

// Must not allocate: memory may be exhausted.
[[noreturn]] void end_with_a_line() {
    const char *cause = "unhandled exception: ", *what = "the program cannot continue";
    try {
        if (const std::exception_ptr current = std::current_exception()) std::rethrow_exception(current);
    } catch (const std::bad_alloc& e) {
        cause = "";
        what = what_was_missing(e);
    } catch (const std::system_error& e) { // thrown if a thread cannot be started
        cause = "not enough threads or memory: ";
        what = e.what();
    } catch (const std::exception& e) { what = e.what(); } catch (...) {
    }
    char line[400];
    const int length = std::snprintf(line, sizeof line, "blush: error: %s%s\n", cause, what);
    if (length > 0) (void)!::write(STDERR_FILENO, line, std::strlen(line));
    ::_exit(1);
}

// libgomp reads these when it is loaded, before main, and prints warnings about them. It is used with one thread at a time
// (render/denoise/convolution.cpp), so they have no other effect; TBB_VERSION makes TBB print its version.
bool enables_logging(const char* variable) {
    for (const char* name : {"OMP_", "GOMP_", "TBB_VERSION="})
        if (std::strncmp(variable, name, std::strlen(name)) == 0) return true;
    return false;
}

// Before constructors of shared libraries, some of which start threads.
void begin_process(int, char**, char** environment) {
    std::set_terminate(end_with_a_line);
    char** kept = environment;
    for (char** at = environment; *at; ++at)
        if (!enables_logging(*at)) *kept++ = *at;
    *kept = nullptr;
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const run_first)(int, char**, char**) = begin_process;

} // namespace

const char* what_was_missing(const std::bad_alloc& e) noexcept {
    return std::strcmp(e.what(), std::bad_alloc().what()) == 0 ? "not enough memory" : e.what();
}

void set_up_process() {
    std::signal(SIGXFSZ, SIG_IGN);
    // TBB starts at most one worker per core and prints a warning on stderr otherwise, unless configured before it starts. Never
    // destroyed, because its threads may run until exit.
    static const auto* const control = new tbb::global_control(tbb::global_control::max_allowed_parallelism, startable_threads_limit());
    (void)control;
}

} // namespace blush
