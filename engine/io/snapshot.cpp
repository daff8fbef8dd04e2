#include "io/snapshot.h"

#include "io/settings_json.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string_view>

namespace blush {
namespace {

constexpr uint32_t first_inexact_id = 1u << 24;

// Adds planes and keeps the first thing that is wrong with one.
class Builder {
public:
    Builder(int width, int height) : pixels_(size_t(std::max(width, 0)) * size_t(std::max(height, 0))) {
        image_.width = width;
        image_.height = height;
    }

    // One channel of interleaved values.
    void channel(const std::string& name, std::span<const float> values, size_t stride, size_t offset) {
        LayeredImage::Channel channel{name, std::vector<float>(pixels_), false};
        for (size_t i = 0; i < pixels_; ++i) channel.values[i] = values[i * stride + offset];
        image_.channels.push_back(std::move(channel));
    }
    void scalars(const std::string& name, std::span<const float> values) {
        if (wanted(name, values.size(), 1)) channel(name, values, 1, 0);
    }
    // Interleaved values under one letter each.
    void interleaved(const std::string& layer, std::string_view letters, std::span<const float> values) {
        if (!wanted(layer, values.size(), letters.size())) return;
        for (size_t c = 0; c < letters.size(); ++c) channel(layer + letters[c], values, letters.size(), c);
    }
    void vectors(const std::string& layer, std::string_view letters, std::span<const Vec3> values) {
        static_assert(sizeof(Vec3) == 3 * sizeof(float));
        interleaved(layer, letters, values.empty() ? std::span<const float>() : std::span(&values.front().x, values.size() * 3));
    }
    void ids(const std::string& name, std::span<const uint32_t> values) {
        if (!wanted(name, values.size(), 1)) return;
        if (std::any_of(values.begin(), values.end(), [](uint32_t id) { return id >= first_inexact_id; }))
            fail("an id is too large to be kept", name);
        image_.channels.push_back({name, std::vector<float>(values.begin(), values.end()), true});
    }

    Result<LayeredImage> done(std::map<std::string, std::string> metadata) && {
        if (error_) return *error_;
        image_.metadata = std::move(metadata);
        return std::move(image_);
    }

private:
    bool wanted(const std::string& name, size_t size, size_t components) {
        if (size != 0 && size != pixels_ * components) fail("a plane of the wrong size", name);
        return size != 0 && !error_;
    }
    void fail(const char* what, const std::string& where) {
        if (!error_) error_ = Error{"", what, where};
    }

    size_t pixels_;
    LayeredImage image_;
    std::optional<Error> error_;
};

std::map<std::string, std::string> metadata_texts(const SnapshotMetadata& m) {
    std::map<std::string, std::string> texts{
        {"blush:version", m.version},
        {"blush:scene", m.scene},
        {"blush:scene_hash", m.scene_hash},
        {"blush:camera", m.camera},
        {"blush:spp", fmt::format("{}", m.spp)},
        {"blush:samples", fmt::format("{}:{}", m.first_sample, m.last_sample)},
        {"blush:seed", fmt::format("{}", m.seed)},
        {"blush:seconds", fmt::format("{}", m.seconds)},
        {"blush:error", m.error},
        {"blush:settings", render_settings_json(m.settings)},
        {"blush:edits", m.edits},
    };
    if (!m.denoised.empty()) texts.emplace("blush:denoised", m.denoised);
    if (m.partial) texts.emplace("blush:partial", "1");
    return texts;
}

// The attribute as a number, its default if it is absent or empty; false if it is neither.
template <class T> bool read_number(std::string_view text, T& number) {
    if (text.empty()) return true;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
    return code == std::errc() && end == text.data() + text.size();
}

bool read_range(std::string_view text, int64_t& first, int64_t& last) {
    const size_t colon = text.find(':');
    return text.empty() || (colon != text.npos && read_number(text.substr(0, colon), first) && read_number(text.substr(colon + 1), last));
}

} // namespace

Result<LayeredImage> make_snapshot(const SnapshotInput& input) {
    if (input.width < 1 || input.height < 1 || input.rgba.empty()) return Error{"", "a snapshot without pixels", ""};
    Builder builder(input.width, input.height);
    builder.interleaved("", "RGBA", input.rgba);
    builder.interleaved("denoised.", "RGB", input.denoised);
    builder.vectors("albedo.", "RGB", input.albedo);
    builder.vectors("normal.", "XYZ", input.normal);
    builder.scalars("depth.Z", input.depth);
    builder.vectors("error.", "RGB", input.error);
    builder.scalars("samples.Y", input.samples);
    for (size_t k = 0; k < input.bounces.size(); ++k) builder.vectors(fmt::format("bounce.{}.", k), "RGB", input.bounces[k]);
    builder.ids("id.object", input.object_id);
    builder.ids("id.material", input.material_id);
    return std::move(builder).done(metadata_texts(input.metadata));
}

Result<SnapshotMetadata> read_snapshot_metadata(const LayeredImage& image) {
    const auto text = [&](const char* key) {
        const auto it = image.metadata.find(key);
        return it == image.metadata.end() ? std::string() : it->second;
    };
    if (!image.metadata.contains("blush:version")) return Error{"", "not a picture of ours: it has no blush:version", ""};
    SnapshotMetadata m;
    m.version = text("blush:version");
    m.scene = text("blush:scene");
    m.scene_hash = text("blush:scene_hash");
    m.camera = text("blush:camera");
    m.error = text("blush:error");
    m.denoised = text("blush:denoised");
    m.edits = text("blush:edits");
    m.partial = text("blush:partial") == "1";
    if (!read_number(text("blush:spp"), m.spp)) return Error{"", "not a number", "blush:spp"};
    if (!read_range(text("blush:samples"), m.first_sample, m.last_sample)) return Error{"", "not a range A:B", "blush:samples"};
    if (!read_number(text("blush:seed"), m.seed)) return Error{"", "not a number", "blush:seed"};
    if (!read_number(text("blush:seconds"), m.seconds)) return Error{"", "not a number", "blush:seconds"};
    if (const std::string settings = text("blush:settings"); !settings.empty()) {
        const auto parsed = parse_render_settings(settings);
        if (!parsed) return Error{"", parsed.error().what, "blush:settings " + parsed.error().where};
        m.settings = parsed->settings;
    }
    return m;
}

} // namespace blush
