// Questions about records that changed between two scenes.
#pragma once

#include <algorithm>
#include <vector>

namespace blush {

// True if each record of `ids` is in both tables and keeps(record before, record after).
template <class Records, class IdOf, class Keeps>
bool all_keep(const Records& before, const Records& after, const std::vector<IdOf>& ids, const Keeps& keeps) {
    return std::ranges::all_of(ids, [&](const IdOf& id) {
        const auto *was = before.find(id), *is = after.find(id);
        return was && is && keeps(*was, *is);
    });
}

} // namespace blush
