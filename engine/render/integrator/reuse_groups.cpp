#include "render/integrator/reuse_groups.h"

#include "core/sampler.h"
#include "render/kernels/reuse_columns.h"

#include <bit>

namespace blush {
namespace {

// A permutation of [0, count), for powers of two up to 1024: odd factors and right xor-shifts are bijections.
uint32_t permuted(uint32_t i, uint32_t count, uint64_t key) {
    const uint32_t last = count - 1, shift = uint32_t(std::countr_zero(count)) / 2;
    for (int round = 0; round < 3; ++round, key >>= 20) {
        i = (i * (uint32_t(key) << 1 | 1) + uint32_t(key >> 10)) & last;
        i ^= i >> shift;
    }
    return i;
}

} // namespace

void ReuseColumns::hold_groups(size_t count) { unshared_groups.resize(count); }

BlockGroups::BlockGroups(const ReuseGroups& groups, int x, int y, int64_t sample) : groups_(groups) {
    const uint32_t block = pcg_hash(uint32_t(x) << 16 ^ uint32_t(y)) ^ pcg_hash(uint32_t(sample) ^ uint32_t(sample >> 32) * 0x9e3779b9u);
    for (int member = 0; member < groups.size(); ++member) {
        const uint32_t key = pcg_hash(block + uint32_t(member) * 0x85ebca6bu);
        keys_[member] = uint64_t(key) << 32 | pcg_hash(key);
    }
}

BlockGroups::Pixel BlockGroups::pixel(int group, int member) const {
    const int in_cell = int(permuted(uint32_t(group), uint32_t(groups_.per_block()), keys_[member]));
    return {member % groups_.columns * groups_.cell_width() + in_cell % groups_.cell_width(),
            member / groups_.columns * groups_.cell_height() + in_cell / groups_.cell_width()};
}

} // namespace blush
