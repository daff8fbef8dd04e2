// IES profiles and spreads of a scene's lights as kernels read them.
#pragma once

#include "scene/scene.h"
#include "shading/light_profile.h"

#include <cstdint>
#include <map>
#include <vector>

namespace blush {

class LightProfiles {
public:
    // The profile of `light` on a node with this transform, -1: none; and the root mean square of its IES profile relative to the peak,
    // as if that were either the peak or dark; 1 without.
    struct Added {
        int32_t profile = -1;
        double rms = 1;
    };
    Added add(const Light& light, const Affined& world_from_node);

    ProfileTables tables() const { return empty() ? ProfileTables{} : ProfileTables{records_.data(), numbers_.data()}; }
    bool empty() const { return records_.empty(); }
    size_t memory_bytes() const { return records_.capacity() * sizeof(ProfileRecord) + numbers_.capacity() * sizeof(float); }

private:
    void add_table(ProfileRecord& record, const IesProfile& profile);

    std::vector<ProfileRecord> records_;
    std::vector<float> numbers_;
    std::map<uint64_t, int32_t> first_by_serial_; // of the IES data in numbers_
};

} // namespace blush
