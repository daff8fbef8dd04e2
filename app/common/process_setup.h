// Process-wide setup, so that lack of memory, threads or disk space ends with one line and exit code 1.
#pragma once

namespace blush {

// Ignores SIGXFSZ: a write beyond the file size limit then fails with EFBIG, which the writer reports. Linking this file also
// installs, before main: a terminate handler that prints one line (for example if a thread cannot be started) and exits with code
// 1; and removal of environment variables that make libraries print to stderr.
void set_up_process();

} // namespace blush
