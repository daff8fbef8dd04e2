// A finished frame as a file: an EXR with layers and metadata, or a PNG or JPEG as the display shows it.
#pragma once

#include "app/commands/layers.h"
#include "color/color_management.h"
#include "io/snapshot.h"
#include "scene/view_settings.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace blush {

enum class PictureFormat { exr, display };
// By extension. Errors: one that is neither .exr nor .png, .jpg, .jpeg.
Result<PictureFormat> picture_format(const std::filesystem::path& file);

// The colour management, if the picture needs one, and proof that its view is there: found out before hours of rendering.
// Errors: a broken config, an unknown display or view.
Result<std::optional<ColorManagement>> color_for(PictureFormat format, const ViewSettings& view);

// `error` is Renderer::resolve_error's answer, empty unless that layer is wanted.
Result<void> write_exr_picture(const std::filesystem::path& file, const Frame& frame, const std::vector<Vec3>& error, const Layers& layers,
                               const SnapshotMetadata& metadata);
Result<void> write_display_picture(const std::filesystem::path& file, const Frame& frame, const ColorManagement& color,
                                   const ViewSettings& view, const SnapshotMetadata& metadata);

} // namespace blush
