// The document: what the user edits and saves. Plain values; knows nothing of rays.
//
// Units: metres, radians where a name ends in _radians, degrees where it ends in _degrees. Working space:
// scene-linear Rec.709 primaries. Photometric units as in glTF: candela, lux, nits.
// Heavy payloads (Geometry, Image) are immutable behind shared_ptr<const T> and carry a serial number given at
// creation; two payloads are the same data if and only if their serials are equal.
#pragma once

#include "core/numbered_arrays.h"
#include "core/vec.h"
#include "scene/cow.h"
#include "scene/motion.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// A new serial number for a payload; never 0, never repeated in this process. Thread-safe.
uint64_t next_payload_serial();

// Tangents that did not come with a mesh but were computed (scene/tangents.h), and what has to be known to do without them again.
struct MadeTangents {
    int uv_set = -1;              // which they follow
    std::vector<uint32_t> copies; // for each vertex that was added for them, behind all others, which one it is a copy of
};

// Triangles of one material. Immutable once shared. Optional arrays are empty or have positions.size() entries.
struct Geometry {
    uint64_t serial = next_payload_serial();
    NumbersPtr vertex_numbers, index_numbers; // of the arrays of a large one (placed_geometry.h); they end after them
    PlacedVector<Vec3> positions;
    PlacedVector<Vec3> normals;
    PlacedVector<Vec4> tangents; // xyz and the handedness w = +-1, as in glTF
    std::optional<MadeTangents> made_tangents; // if they are no part of the mesh
    std::vector<PlacedVector<Vec2>> uv; // uv[i] is TEXCOORD_i; (0, 0) is the top left corner of the image, as in glTF
    PlacedVector<Vec4> colors;   // linear RGBA, multiplies the base colour
    PlacedVector<uint32_t> indices; // 3 per triangle, all < positions.size()
    bool flat = false;             // the normals are the triangles' own: they are made anew where something bends
    std::vector<MorphTargetPtr> targets;
    std::vector<Influence> influences; // empty, or as many for each vertex, their weights summing to 1

    size_t triangle_count() const { return indices.size() / 3; }
    bool has_uv_set(int set) const { return size_t(set) < uv.size() && !uv[size_t(set)].empty(); }
};

// Decoded pixels, top row first. Immutable once shared.
struct Image {
    uint64_t serial = next_payload_serial();
    int width = 0, height = 0, channels = 0; // channels 1..4
    std::vector<uint8_t> bytes;  // width * height * channels, or empty
    std::vector<float> floats;   // the same in float, exactly one of the two is filled
};

using GeometryPtr = std::shared_ptr<const Geometry>;
using ImagePtr = std::shared_ptr<const Image>;

struct Texture {
    enum class Wrap : uint8_t { repeat, clamp_to_edge, mirrored_repeat };
    enum class Filter : uint8_t { linear, nearest };
    std::string name;
    std::string source; // path relative to the scene file, or "embedded"
    ImagePtr image;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    Filter filter = Filter::linear;
    bool operator==(const Texture&) const = default;
};

// Texture coordinates come in sets with numbers up to this one.
constexpr int most_uv_set = 255;

// A texture as a material uses it: which UV set and KHR_texture_transform.
struct TextureRef {
    Id<Texture> texture;
    uint8_t uv_set = 0; // 0 .. most_uv_set
    Vec2 offset{0, 0}, scale{1, 1};
    float rotation_radians = 0; // counter-clockwise, as in KHR_texture_transform
    bool operator==(const TextureRef&) const = default;
};

// glTF 2.0 metallic-roughness (Appendix B) with the extensions named beside the fields.
struct Material {
    enum class Alpha : uint8_t { opaque, mask, blend };
    std::string name;
    Vec3 base_color{1, 1, 1};        // linear reflectance
    float opacity = 1;               // baseColorFactor.a
    float metallic = 1, roughness = 1;
    Vec3 emissive{0, 0, 0};          // emissiveFactor
    float emissive_strength = 1;     // KHR_materials_emissive_strength; emissive * strength is in nits
    bool emits = true;               // false: its glow is muted
    bool solo = false;               // its glow is, as a light may be
    float normal_scale = 1;
    Alpha alpha = Alpha::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;              // KHR_materials_unlit
    float ior = 1.5f;                // KHR_materials_ior
    float specular = 1;              // KHR_materials_specular: factor and colour; 0 is a pure Lambertian
    Vec3 specular_color{1, 1, 1};
    float transmission = 0;          // KHR_materials_transmission
    float thickness = 0;             // KHR_materials_volume: 0 is thin-walled, more is solid (the value itself is not used)
    Vec3 attenuation_color{1, 1, 1};
    float attenuation_distance = 0;  // metres; 0 means no absorption (glTF's default of infinity)
    TextureRef base_color_texture;   // sRGB; alpha is opacity
    TextureRef metallic_roughness_texture; // linear: G roughness, B metallic
    TextureRef normal_texture;       // linear, tangent space
    TextureRef emissive_texture;     // sRGB
    TextureRef specular_texture;     // linear: A
    TextureRef specular_color_texture; // sRGB
    TextureRef transmission_texture; // linear: R
    float clearcoat = 0;             // KHR_materials_clearcoat: a second, colourless reflection of index 1.5 on top of all else
    float clearcoat_roughness = 0;
    float clearcoat_normal_scale = 1;
    TextureRef clearcoat_texture;    // linear: R
    TextureRef clearcoat_roughness_texture; // linear: G
    TextureRef clearcoat_normal_texture;    // linear, tangent space; the coat does not follow normal_texture
    Vec3 sheen_color{0, 0, 0};       // KHR_materials_sheen: reflectance of upright fibres below the coat
    float sheen_roughness = 0;
    TextureRef sheen_color_texture;  // sRGB
    TextureRef sheen_roughness_texture; // linear: A
    float anisotropy = 0;            // KHR_materials_anisotropy: stretches reflections along a direction in the surface
    float anisotropy_rotation_radians = 0; // of that direction, counter-clockwise from the tangent
    TextureRef anisotropy_texture;   // linear: RG direction as of a normal map, B strength
    float iridescence = 0;           // KHR_materials_iridescence: a thin film on the surface
    float iridescence_ior = 1.3f;
    float iridescence_thickness_minimum = 100, iridescence_thickness_maximum = 400; // nanometres; without texture the maximum
    TextureRef iridescence_texture;  // linear: R
    TextureRef iridescence_thickness_texture; // linear: G, from minimum to maximum
    float dispersion = 0;            // KHR_materials_dispersion: 20 / Abbe number, of solids
    float diffuse_transmission = 0;  // KHR_materials_diffuse_transmission: share of the diffuse part that goes through
    Vec3 diffuse_transmission_color{1, 1, 1};
    TextureRef diffuse_transmission_texture;       // linear: A
    TextureRef diffuse_transmission_color_texture; // sRGB
    bool operator==(const Material&) const = default;
};

// A mesh is a list of parts (glTF primitives); nodes that share a mesh are instances of it.
struct MeshPart {
    GeometryPtr geometry;
    Id<Material> material; // none: glTF's default material
    std::vector<Id<Material>> by_variant = {}; // empty: always the same; else the one without a variant, then each variant's, none for the first
    bool operator==(const MeshPart&) const = default;
};
struct Mesh {
    std::string name;
    std::vector<MeshPart> parts;
    std::vector<std::string> target_names = {}; // of morph targets, as far as they have any
    bool operator==(const Mesh&) const = default;
};

// What a luminaire sends where, as measured (ANSI/IES LM-63); immutable once shared. See scene/ies_profile.h.
struct IesProfile;
using IesPtr = std::shared_ptr<const IesProfile>;

struct Node;

// Objects, named or all but those named; a node stands for all that hangs below it.
struct ObjectSet {
    bool all_but = true;
    std::vector<Id<Node>> nodes;
    bool operator==(const ObjectSet&) const = default;
};

// Emits along its node's -Z axis (glTF); a rectangle spans its node's X and Y, a disk lies in them.
struct Light {
    enum class Kind : uint8_t { point, spot, sun, rectangle, disk, sphere };
    enum class Unit : uint8_t { own, watt, lumen, candela, lux, nits, ev };
    std::string name;
    Kind kind = Kind::point;
    Vec3 color{1, 1, 1};          // linear RGB tint
    bool use_temperature = false; // multiply by the colour of a black body at `kelvin`
    float kelvin = 6500;
    float green_tint = 0;         // with a temperature: distance from the Planckian locus, -0.05 (magenta) .. 0.05 (green), in CIE 1960 uv
    float intensity = 1;          // point, spot: candela; sun: lux on a surface that faces it; rectangle, disk, sphere: nits
    Unit unit = Unit::own;        // what the window states the intensity in; it is kept as above
    bool keep_power = false;      // rectangle, disk, sphere: resizing in the window keeps the luminous flux rather than the nits
    float radius = 0;             // metres. point: 0 is a point, more a sphere of the same intensity; disk, sphere: its own; spot: as a point's
    float angle_radians = 0;      // sun: full angle it subtends; 0 is a perfectly parallel beam (the real sun: 0.00925)
    float inner_cone_radians = 0; // spot: half angles, KHR_lights_punctual
    float outer_cone_radians = 0.7853982f;
    float width = 1, height = 1;  // rectangle: metres, before the node's scale
    bool two_sided = false;       // rectangle, disk
    float spread_radians = 3.1415927f; // rectangle, disk: full angle of the cone that they shine into; pi is all of the half space
    bool visible_to_camera = true; // those with a size: seen directly; others always see them by reflection
    IesPtr ies;                   // point, spot: scales the intensity by direction
    std::string ies_file;         // where it came from
    bool enabled = true;          // false is muted
    bool solo = false;            // while any light is solo, only those shine; muted ones never do
    std::string group;            // of the light mix, where groups are made by hand
    ObjectSet lit_objects;        // what it lights
    ObjectSet shadow_casters;     // what stands in its way
    bool operator==(const Light&) const = default;
};

// Perspective (pinhole or thin lens) or orthographic projection; looks along -Z of its frame, +Y up (glTF).
struct Lens {
    bool orthographic = false;
    float yfov_radians = 0.6911112f; // vertical, of the whole image
    float ymag = 1;                  // orthographic: half the height of the view in metres
    float aperture_radius = 0;       // metres; 0 is a pinhole
    float focus_distance = 1;        // metres along the view axis to the plane in focus
    bool operator==(const Lens&) const = default;
};
struct Camera {
    std::string name;
    Lens lens;
    bool operator==(const Camera&) const = default;
};

// Places of the copies of a node's mesh, in the node's own space: EXT_mesh_gpu_instancing. Immutable once shared; 48 bytes each.
struct Instances {
    uint64_t serial = next_payload_serial();
    std::vector<Affine> node_from_copy; // finite
};
using InstancesPtr = std::shared_ptr<const Instances>;

// Node-local transform. Applied scale, then rotation, then translation. A matrix that no such triple
// reproduces (shear) is kept in `matrix`, which then wins until the user edits the node.
struct Transform {
    Vec3 translation{0, 0, 0};
    Quat rotation;
    Vec3 scale{1, 1, 1};
    std::optional<Affine> matrix;
    bool operator==(const Transform&) const = default;
};

struct Node {
    std::string name;
    Id<Node> parent; // none: a root
    Transform local;
    Id<Mesh> mesh;
    InstancesPtr instances; // none: the mesh is there once, where the node is
    Id<Light> light;
    Id<Camera> camera;
    bool visible = true; // false hides the node and all below it, light included
    Id<Skin> skin;       // what the mesh hangs on
    std::vector<float> morph_weights;    // of the mesh's targets; those that are missing are 0
    std::vector<int32_t> only_in_scenes; // of a root: indices into Scene::scene_names; empty: all
    bool shadow_catcher = false; // of the camera's rays, all meshes here and below catch shadows alone (render/shadow_catcher.h)
    bool operator==(const Node&) const = default;
};

// The sun's place and the air, for a sky of a published model.
struct Sky {
    float turbidity = 3;          // 2 clear .. 10 hazy
    float ground_albedo = 0.3f;
    bool sun_disk = true;
    bool by_place_and_time = false; // else by the two angles
    float elevation_degrees = 35; // of the sun above the horizon
    float azimuth_degrees = 135;  // clockwise from north, which is -Z; east is +X
    float latitude_degrees = 52, longitude_degrees = 5; // north, east
    int32_t year = 2026, month = 6, day = 21;
    float utc_hours = 10;
    bool operator==(const Sky&) const = default;
};

struct Environment {
    enum class Kind : uint8_t { none, constant, image, sky };
    Kind kind = Kind::none;
    Vec3 color{1, 1, 1};        // constant: radiance in nits; image, sky: tint
    float intensity = 1;        // multiplies both
    float rotation_degrees = 0; // about +Y
    std::string file;           // image: where it came from
    ImagePtr image;             // lat-long, float, 3 or 4 channels; the centre column looks along -Z
    Sky sky;
    bool visible_to_camera = true;
    bool lights_scene = true;   // false: a backdrop, seen by the camera alone
    bool solo = false;          // as a light's
    std::string group;          // of the light mix, where groups are made by hand
    bool operator==(const Environment&) const = default;
};

// Where the picture is taken from. Starts as a copy of one of the scene's cameras, then is navigated freely.
struct View {
    Vec3 position{0, 0, 5};
    Quat rotation;
    float pivot_distance = 5; // metres in front of the eye: what orbiting turns about
    Lens lens;
    bool operator==(const View&) const = default;
};

// A group of lights as the light mix scales it.
struct MixChannel {
    std::string group;
    bool enabled = true;
    float intensity = 1;
    Vec3 color{1, 1, 1};
    bool use_temperature = false;
    float kelvin = 6500;
    bool operator==(const MixChannel&) const = default;
};
// The light mix: which lights share a plane of the film, and what those planes are multiplied with. Groups without a channel stay as they are.
struct LightMix {
    enum class Grouping : uint8_t { none, by_light, by_object, by_material, by_hand };
    Grouping grouping = Grouping::none;
    std::vector<MixChannel> channels;
    bool operator==(const LightMix&) const = default;
};

struct Scene {
    Table<Node> nodes;
    Table<Mesh> meshes;
    Table<Material> materials;
    Table<Texture> textures;
    Table<Light> lights;
    Table<Camera> cameras;
    Table<Skin> skins;
    Table<Clip> clips;
    std::vector<std::string> scene_names; // of a file with several; empty: there is nothing to choose
    std::vector<std::string> variants;
    Staging staging;
    Environment environment;
    LightMix mix;
    View view;
    bool operator==(const Scene&) const = default;
};

// --- read-only questions about a scene --------------------------------------------------------------------

// Local transform as a matrix.
Affined to_affine(const Transform& transform);
// Best TRS for a matrix; keeps the matrix when no TRS reproduces it to 1e-5 relative.
Transform to_transform(const Affined& matrix);
// Product of the node's and its ancestors' transforms, as the chosen clip has them, composed in double. A parent cycle, which no import
// or edit lets in, ends at the table's size.
Affined world_from_node(const Scene& scene, Id<Node> node);
// The node and all its ancestors are visible, and are of the chosen scene.
bool is_visible(const Scene& scene, Id<Node> node);
// The node or an ancestor is a shadow catcher.
bool is_shadow_catcher(const Scene& scene, Id<Node> node);
// View that looks through a camera node.
View view_through(const Scene& scene, Id<Node> camera_node);

// The same but for what orbiting turns about: no geometry is looked at.
View eye_of(const Scene& scene, Id<Node> camera_node);

struct Bounds {
    Vec3d low{0, 0, 0}, high{0, 0, 0};
    bool empty = true;
    void include(const Vec3d& p);
    // The corners of a box that lies somewhere.
    void include(const Bounds& box, const Affined& world_from_box);
    Vec3d center() const;
    double radius() const; // of the sphere around centre
};
// World bounds of one node's own mesh (not its children), or of all visible geometry; of copies, of the boxes around their boxes.
Bounds world_bounds(const Scene& scene, Id<Node> node);
Bounds world_bounds(const Scene& scene);
// The view from `view`'s direction that shows the whole of `bounds` at the given aspect (width / height).
View framed(const View& view, const Bounds& bounds, float aspect);

} // namespace blush
