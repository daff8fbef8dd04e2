#include "app/commands/render/allocation_file.h"

#include "app/commands/common.h"
#include "core/files.h"
#include "core/hash64.h"
#include "io/project/json_fields.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace blush {
namespace {

constexpr uint64_t max_bytes = uint64_t(256) << 20;
constexpr int max_side = 65536;

bool read_shares(const Json& json, std::vector<double>& shares) {
    if (!json.is_array()) return false;
    for (const Json& item : json)
        if (!read_json(item, shares.emplace_back())) return false;
    return true;
}

} // namespace

std::string allocation_hash(const AllocationFile& a) {
    Hash64 hash;
    hash.array(a.scene_hash);
    for (const int side : {a.width, a.height}) hash.word(uint64_t(side));
    for (const std::vector<double>& half : a.shares) hash.array(half);
    return fmt::format("{:016x}", hash.value());
}

Result<void> write_allocation(const std::filesystem::path& file, const AllocationFile& a) {
    const Json json{{"allocation", 1},    {"scene_hash", a.scene_hash}, {"width", a.width},
                    {"height", a.height}, {"hash", allocation_hash(a)}, {"shares", {a.shares[0], a.shares[1]}}};
    return write_file(file, json_text(json) + "\n");
}

Result<AllocationFile> read_allocation(const std::filesystem::path& file) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_bytes);
    if (!bytes) return bytes.error();
    const std::string name = file.string();
    const Result<Json> json = parse_json_object(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
    if (!json) return in_file(json.error(), name);
    const auto member = [&](const char* key) { return json->contains(key) ? (*json)[key] : Json(); };
    AllocationFile a;
    std::string hash;
    int version = 0;
    const Json shares = member("shares");
    if (!read_json(member("allocation"), version) || version != 1)
        return Error{name, "not an allocation of adaptive sampling", "allocation"};
    const bool read = read_json(member("scene_hash"), a.scene_hash) && read_json(member("width"), a.width) &&
                      read_json(member("height"), a.height) && read_json(member("hash"), hash) && shares.is_array() && shares.size() == 2 &&
                      read_shares(shares[0], a.shares[0]) && read_shares(shares[1], a.shares[1]);
    if (!read) return Error{name, "a member is missing or has another type", ""};
    if (hash != allocation_hash(a)) return Error{name, "damaged: its hash differs", "hash"};
    SampleAllocation fits;
    if (a.width < 1 || a.height < 1 || a.width > max_side || a.height > max_side) return Error{name, "invalid size", "width"};
    fits.reset(a.width, a.height);
    if (!fits.restore(a.shares)) return Error{name, "the shares do not fit the size", "shares"};
    return a;
}

} // namespace blush
