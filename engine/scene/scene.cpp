#include "scene/scene.h"

#include <atomic>

namespace blush {

uint64_t next_payload_serial() {
    static std::atomic<uint64_t> last{0};
    return ++last;
}

} // namespace blush
