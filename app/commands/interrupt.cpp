#include "app/commands/interrupt.h"

#include <csignal>

namespace blush {
namespace {

std::atomic<bool> noted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not lock");

void note(int) { noted = true; }

void on_signals(void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART | int(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

} // namespace

InterruptGuard::InterruptGuard() {
    noted = false;
    on_signals(note);
}
InterruptGuard::~InterruptGuard() { on_signals(SIG_DFL); }

const std::atomic<bool>& InterruptGuard::interrupted() const { return noted; }

} // namespace blush
