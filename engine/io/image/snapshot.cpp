#include "io/image/snapshot.h"

#include "io/image/lossless_channels.h"
#include "io/project/settings_json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <string_view>

namespace blush {
namespace {

constexpr uint32_t first_inexact_id = 1u << 24;

// Adds planes and keeps the first error.
class Builder {
public:
    Builder(int width, int height, bool half) : half_(half), pixels_(size_t(std::max(width, 0)) * size_t(std::max(height, 0))) {
        image_.width = width;
        image_.height = height;
    }

    // Extracts a channel of interleaved values.
    void channel(const std::string& name, std::span<const float> values, size_t stride, size_t offset, bool half = false) {
        LayeredImage::Channel channel{name, std::vector<float>(pixels_), false, {}, half};
        for (size_t i = 0; i < pixels_; ++i) channel.values[i] = values[i * stride + offset];
        image_.channels.push_back(std::move(channel));
    }
    void scalars(const std::string& name, std::span<const float> values) {
        if (wanted(name, values.size(), 1)) channel(name, values, 1, 0);
    }
    // Adds interleaved values as channels of one letter each.
    void interleaved(const std::string& layer, std::string_view letters, std::span<const float> values) {
        if (!wanted(layer, values.size(), letters.size())) return;
        for (size_t c = 0; c < letters.size(); ++c) channel(layer + letters[c], values, letters.size(), c, half_);
    }
    void vectors(const std::string& layer, std::string_view letters, std::span<const Vec3> values) {
        static_assert(sizeof(Vec3) == 3 * sizeof(float));
        interleaved(layer, letters, values.empty() ? std::span<const float>() : std::span(&values.front().x, values.size() * 3));
    }
    void ids(const std::string& name, std::span<const uint32_t> values) {
        if (!wanted(name, values.size(), 1)) return;
        if (std::any_of(values.begin(), values.end(), [](uint32_t id) { return id >= first_inexact_id; }))
            fail("an id is too large to be stored", name);
        image_.channels.push_back({name, std::vector<float>(values.begin(), values.end()), true});
    }

    void exact(const std::string& layer, std::span<const LosslessPlane> planes) {
        for (const LosslessPlane& plane : planes)
            if (wanted(layer + "." + plane.name, plane.size(), 1)) add_lossless_plane(image_, layer, plane);
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

    bool half_;
    size_t pixels_;
    LayeredImage image_;
    std::optional<Error> error_;
};

// Channel-safe group names: printable, without dots, of limited length, unique.
std::vector<std::string> channel_names(std::span<const std::string> names) {
    constexpr size_t max_length = 180; // OpenEXR's limit for the full channel name is 255
    std::vector<std::string> channels;
    std::set<std::string> taken;
    for (const std::string& name : names) {
        std::string plain = name.substr(0, max_length);
        for (char& c : plain)
            if (c < ' ' || c > '~' || c == '.') c = '_';
        std::string channel = plain;
        for (int n = 2; !taken.insert(channel).second; ++n) channel = fmt::format("{} {}", plain, n);
        channels.push_back(std::move(channel));
    }
    return channels;
}

// Reads an attribute as a number; the default if absent or empty; false if invalid.
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

std::map<std::string, std::string> snapshot_texts(const SnapshotMetadata& m) {
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
    if (m.view) texts.emplace("blush:view", view_settings_json(*m.view));
    for (const auto& [key, text] : {std::pair("blush:scene_file", &m.scene_file), std::pair("blush:name", &m.name),
                                    std::pair("blush:note", &m.note), std::pair("blush:film", &m.film)})
        if (!text->empty()) texts.emplace(key, *text);
    if (!m.integrator.empty()) texts.emplace("blush:integrator", m.integrator);
    if (!m.biased.empty()) texts.emplace("blush:biased", m.biased);
    if (m.partial) texts.emplace("blush:partial", "1");
    return texts;
}

Result<LayeredImage> make_snapshot(const SnapshotInput& input) {
    if (input.width < 1 || input.height < 1 || input.rgba.empty()) return Error{"", "a snapshot without pixels", ""};
    Builder builder(input.width, input.height, input.half);
    builder.interleaved("", "RGBA", input.rgba);
    builder.interleaved("denoised.", "RGB", input.denoised);
    builder.vectors("albedo.", "RGB", input.albedo);
    builder.vectors("normal.", "XYZ", input.normal);
    builder.scalars("depth.Z", input.depth);
    builder.vectors("error.", "RGB", input.error);
    builder.scalars("samples.Y", input.samples);
    for (size_t k = 0; k < input.bounces.size(); ++k) builder.vectors(fmt::format("bounce.{}.", k), "RGB", input.bounces[k]);
    for (size_t k = 0; k < std::min(input.strategies.size(), input.strategy_names.size()); ++k)
        builder.vectors(fmt::format("strategy.{}.", input.strategy_names[k]), "RGB", input.strategies[k]);
    const std::vector<std::string> groups = channel_names(input.group_names);
    for (size_t k = 0; k < std::min(groups.size(), input.groups.size()); ++k)
        builder.vectors(fmt::format("group.{}.", groups[k]), "RGB", input.groups[k]);
    builder.ids("id.object", input.object_id);
    builder.ids("id.material", input.material_id);
    builder.exact("film", input.film);
    return std::move(builder).done(snapshot_texts(input.metadata));
}

int64_t count_beyond_half(const LayeredImage& image) {
    int64_t count = 0;
    for (const LayeredImage::Channel& channel : image.channels)
        if (channel.is_half) count += std::ranges::count_if(channel.values, [](float v) { return std::abs(v) > max_half; });
    return count;
}

bool is_snapshot(const std::map<std::string, std::string>& metadata) {
    return metadata.contains("blush:version") && (metadata.contains("blush:view") || metadata.contains("blush:film"));
}

Result<SnapshotMetadata> read_snapshot_metadata(const std::map<std::string, std::string>& texts) {
    const auto text = [&](const char* key) {
        const auto it = texts.find(key);
        return it == texts.end() ? std::string() : it->second;
    };
    if (!texts.contains("blush:version")) return Error{"", "not an image of Blush: it has no blush:version", ""};
    SnapshotMetadata m;
    m.version = text("blush:version");
    m.scene = text("blush:scene");
    m.scene_hash = text("blush:scene_hash");
    m.camera = text("blush:camera");
    m.error = text("blush:error");
    m.denoised = text("blush:denoised");
    m.integrator = text("blush:integrator");
    m.biased = text("blush:biased");
    m.edits = text("blush:edits");
    m.partial = text("blush:partial") == "1";
    m.scene_file = text("blush:scene_file");
    m.name = text("blush:name");
    m.note = text("blush:note");
    m.film = text("blush:film");
    if (!read_number(text("blush:spp"), m.spp)) return Error{"", "not a number", "blush:spp"};
    if (!read_range(text("blush:samples"), m.first_sample, m.last_sample)) return Error{"", "not a range A:B", "blush:samples"};
    if (!read_number(text("blush:seed"), m.seed)) return Error{"", "not a number", "blush:seed"};
    if (!read_number(text("blush:seconds"), m.seconds)) return Error{"", "not a number", "blush:seconds"};
    if (const std::string settings = text("blush:settings"); !settings.empty()) {
        const auto parsed = parse_render_settings(settings);
        if (!parsed) return Error{"", parsed.error().what, "blush:settings " + parsed.error().where};
        m.settings = parsed->settings;
    }
    if (const std::string view = text("blush:view"); !view.empty()) {
        const auto parsed = parse_view_settings(view);
        if (!parsed) return Error{"", parsed.error().what, "blush:view " + parsed.error().where};
        m.view = parsed->settings;
    }
    return m;
}

} // namespace blush
