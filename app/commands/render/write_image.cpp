#include "app/commands/render/write_image.h"

#include "app/common/assets_dir.h"
#include "render/film/found_by.h"
#include "render/light_mix/light_mix.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace blush {

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return extension;
}

bool is_display_encoded(const std::filesystem::path& file) {
    constexpr std::string_view formats[] = {".png", ".jpg", ".jpeg", ".webp", ".bmp"};
    return std::ranges::find(formats, lower_extension(file)) != std::end(formats);
}

Result<ImageFormat> image_format(const std::filesystem::path& file) {
    const std::string extension = lower_extension(file);
    if (extension == ".exr") return ImageFormat::exr;
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") return ImageFormat::display;
    return Error{.what = fmt::format("\"{}\" must end in .exr, .png or .jpg", file.string())};
}

Result<std::optional<ColorManagement>> color_for(ImageFormat format, const ViewSettings& view) {
    if (format == ImageFormat::exr) return std::optional<ColorManagement>();
    Result<ColorManagement> color = ColorManagement::load(assets_dir());
    if (!color) return color.error();
    float grey[3] = {0.18f, 0.18f, 0.18f};
    if (Result<void> known = show(*color, view, grey, {.albedo = std::array{Vec3{1, 1, 1}}}); !known) return known.error();
    return std::optional<ColorManagement>(*std::move(color));
}

Result<void> expect_folder(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code code;
    if (std::filesystem::is_directory(folder, code)) return {};
    return Error{.file = file.string(), .what = "its folder does not exist"};
}

Result<int64_t> write_exr_image(const std::filesystem::path& file, const Frame& frame, const ExtraLayers& extra, const Layers& layers,
                                const SnapshotMetadata& metadata) {
    SnapshotInput input;
    input.width = frame.width;
    input.height = frame.height;
    input.rgba = frame.rgba;
    input.denoised = extra.denoised;
    input.error = extra.error;
    input.film = extra.film;
    input.half = extra.half;
    input.metadata = metadata;
    if (layers.albedo) input.albedo = frame.albedo;
    if (layers.normal) input.normal = frame.normal;
    if (layers.depth) input.depth = frame.depth;
    std::vector<float> samples;
    if (layers.samples && !frame.pixel_samples.empty()) {
        input.samples = frame.pixel_samples;
    } else if (layers.samples) {
        samples.assign(frame.rgba.size() / 4, float(frame.samples));
        input.samples = samples;
    }
    if (layers.ids) {
        input.object_id = frame.object_id;
        input.material_id = frame.material_id;
    }
    input.bounces = frame.bounces;
    input.strategies = frame.strategies;
    input.strategy_names = found_by_names;
    const std::vector<std::vector<Vec3>> groups = layers.groups ? mixed_groups(frame) : std::vector<std::vector<Vec3>>();
    input.groups = groups;
    input.group_names = frame.group_names;
    Result<LayeredImage> image = make_snapshot(input);
    if (!image) return image.error();
    image->display_window = extra.display_window;
    if (const Result<void> written = write_exr(file, *image); !written) return written.error();
    return count_beyond_half(*image);
}

std::vector<float> beauty_rgb(const Frame& frame) {
    const size_t pixels = frame.rgba.size() / 4;
    std::vector<float> rgb(pixels * 3);
    for (size_t i = 0; i < pixels; ++i) std::copy_n(&frame.rgba[4 * i], 3, &rgb[3 * i]);
    return rgb;
}

Result<void> write_through_view(const std::filesystem::path& file, int width, int height, std::vector<float> rgb,
                                const ColorManagement& color, const ViewSettings& view, const std::map<std::string, std::string>& metadata,
                                const DisplayPlanes& with, std::span<const float> opacity) {
    const std::string extension = lower_extension(file);
    if (extension == ".png")
        for (size_t i = 0; i < opacity.size(); ++i)
            for (size_t c = 0; c < 3 && opacity[i] > 0; ++c) rgb[3 * i + c] /= opacity[i];
    if (Result<void> shown = show(color, view, rgb, with); !shown) return shown;
    return write_display_image(file, width, height, rgb, metadata, opacity);
}

std::string error_text(const ErrorEstimate& error) {
    return error.known ? fmt::format("{:.4g} ({:.4g} to {:.4g})", error.relmse, error.low, error.high) : std::string();
}

std::map<std::string, std::string> display_metadata(const SnapshotMetadata& metadata) {
    std::map<std::string, std::string> texts{{"blush:version", metadata.version},
                                             {"blush:scene", metadata.scene},
                                             {"blush:spp", std::to_string(metadata.spp)},
                                             {"blush:partial", metadata.partial ? "1" : "0"}};
    if (!metadata.biased.empty()) texts.emplace("blush:biased", metadata.biased);
    if (!metadata.denoised.empty()) texts.emplace("blush:denoised", metadata.denoised);
    return texts;
}

} // namespace blush
