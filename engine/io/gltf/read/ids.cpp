#include "io/gltf/read/ids.h"

#include <unordered_set>

namespace blush {

std::vector<uint32_t> assign_ids(const std::vector<uint32_t>& wanted) {
    std::unordered_set<uint32_t> claimed;
    std::vector<uint32_t> ids(wanted.size());
    uint32_t largest = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i] == 0 || wanted[i] > max_id_in_file || !claimed.insert(wanted[i]).second) continue;
        ids[i] = wanted[i];
        largest = std::max(largest, wanted[i]);
    }
    uint32_t before = 0;
    for (uint32_t& id : ids) {
        if (id == 0) {
            id = before + 1;
            if (!claimed.insert(id).second) claimed.insert(id = largest + 1);
            largest = std::max(largest, id);
        }
        before = id;
    }
    return ids;
}

} // namespace blush
