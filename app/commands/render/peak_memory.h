// Peak memory of this process.
#pragma once

namespace blush {

// In MiB, of this program alone: ru_maxrss starts with what the process held that started it. 0 without /proc.
double peak_memory_mb();

} // namespace blush
