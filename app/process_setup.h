// What the process arranges once, so that running out of something ends in one line and exit code 1.
#pragma once

namespace blush {

// SIGXFSZ is ignored: a write beyond the limit on file sizes then fails with EFBIG, which the writer reports. Linked in with it, and from before
// main: what would end in std::terminate (a thread that cannot be started, no memory where nothing may be thrown) is said in one line and ends
// with exit code 1, and libraries that print on stderr what they find in environment variables do not find those.
void set_up_process();

} // namespace blush
