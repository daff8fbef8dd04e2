// A finished frame as a file: an EXR with layers and metadata, or a PNG or JPEG as the display shows it.
#pragma once

#include "app/commands/layers.h"
#include "color/color_management.h"
#include "io/displayed.h"
#include "io/snapshot.h"
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
// By extension: do such files hold what a display shows (PNG, JPEG, WebP, BMP)? Others hold scene-linear values.
bool is_display_encoded(const std::filesystem::path& file);

enum class PictureFormat { exr, display };
// By extension. Errors: one that is neither .exr nor .png, .jpg, .jpeg.
Result<PictureFormat> picture_format(const std::filesystem::path& file);

// The colour management, if the picture needs one, and proof that its view is there: found out before hours of rendering.
// Errors: a broken config, an unknown display or view.
Result<std::optional<ColorManagement>> color_for(PictureFormat format, const ViewSettings& view);

// Is there a folder to write it into? Errors: no.
Result<void> expect_folder(const std::filesystem::path& file);

// What goes into an EXR beside what the frame holds; empty: not there.
struct ExtraLayers {
    std::span<const float> denoised = {};  // width * height * 3
    std::span<const Vec3> error = {};      // Renderer::resolve_error's answer
    std::span<const ExactPlane> film = {}; // planes_in_file()'s; metadata.film is the rest of it
    bool half = false;                     // as SnapshotInput has it
    std::optional<PixelRect> display_window = {}; // what of it is the picture; empty: all of it
};
// Returns how many values 16 bits could not hold, if they were to.
Result<int64_t> write_exr_picture(const std::filesystem::path& file, const Frame& frame, const ExtraLayers& extra, const Layers& layers,
                               const SnapshotMetadata& metadata);

// width * height * 3, scene-linear: red, green and blue without alpha.
std::vector<float> beauty_rgb(const Frame& frame);
// Scene-linear `rgb` as the display shows it. `opacity`: of a picture that is to be laid over others, whose colours are multiplied by it
// (opacity_of()); a PNG gets it as its alpha, with straight colours, a JPEG shows the picture over black. Empty: opaque.
Result<void> write_display_picture(const std::filesystem::path& file, int width, int height, std::vector<float> rgb,
                                   const ColorManagement& color, const ViewSettings& view,
                                   const std::map<std::string, std::string>& metadata, const ShownWith& with = {},
                                   std::span<const float> opacity = {});
// "0.0012 (0.0010 to 0.0014)": the estimated relative error as metadata have it; empty if not known.
std::string error_text(const ErrorEstimate& error);
// What of a render's metadata a display picture carries.
std::map<std::string, std::string> display_metadata(const SnapshotMetadata& metadata);

} // namespace blush
