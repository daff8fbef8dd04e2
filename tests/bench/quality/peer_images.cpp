#include "tests/bench/quality/peer_images.h"

#include "tests/bench/quality/shown_error.h"

#include "app/commands/converge/reference_cache.h"
#include "core/files.h"

namespace blush::bench {

Json peer_row(const std::filesystem::path& file, const ColorManagement& color) {
    const auto bytes = checked(read_file(file, uint64_t(1) << 20));
    const Json peer = Json::parse(bytes.begin(), bytes.end());
    const int width = peer.at("width"), height = peer.at("height");
    const auto read = [&](const Json& name, int divider) {
        return checked(read_reference_file(file.parent_path() / name.get<std::string>(), width / divider, height / divider)).measured;
    };
    const ErrorMeter meter(color, read(peer.at("reference"), 1));
    Json row{{"scene", peer.at("scene")}, {"edit", "any"}, {"image", peer.at("renderer")}};
    for (const Json& image : peer.at("images")) {
        const ShownError error = meter.of(read(image.at("file"), image.at("divider")).image);
        row["ms"].push_back(image.at("ms"));
        row["flip"].push_back(rounded(error.flip));
        row["relmse"].push_back(rounded(error.relmse));
        row["divider"].push_back(image.at("divider"));
        row["samples"].push_back(image.at("samples"));
    }
    return row;
}

} // namespace blush::bench
