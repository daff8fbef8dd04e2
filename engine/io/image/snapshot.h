// Snapshot: an image with everything needed to render it again. Defines the channels and metadata of all EXR files of Blush.
#pragma once

#include "core/lossless_plane.h"
#include "core/vec.h"
#include "io/image/image_io.h"
#include "scene/render_settings.h"
#include "scene/view_settings.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace blush {

// Text metadata, stored as "blush:KEY" attributes.
struct SnapshotMetadata {
    std::string version;                       // of the program
    std::string scene;                         // the scene file's name
    std::string scene_hash;                    // scene_hash.h
    std::string camera;                        // name of the camera node, or of a free view
    int64_t spp = 0;                           // samples per pixel in the image
    int64_t first_sample = 0, last_sample = 0; // sample indices [first, last)
    uint32_t seed = 0;
    double seconds = 0;     // render time
    std::string error;      // estimated relative error as text, empty if unknown
    std::string denoised;   // how the layer "denoised" was made: network, precision, samples; empty without one
    std::string integrator; // that is not path tracing; empty for path tracing
    std::string biased;     // the integrator and why it is biased; empty if it is not
    RenderSettings settings;
    std::string edits;                // scene_edits_json.h, empty if nothing differs from the file
    bool partial = false;             // ended before any stop rule was reached
    std::optional<ViewSettings> view; // display settings, for snapshots of the window
    std::string scene_file;           // path of the scene relative to the folder of the image; empty if unknown
    std::string name, note;           // given by the user
    std::string film;                 // film state as JSON, without its planes; empty if none
    bool operator==(const SnapshotMetadata&) const = default;
};

// Planes of width * height, top row first; an empty one is left out.
struct SnapshotInput {
    int width = 0, height = 0;
    std::span<const float> rgba;     // width * height * 4, scene-linear
    std::span<const float> denoised; // width * height * 3
    std::span<const Vec3> albedo;
    std::span<const Vec3> normal;   // world space
    std::span<const float> depth;   // metres
    std::span<const Vec3> error;    // standard error of the mean
    std::span<const float> samples; // per pixel
    std::span<const uint32_t> object_id, material_id;
    std::span<const std::vector<Vec3>> bounces; // light by number of bounces
    // Light by the strategy that has found it; the planes sum to the beauty. One name per plane, as in channel names.
    std::span<const std::vector<Vec3>> strategies;
    std::span<const std::string_view> strategy_names;
    // Light by light group; the groups sum to the beauty. One name per group; characters that are not allowed in channel names
    // become underscores.
    std::span<const std::vector<Vec3>> groups;
    std::span<const std::string> group_names;
    std::span<const LosslessPlane> film; // film state to resume from
    bool half = false;                   // stores colours, albedo, normals and errors as 16-bit floats
    SnapshotMetadata metadata;
};

// Channels R G B A, then denoised.{R,G,B}, albedo.{R,G,B}, normal.{X,Y,Z}, depth.Z, error.{R,G,B}, samples.Y, bounce.N.{R,G,B},
// strategy.NAME.{R,G,B}, group.NAME.{R,G,B}, id.object, id.material, film.* (lossless_channels.h).
// Errors: a plane of the wrong size, an id of 2^24 or more, which a float channel cannot represent.
Result<LayeredImage> make_snapshot(const SnapshotInput& input);

// Number of values that exceed the range of 16-bit floats.
int64_t count_beyond_half(const LayeredImage& image);

// True if the window made it or if it can be resumed: it holds more than a plain render.
bool is_snapshot(const std::map<std::string, std::string>& metadata);
// Reads the metadata that make_snapshot wrote. Errors: not an image of Blush, or invalid metadata.
Result<SnapshotMetadata> read_snapshot_metadata(const std::map<std::string, std::string>& texts);
// The metadata as texts, as make_snapshot writes them.
std::map<std::string, std::string> snapshot_texts(const SnapshotMetadata& metadata);

} // namespace blush
