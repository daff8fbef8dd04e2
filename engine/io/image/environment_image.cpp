#include "io/image/environment_image.h"

#include "core/srgb.h"
#include "io/image/image_channels.h"

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>

namespace blush {
namespace {

std::vector<float> linear_floats(const Image& image) {
    if (image.bytes.empty()) return image.floats;
    std::array<float, 256> alpha, color;
    for (size_t i = 0; i < 256; ++i) {
        alpha[i] = float(i) / 255;
        color[i] = linear_from_srgb(alpha[i]);
    }
    std::vector<float> floats(image.bytes.size());
    for (size_t i = 0; i < floats.size(); ++i) floats[i] = (image.channels == 4 && i % 4 == 3 ? alpha : color)[image.bytes[i]];
    return floats;
}

Result<ImagePtr> as_environment(const Result<ImagePtr>& read) {
    if (!read) return read.error();
    const ImagePtr colored = with_color_channels(*read);
    if (!colored->floats.empty()) return colored;
    auto image = std::make_shared<Image>();
    image->width = colored->width;
    image->height = colored->height;
    image->channels = colored->channels;
    image->floats = linear_floats(*colored);
    return ImagePtr(std::move(image));
}

// A file in a certain state: another one if it is written again.
struct FileState {
    std::filesystem::path file;
    std::filesystem::file_time_type written;
    uintmax_t size = 0;
    auto operator<=>(const FileState&) const = default;
};

std::optional<FileState> state_of(const std::filesystem::path& file) {
    std::error_code failed[3];
    FileState state{std::filesystem::canonical(file, failed[0]), std::filesystem::last_write_time(file, failed[1]),
                    std::filesystem::file_size(file, failed[2])};
    if (std::ranges::any_of(failed, [](const std::error_code& e) { return bool(e); })) return {};
    return state;
}

// The maps that are in use.
class ReadMaps {
public:
    ImagePtr find(const FileState& state) {
        const std::lock_guard lock(mutex_);
        const auto known = maps_.find(state);
        return known == maps_.end() ? nullptr : known->second.lock();
    }
    void keep(const FileState& state, const ImagePtr& image) {
        const std::lock_guard lock(mutex_);
        std::erase_if(maps_, [](const auto& entry) { return entry.second.expired(); });
        maps_[state] = image;
    }

private:
    std::mutex mutex_;
    std::map<FileState, std::weak_ptr<const Image>> maps_;
};

} // namespace

Result<ImagePtr> read_environment_image(const std::filesystem::path& file, const ImageLimits& limits) {
    static ReadMaps& read_maps = *new ReadMaps; // never destroyed, as images may outlive static objects
    const std::optional<FileState> state = state_of(file);
    if (state)
        if (ImagePtr known = read_maps.find(*state)) return known;
    Result<ImagePtr> image = as_environment(read_image(file, limits));
    if (image && state && state == state_of(file)) read_maps.keep(*state, *image);
    return image;
}

Result<ImagePtr> read_environment_image(std::span<const uint8_t> bytes, const std::string& name, const ImageLimits& limits) {
    return as_environment(read_image(bytes, name, limits));
}

} // namespace blush
