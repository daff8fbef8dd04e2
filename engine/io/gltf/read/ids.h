// Internal to io/gltf: assigns ids to imported records. Ids survive saving and loading: objects whose id is not the next in
// sequence store it in extras.blush.id.
#pragma once

#include "scene/scene.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace blush {

// Larger ids in files are ignored: ids after them must not overflow, and EXR ids end at 2^24.
constexpr uint32_t max_id_in_file = 1u << 22;

// Ids for records in file order: the requested id (0: none) if no earlier record has it, else the id of the previous record + 1
// or, if that is taken, the largest id + 1.
std::vector<uint32_t> assign_ids(const std::vector<uint32_t>& wanted);

// Adds the records that are present; result[i] is the id of records[i], or none.
template <class T>
std::vector<Id<T>> add_with_ids(Table<T>& table, std::vector<std::optional<T>> records, const std::vector<uint32_t>& wanted) {
    std::vector<uint32_t> wanted_by_present;
    for (size_t i = 0; i < records.size(); ++i)
        if (records[i]) wanted_by_present.push_back(wanted[i]);
    const std::vector<uint32_t> numbers = assign_ids(wanted_by_present);
    std::vector<Id<T>> ids(records.size());
    std::vector<std::pair<uint32_t, size_t>> in_id_order;
    for (size_t i = 0, present = 0; i < records.size(); ++i) {
        if (!records[i]) continue;
        ids[i] = Id<T>{numbers[present++]};
        in_id_order.emplace_back(ids[i].value, i);
    }
    std::sort(in_id_order.begin(), in_id_order.end());
    for (const auto& [id, i] : in_id_order) table.insert(Id<T>{id}, *std::move(records[i]));
    return ids;
}

} // namespace blush
