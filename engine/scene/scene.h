// The scene as the user edits and saves it: plain values, independent of rendering.
//
// Units: metres, radians where a name ends in _radians, degrees where it ends in _degrees. Working space:
// scene-linear Rec.709 primaries. Photometric units as in glTF: candela, lux, nits.
// Heavy payloads (Geometry, Image) are immutable behind shared_ptr<const T> and carry a serial number given at
// creation; two payloads are the same data if and only if their serials are equal.
#pragma once

#include "core/geometry_array.h"
#include "core/vec.h"
#include "scene/animation/animation.h"
#include "scene/cow.h"

#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace blush {

// A new serial number for a payload; never 0, never repeated in this process. Thread-safe.
uint64_t next_payload_serial();

// Marks tangents that were generated (scene/geometry/tangents.h) rather than loaded, with the data that removes them again.
struct GeneratedTangents {
    int uv_set = -1;              // UV set they were computed from
    std::vector<uint32_t> copies; // source vertex of each vertex that was added for them at the end of the arrays
};

// Triangles of one material. Immutable once shared. Optional arrays are empty or have positions.size() entries.
struct Geometry {
    uint64_t serial = next_payload_serial();
    std::shared_ptr<const void> storage; // keeps memory alive that arrays lie in; null: all are on the heap
    GeometryArray<Vec3> positions;
    GeometryArray<Vec3> normals;
    GeometryArray<Vec4> tangents;                        // xyz and the handedness w = +-1, as in glTF
    std::optional<GeneratedTangents> generated_tangents; // if the tangents were generated
    std::vector<GeometryArray<Vec2>> uv;                 // uv[i] is TEXCOORD_i; (0, 0) is the top left corner of the image, as in glTF
    GeometryArray<Vec4> colors;                          // linear RGBA, multiplies the base colour
    GeometryArray<uint32_t> indices;                     // 3 per triangle, all < positions.size()
    bool flat = false;                                   // face normals: recomputed when the mesh is deformed
    std::vector<MorphTargetPtr> targets;
    std::vector<Influence> influences; // empty, or the same number for each vertex, weights sum to 1

    size_t triangle_count() const { return indices.size() / 3; }
    bool has_uv_set(int set) const { return size_t(set) < uv.size() && !uv[size_t(set)].empty(); }
};

// Decoded pixels, top row first. Immutable once shared.
struct Image {
    uint64_t serial = next_payload_serial();
    int width = 0, height = 0, channels = 0; // channels 1..4
    std::vector<uint8_t> bytes;              // width * height * channels, or empty
    std::vector<float> floats;               // the same in float; exactly one of the two is not empty
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

// Largest index of a UV set.
constexpr int max_uv_set = 255;

// A material's reference to a texture, with its UV set and KHR_texture_transform.
struct TextureRef {
    Id<Texture> texture;
    uint8_t uv_set = 0; // 0 .. max_uv_set
    Vec2 offset{0, 0}, scale{1, 1};
    float rotation_radians = 0; // counter-clockwise, as in KHR_texture_transform
    bool operator==(const TextureRef&) const = default;
};

// glTF 2.0 metallic-roughness (Appendix B) with the extensions named beside the fields.
struct Material {
    enum class Alpha : uint8_t { opaque, mask, blend };
    std::string name;
    Vec3 base_color{1, 1, 1}; // linear reflectance
    float opacity = 1;        // baseColorFactor.a
    float metallic = 1, roughness = 1;
    Vec3 emissive{0, 0, 0};      // emissiveFactor
    float emissive_strength = 1; // KHR_materials_emissive_strength; emissive * strength is in nits
    bool emits = true;           // false: emission is muted
    bool solo = false;           // solo of the emission, as of a light
    float normal_scale = 1;
    Alpha alpha = Alpha::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false; // KHR_materials_unlit
    float ior = 1.5f;   // KHR_materials_ior
    float specular = 1; // KHR_materials_specular: factor and colour; 0 is a pure Lambertian
    Vec3 specular_color{1, 1, 1};
    float transmission = 0; // KHR_materials_transmission
    float thickness = 0;    // KHR_materials_volume: 0 is thin-walled, more is solid (the value is not used otherwise)
    Vec3 attenuation_color{1, 1, 1};
    float attenuation_distance = 0;        // metres; 0 means no absorption (glTF's default of infinity)
    TextureRef base_color_texture;         // sRGB; alpha is opacity
    TextureRef metallic_roughness_texture; // linear: G roughness, B metallic
    TextureRef normal_texture;             // linear, tangent space
    TextureRef emissive_texture;           // sRGB
    TextureRef specular_texture;           // linear: A
    TextureRef specular_color_texture;     // sRGB
    TextureRef transmission_texture;       // linear: R
    float clearcoat = 0;                   // KHR_materials_clearcoat: a colourless dielectric layer of index 1.5 on top
    float clearcoat_roughness = 0;
    float clearcoat_normal_scale = 1;
    TextureRef clearcoat_texture;           // linear: R
    TextureRef clearcoat_roughness_texture; // linear: G
    TextureRef clearcoat_normal_texture;    // linear, tangent space; the coat does not use normal_texture
    Vec3 sheen_color{0, 0, 0};              // KHR_materials_sheen: reflectance of a fibre layer below the coat
    float sheen_roughness = 0;
    TextureRef sheen_color_texture;        // sRGB
    TextureRef sheen_roughness_texture;    // linear: A
    float anisotropy = 0;                  // KHR_materials_anisotropy: stretches reflections along a tangent direction
    float anisotropy_rotation_radians = 0; // of that direction, counter-clockwise from the tangent
    TextureRef anisotropy_texture;         // linear: RG direction as of a normal map, B strength
    float iridescence = 0;                 // KHR_materials_iridescence: a thin film on the surface
    float iridescence_ior = 1.3f;
    float iridescence_thickness_minimum = 100, iridescence_thickness_maximum = 400; // nanometres; maximum without a texture
    TextureRef iridescence_texture;                                                 // linear: R
    TextureRef iridescence_thickness_texture;                                       // linear: G, from minimum to maximum
    float dispersion = 0;                                                           // KHR_materials_dispersion: 20 / Abbe number, of solids
    float diffuse_transmission = 0; // KHR_materials_diffuse_transmission: fraction of the diffuse part that is transmitted
    Vec3 diffuse_transmission_color{1, 1, 1};
    TextureRef diffuse_transmission_texture;       // linear: A
    TextureRef diffuse_transmission_color_texture; // sRGB
    bool operator==(const Material&) const = default;
};

// A mesh is a list of parts (glTF primitives); nodes that share a mesh are instances of it.
struct MeshPart {
    GeometryPtr geometry;
    Id<Material> material;                     // none: glTF's default material
    std::vector<Id<Material>> by_variant = {}; // [0] default, then one per variant (none: the default); empty: no variants
    bool operator==(const MeshPart&) const = default;
};
struct Mesh {
    std::string name;
    std::vector<MeshPart> parts;
    std::vector<std::string> target_names = {}; // of morph targets; may be shorter
    bool operator==(const Mesh&) const = default;
};

// Measured luminous intensity distribution of a luminaire (ANSI/IES LM-63); immutable once shared. See scene/lights/ies_profile.h.
struct IesProfile;
using IesPtr = std::shared_ptr<const IesProfile>;

struct Node;

// Set of objects: those listed, or all except those listed. A node includes its descendants.
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
    Unit unit = Unit::own;        // unit shown in the window; the stored intensity is as above
    bool keep_power = false;      // rectangle, disk, sphere: resizing in the window keeps the luminous flux rather than the nits
    float radius = 0;             // metres. point, spot: 0 is a point, else a sphere of the same intensity; disk, sphere: theirs
    float angle_radians = 0;      // sun: full angle it subtends; 0 is a perfectly parallel beam (the real sun: 0.00925)
    float inner_cone_radians = 0; // spot: half angles, KHR_lights_punctual
    float outer_cone_radians = std::numbers::pi_v<float> / 4;
    float width = 1, height = 1;                      // rectangle: metres, before the node's scale
    bool two_sided = false;                           // rectangle, disk
    float spread_radians = std::numbers::pi_v<float>; // rectangle, disk: full angle of the cone of emission; pi is the half space
    bool visible_to_camera = true;                    // of lights with a size: visible to camera rays; reflections always show them
    IesPtr ies;                                       // point, spot: scales the intensity by direction
    std::string ies_file;                             // path of the profile
    bool enabled = true;                              // false is muted
    bool solo = false;                                // while any light is solo, only solo lights emit; muted lights never do
    std::string group;                                // light group, if groups are assigned by hand
    ObjectSet lit_objects;                            // light linking: objects that it lights
    ObjectSet shadow_casters;                         // light linking: objects that cast its shadows
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

// Transforms of the instances of a node's mesh, in the node's space (EXT_mesh_gpu_instancing). Immutable once shared; 48 bytes
// each.
struct Instances {
    uint64_t serial = next_payload_serial();
    std::vector<Affine> node_from_copy; // finite
};
using InstancesPtr = std::shared_ptr<const Instances>;

// Node-local transform: scale, then rotation, then translation. A matrix that has no such decomposition (shear) is kept in
// `matrix`, which takes precedence until the user edits the node.
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
    InstancesPtr instances; // none: a single instance at the node
    Id<Light> light;
    Id<Camera> camera;
    bool visible = true;                 // false hides the node and its descendants, lights included
    Id<Skin> skin;                       // that deforms the mesh
    std::vector<float> morph_weights;    // of the mesh's targets; missing ones are 0
    std::vector<int32_t> only_in_scenes; // of a root: indices into Scene::scene_names; empty: all
    bool shadow_catcher = false;         // all meshes of this subtree are shadow catchers (render/film/shadow_catcher.h)
    bool operator==(const Node&) const = default;
};

// Parameters of the physical sky: sun position and atmosphere (scene/lights/sky_model.h).
struct Sky {
    float turbidity = 3; // 2 clear .. 10 hazy
    float ground_albedo = 0.3f;
    bool sun_disk = true;
    bool by_place_and_time = false;                     // sun position from place and time; else from the two angles
    float elevation_degrees = 35;                       // of the sun above the horizon
    float azimuth_degrees = 135;                        // clockwise from north, which is -Z; east is +X
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
    std::string file;           // image: its path
    ImagePtr image;             // lat-long, float, 3 or 4 channels; the centre column looks along -Z
    Sky sky;
    bool visible_to_camera = true;
    bool lights_scene = true; // false: visible to the camera only, a backdrop
    bool solo = false;        // as of a light
    std::string group;        // light group, if groups are assigned by hand
    bool operator==(const Environment&) const = default;
};

// The viewport camera. Starts as a copy of a scene camera, then is navigated freely.
struct View {
    Vec3 position{0, 0, 5};
    Quat rotation;
    float pivot_distance = 5; // metres in front of the camera: centre of orbiting
    Lens lens;
    bool operator==(const View&) const = default;
};

// Gain of a light group in the light mix.
struct MixChannel {
    std::string group;
    bool enabled = true;
    float intensity = 1;
    Vec3 color{1, 1, 1};
    bool use_temperature = false;
    float kelvin = 6500;
    bool operator==(const MixChannel&) const = default;
};
// The light mix: how lights are grouped, and the gains of the groups. Each group has a plane of the film. Groups without a
// channel have gain 1.
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
    std::vector<std::string> scene_names; // of a file with several scenes; else empty
    std::vector<std::string> variants;
    SceneSelection scene_selection;
    Environment environment;
    LightMix mix;
    View view;
    bool operator==(const Scene&) const = default;
};

// --- queries of a scene --------------- --------------------------------------------------------------------

// Local transform as a matrix.
Affined to_affine(const Transform& transform);
// Nearest translation, rotation and scale of a matrix; keeps the matrix if they do not reproduce it to 1e-5 relative.
Transform to_transform(const Affined& matrix);
// World transform of a node at the current time of the chosen clip, composed in double. Terminates on a parent cycle, which
// imports and edits reject.
Affined world_from_node(const Scene& scene, Id<Node> node);
// The space that node.local is in: that of its parent, or the world.
Affined world_from_parent(const Scene& scene, const Node& node);
// True if the node and all its ancestors are visible and belong to the chosen scene.
bool is_visible(const Scene& scene, Id<Node> node);
// True if the node or an ancestor is a shadow catcher.
bool is_shadow_catcher(const Scene& scene, Id<Node> node);
// View through a camera node. The pivot is the point on the view axis nearest to the centre of the scene.
View view_through(const Scene& scene, Id<Node> camera_node);

// The same with the default pivot distance: faster, since it needs no bounds.
View view_of_camera(const Scene& scene, Id<Node> camera_node);

struct Bounds {
    Vec3d low{0, 0, 0}, high{0, 0, 0};
    bool empty = true;
    void include(const Vec3d& p);
    // Includes the corners of a transformed box.
    void include(const Bounds& box, const Affined& world_from_box);
    Vec3d center() const;
    double radius() const; // of the bounding sphere about center()
};
// World bounds of one node's mesh (without its children), or of all visible geometry. Instances contribute their transformed
// bounding boxes.
Bounds world_bounds(const Scene& scene, Id<Node> node);
Bounds world_bounds(const Scene& scene);
// A view in the direction of `view` that shows all of `bounds` at the given aspect (width / height).
View framed(const View& view, const Bounds& bounds, float aspect);

} // namespace blush
