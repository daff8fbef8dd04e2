// A picture with everything needed to make it again: channels and metadata as every EXR of ours has them.
#pragma once

#include "core/exact_plane.h"
#include "core/vec.h"
#include "io/image_io.h"
#include "scene/render_settings.h"
#include "scene/view_settings.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace blush {

// The text beside the pixels, as "blush:KEY" attributes.
struct SnapshotMetadata {
    std::string version;                       // of the program
    std::string scene;                         // the scene file's name
    std::string scene_hash;                    // scene_hash.h
    std::string camera;                        // name of the camera node, or a free view
    int64_t spp = 0;                           // samples per pixel that the picture holds
    int64_t first_sample = 0, last_sample = 0; // sample indices [first, last)
    uint32_t seed = 0;
    double seconds = 0; // of rendering
    std::string error;    // estimated relative error as text, empty if unknown
    std::string denoised; // what made the layer of that name: network, precision, samples; empty without one
    RenderSettings settings;
    std::string edits;    // scene_edits_json.h, empty if nothing differs from the file
    bool partial = false; // ended before any stop rule was reached
    std::optional<ViewSettings> view; // how it was looked at; of the window's snapshots
    std::string scene_file;           // path of the scene, relative to the folder of the picture; empty if not known
    std::string name, note;           // as the user calls it
    std::string film;                 // JSON of the film state beside its planes; empty without one
    bool operator==(const SnapshotMetadata&) const = default;
};

// Planes of width * height, top row first; an empty one is left out.
struct SnapshotInput {
    int width = 0, height = 0;
    std::span<const float> rgba; // width * height * 4, scene-linear
    std::span<const float> denoised; // width * height * 3
    std::span<const Vec3> albedo;
    std::span<const Vec3> normal;   // world space
    std::span<const float> depth;   // metres
    std::span<const Vec3> error;    // standard error of the mean
    std::span<const float> samples; // per pixel
    std::span<const uint32_t> object_id, material_id;
    std::span<const std::vector<Vec3>> bounces; // light by the number of scatterings
    // Light by the group of lights that it came from: the groups sum to the beauty. As many names; characters that channels cannot have in
    // theirs become underscores.
    std::span<const std::vector<Vec3>> groups;
    std::span<const std::string> group_names;
    std::span<const ExactPlane> film;           // what rendering goes on from
    bool half = false;                          // colours, albedo, normals and errors in 16 bits: half the size
    SnapshotMetadata metadata;
};

// Channels R G B A, then denoised.{R,G,B}, albedo.{R,G,B}, normal.{X,Y,Z}, depth.Z, error.{R,G,B}, samples.Y, bounce.N.{R,G,B},
// group.NAME.{R,G,B}, id.object, id.material, film.* (exact_channels.h).
// Errors: a plane of the wrong size, an id of 2^24 or more, which a float channel cannot carry.
Result<LayeredImage> make_snapshot(const SnapshotInput& input);

// Values of the picture that 16 bits cannot hold.
int64_t beyond_half(const LayeredImage& image);

// Was it made by the window or to be gone on with: does it say more than what it is a picture of?
bool is_snapshot(const std::map<std::string, std::string>& metadata);
// What make_snapshot wrote. Errors: not one of our pictures, or metadata that do not make sense.
Result<SnapshotMetadata> read_snapshot_metadata(const std::map<std::string, std::string>& texts);
// And back, as make_snapshot writes them.
std::map<std::string, std::string> snapshot_texts(const SnapshotMetadata& metadata);

} // namespace blush
