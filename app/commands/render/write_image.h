// Writes a finished frame: an EXR with layers and metadata, or a PNG or JPEG after the view transform.
#pragma once

#include "app/commands/render/layers.h"
#include "color/color_management.h"
#include "io/image/display_image.h"
#include "io/image/snapshot.h"
#include "render/frame.h"
#include "scene/view_settings.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace blush {

// ".exr" for "A.EXR".
std::string lower_extension(const std::filesystem::path& file);
// By extension: true for display-encoded formats (PNG, JPEG, WebP, BMP). Others are scene-linear.
bool is_display_encoded(const std::filesystem::path& file);

enum class ImageFormat { exr, display };
// By extension. Errors: neither .exr nor .png, .jpg, .jpeg.
Result<ImageFormat> image_format(const std::filesystem::path& file);

// Loads the colour management, if the output needs it, and checks its view, so that errors are found before a long render.
// Errors: invalid config, unknown display or view.
Result<std::optional<ColorManagement>> color_for(ImageFormat format, const ViewSettings& view);

// Checks that the output folder exists.
Result<void> expect_folder(const std::filesystem::path& file);

// Optional content of an EXR; empty: not written.
struct ExtraLayers {
    std::span<const float> denoised = {};         // width * height * 3
    std::span<const Vec3> error = {};             // result of Renderer::resolve_error
    std::span<const LosslessPlane> film = {};     // from planes_in_file(); the rest of the film is metadata.film
    bool half = false;                            // as in SnapshotInput
    std::optional<PixelRect> display_window = {}; // the part that is the image; empty: all of it
};
// Returns the number of values outside the range of 16 bits, if `half`.
Result<int64_t> write_exr_image(const std::filesystem::path& file, const Frame& frame, const ExtraLayers& extra, const Layers& layers,
                                const SnapshotMetadata& metadata);

// width * height * 3, scene-linear: red, green and blue without alpha.
std::vector<float> beauty_rgb(const Frame& frame);
// Applies the view transform to scene-linear `rgb`. `opacity` (opacity_of()): the alpha of premultiplied colours; written to a
// PNG as straight alpha, composited over black for a JPEG. Empty: opaque.
Result<void> write_through_view(const std::filesystem::path& file, int width, int height, std::vector<float> rgb,
                                const ColorManagement& color, const ViewSettings& view, const std::map<std::string, std::string>& metadata,
                                const DisplayPlanes& with = {}, std::span<const float> opacity = {});
// "0.0012 (0.0010 to 0.0014)": the estimated relative error for metadata; empty if unknown.
std::string error_text(const ErrorEstimate& error);
// The render metadata stored in a PNG or JPEG.
std::map<std::string, std::string> display_metadata(const SnapshotMetadata& metadata);

} // namespace blush
