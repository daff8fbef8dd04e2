#include "app/commands/picture.h"

#include "app/assets_dir.h"

#include <fmt/format.h>

#include <algorithm>

namespace blush {

Result<PictureFormat> picture_format(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (extension == ".exr") return PictureFormat::exr;
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") return PictureFormat::display;
    return Error{.what = fmt::format("\"{}\" must end in .exr, .png or .jpg", file.string())};
}

Result<std::optional<ColorManagement>> color_for(PictureFormat format, const ViewSettings& view) {
    if (format == PictureFormat::exr) return std::optional<ColorManagement>();
    Result<ColorManagement> color = ColorManagement::load(assets_dir());
    if (!color) return color.error();
    float grey[3] = {0.18f, 0.18f, 0.18f};
    if (Result<void> known = color->apply_display(view.display, view.view, view.exposure_ev, view.gamma, grey, 1); !known)
        return known.error();
    return std::optional<ColorManagement>(*std::move(color));
}

Result<void> write_exr_picture(const std::filesystem::path& file, const Frame& frame, const std::vector<Vec3>& error, const Layers& layers,
                               const SnapshotMetadata& metadata) {
    SnapshotInput input;
    input.width = frame.width;
    input.height = frame.height;
    input.rgba = frame.rgba;
    input.metadata = metadata;
    if (layers.albedo) input.albedo = frame.albedo;
    if (layers.normal) input.normal = frame.normal;
    if (layers.depth) input.depth = frame.depth;
    if (layers.error) input.error = error;
    std::vector<float> samples;
    if (layers.samples) {
        samples.assign(frame.rgba.size() / 4, float(frame.samples));
        input.samples = samples;
    }
    if (layers.ids) {
        input.object_id = frame.object_id;
        input.material_id = frame.material_id;
    }
    input.bounces = frame.bounces;
    const Result<LayeredImage> image = make_snapshot(input);
    if (!image) return image.error();
    return write_exr(file, *image);
}

Result<void> write_display_picture(const std::filesystem::path& file, const Frame& frame, const ColorManagement& color,
                                   const ViewSettings& view, const SnapshotMetadata& metadata) {
    const size_t pixels = frame.rgba.size() / 4;
    std::vector<float> rgb(pixels * 3);
    for (size_t i = 0; i < pixels; ++i) std::copy_n(&frame.rgba[4 * i], 3, &rgb[3 * i]);
    if (Result<void> shown = color.apply_display(view.display, view.view, view.exposure_ev, view.gamma, rgb.data(), pixels); !shown)
        return shown;
    return write_display_image(file, frame.width, frame.height, rgb,
                               {{"blush:version", metadata.version},
                                {"blush:scene", metadata.scene},
                                {"blush:spp", std::to_string(metadata.spp)},
                                {"blush:partial", metadata.partial ? "1" : "0"}});
}

} // namespace blush
