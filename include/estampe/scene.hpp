// SPDX-License-Identifier: MIT
#pragma once

// A 3D scene as data: meshes, materials, nodes, lights, cameras and animations. No GPU type appears here.
// Conventions are glTF's: right-handed, y up, metres, radians, column vectors, linear colour, seconds.

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <estampe/cloth.hpp>
#include <estampe/image.hpp>
#include <estampe/terrain.hpp>

namespace estampe {

/// Index into one of the scene's arrays; `no_index` means "none".
using Index = uint32_t;
/// No such thing.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

/// Sixteen groups, a bit each, tie lights to objects: a light lights what shares a group with it, and is
/// blocked by what throws shadows for one of its groups.
using Groups = uint16_t;
/// What lights and objects are in unless told otherwise.
inline constexpr Groups all_groups = 0xffff;

/// How a surface stands to the lights. A node's and its material's hold together: groups that both name,
/// shadows that both receive.
struct LightLinks {
    Groups lit_by = all_groups;    ///< lights of these groups; ambient light comes anyway
    Groups casts_for = all_groups; ///< throws shadows in the light of these; 0: throws none
    bool receives_shadows = true;

    bool operator==(const LightLinks& other) const = default;
};

/// How a texture goes on beyond its edges.
enum class Wrap : uint8_t { repeat, clamp, mirror };

/// A picture that materials look up.
struct Texture {
    std::string name;
    Image
        image; ///< never empty after a load: a missing texture is replaced by one white pixel, with a warning
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
};

/// How a material looks a texture up: which one, which UV set, and uv' = transform * (u, v, 1).
struct TextureRef {
    Index texture = no_index;
    uint32_t uv_set = 0; ///< 0 or 1
    glm::mat3 uv_transform{1.0F};
};

/// What alpha does: nothing; holes where it is below Material::alpha_cutoff; glass.
enum class AlphaMode : uint8_t { opaque, mask, blend };

/// What VRMC_materials_mtoon adds: a second colour for shade, and an outline of its own.
struct ToonShade {
    glm::vec3 shade_color{1.0F};
    TextureRef shade_texture;
    float outline_width_m = 0.0F;
    glm::vec3 outline_color{0.0F};
};

/// What is seen through a body: KHR_materials_transmission, and KHR_materials_volume.
struct Transmission {
    float share = 0.0F;         ///< of what lies behind, 0 to 1
    float thickness_m = 0.0F;   ///< where the body has no far side
    float attenuation_m = 0.0F; ///< way through it that leaves the colour of white light; 0: it takes nothing
    glm::vec3 attenuation_color{1.0F}; ///< linear
};

/// What a surface is made of, as in glTF 2.0: factors multiply what is looked up.
struct Material {
    std::string name;
    glm::vec4 base_color{1.0F}; ///< linear, alpha straight
    TextureRef base_color_texture;
    TextureRef normal_texture;
    float normal_scale = 1.0F;
    TextureRef occlusion_texture;
    float occlusion_strength = 1.0F;
    glm::vec3 emissive{0.0F}; ///< linear, KHR_materials_emissive_strength multiplied in
    TextureRef emissive_texture;
    float metallic = 1.0F;
    float roughness = 1.0F;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    /// Of a blended material: parts of its surfaces are wholly clear, so that they do not end where their
    /// edges are and get no lines there. load_scene() finds out.
    bool has_clear_parts = false;
    bool double_sided = false;
    bool unlit = false;
    std::optional<ToonShade> toon;
    std::optional<Transmission> transmission; ///< where anything is seen through it
    LightLinks links;
    std::optional<Cloth> cloth; ///< what is made of it moves as cloth
};

/// What a primitive is a list of.
enum class Topology : uint8_t { points, lines, triangles };

/// One shape that a primitive can be bent towards: what is added to it, times the target's weight.
struct MorphTarget {
    std::vector<glm::vec3> position_offsets; ///< empty, or one per vertex
    std::vector<glm::vec3> normal_offsets;   ///< empty, or one per vertex
};

/// One drawable piece of a mesh. Every array is empty or has one entry per vertex; strips, fans and loops
/// have been turned into plain lists. Triangles always have normals after a load.
struct Primitive {
    Topology topology = Topology::triangles;
    Index material = 0;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4>
        tangents; ///< xyz, and the sign of the bitangent in w; computed when a normal map needs them
    std::array<std::vector<glm::vec2>, 2> uvs;
    std::vector<glm::vec4> colors;
    std::vector<glm::u16vec4> joints_0, joints_1; ///< up to eight influences
    std::vector<glm::vec4> weights_0, weights_1;  ///< sum to one over both sets
    std::vector<uint32_t> indices;                ///< 3 a triangle, 2 a line, 1 a point
    std::vector<uint8_t> edge_marks; ///< empty, or one a triangle: bit k marks the edge from corner k to the
                                     ///< next, as EXT_mesh_primitive_edge_visibility does
    std::vector<MorphTarget> morph_targets;
    std::vector<float> held; ///< of cloth, how much each vertex is held where its node, skin or morph targets
                             ///< put it: 0 free, 1 wholly; empty: all are free
    std::vector<Index> variant_materials; ///< KHR_materials_variants: empty, or the material for each entry
                                          ///< of Scene::variants; `no_index` keeps the default material
    Index default_material = no_index;    ///< set by apply_variant(): what `material` is without a variant
};

/// A thing to be drawn, in its node's space; any number of nodes may show the same one.
struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> morph_weights; ///< defaults, one per target
};

/// Where a node stands in its parent's space: scaled, then turned, then moved. In metres.
struct Transform {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    [[nodiscard]] glm::dmat4 matrix() const;
};

/// A place in the scene, and what is there: a mesh, a camera, a light, or only other nodes.
struct Node {
    std::string name;
    Index parent = no_index;
    std::vector<Index> children;
    bool visible = true; ///< KHR_node_visibility: false hides the meshes and lights of the node and of all
                         ///< nodes below it; cameras still work
    Transform transform;
    std::optional<glm::dmat4> matrix; ///< replaces `transform` where the file gives one; never animated
    Index mesh = no_index;
    Index skin = no_index;
    Index camera = no_index;
    Index light = no_index;
    LightLinks links;
    std::optional<Cloth> cloth; ///< its mesh moves as cloth
    ClothCollider collider = ClothCollider::none;
    std::vector<float> morph_weights; ///< empty: the mesh's own
    std::vector<glm::mat4>
        instances; ///< EXT_mesh_gpu_instancing: node_from_instance; empty means one, identity
};

/// The joints that bend a primitive: its `joints_0` and `joints_1` count in this list.
struct Skin {
    std::string name;
    std::vector<Index> joints;              ///< nodes
    std::vector<glm::mat4> joint_from_bind; ///< inverse bind matrices, one per joint
};

/// Ambient light comes from everywhere and needs no place.
enum class LightType : uint8_t { directional, point, spot, ambient };

/// How a local light weakens with the distance d: 1 / d^2, or 1 - (d / range)^2 inside a volume of that
/// radius, as if the light's volume were scaled to the unit sphere (Zanuttini, "Recherches en rendu non
/// réaliste temps réel", Université Paris 8, 2008, chapter 4).
enum class LightFalloff : uint8_t { inverse_square, unit_volume };

/// What a spot lights: a cone, or a pyramid over a square, upright along its node's y.
enum class SpotShape : uint8_t { cone, pyramid };

/// KHR_lights_punctual: shines along its node's -z. Intensity in lux (directional, ambient) or candela
/// (point, spot; with the fall-off of a unit volume, lux at the light).
struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 color{1.0F};
    float intensity = 1.0F;
    float range_m = 0.0F; ///< 0: unlimited
    float inner_cone_rad = 0.0F;
    float outer_cone_rad = 0.7853982F; ///< of a pyramid: half the angle between opposite sides
    LightFalloff falloff = LightFalloff::inverse_square;
    SpotShape shape = SpotShape::cone;
    std::optional<float> radius_m; ///< of a lamp or spot, the ball that glows: how wide its penumbrae are, 0
                                   ///< for none; not given: `shadow.lamp_radius_m` of the style
    Groups groups = all_groups;    ///< lights what is `lit_by` one of them
    Groups casters = all_groups;   ///< blocked by what `casts_for` one of them; 0: its light throws no shadow

    bool operator==(const Light& other) const = default;
};

/// A camera of the file. Looks along its node's -z.
struct SceneCamera {
    std::string name;
    bool orthographic = false;
    double vertical_fov_rad = 0.8;
    double half_height_m = 1.0; ///< orthographic only
    double near_m = 0.01;
};

/// How a value goes from key to key.
enum class Interpolation : uint8_t { step, linear, cubic_spline };
/// Which property of a node a channel animates; `weights` are those of its morph targets.
enum class AnimatedPath : uint8_t { translation, rotation, scale, weights };

/// What one property of one node goes through, key by key.
struct AnimationChannel {
    Index node = no_index;
    AnimatedPath path = AnimatedPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times_s; ///< ascending
    std::vector<float>
        values; ///< 3, 4 (x, y, z, w) or target-count floats a key; three times that for cubic splines
};

/// Channels that play together, from 0 s on.
struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration_s = 0.0F; ///< time of the last key
    float start_s = 0.0F; ///< where the file's own time range begins: its first frame is drawn at this time
};

/// All that a file holds, in lists that refer to each other by index. It can be made by hand as well: the
/// defaults of all members are those of glTF.
struct Scene {
    std::string name;
    std::vector<Texture> textures;
    std::vector<Material> materials; ///< at least one
    std::vector<Mesh> meshes;
    std::vector<Node> nodes; ///< a forest: parents and children agree, and there is no cycle
    std::vector<Index> roots;
    std::vector<Skin> skins;
    std::vector<Light> lights;
    std::vector<SceneCamera> cameras;
    std::vector<Animation> animations;
    std::optional<double> frames_per_s; ///< frame rate that the file was made for, if the file says one
    std::vector<std::string> variants;  ///< names of the material variants, see apply_variant()
    std::optional<Terrain>
        terrain; ///< ground without an end; drawn as an object and a material named "terrain"
    std::vector<std::string> extensions_used;
    std::vector<std::string> extensions_ignored;
    std::vector<std::string> missing_files; ///< what the file names and could not be opened: pictures
    std::optional<double>
        file_unit_m; ///< metres per unit of the file, if the file says so; the scene is in metres
    std::vector<std::string> warnings; ///< what was repaired on the way in, one line each
};

/// What a primitive of a node is made of if it is cloth, else null; the node's own goes before its
/// material's.
[[nodiscard]] const Cloth* cloth_of(const Scene& scene, const Node& node, const Primitive& primitive);

/// A rectangle of cloth, as a regular grid of so many vertices a side: `along` and `down` are its sides, and
/// its front is where they turn from one to the other clockwise. UVs are metres on it. At least 3 x 3.
[[nodiscard]] Primitive cloth_sheet(uint32_t columns, uint32_t rows, const glm::vec3& corner_m,
                                    const glm::vec3& along_m, const glm::vec3& down_m);

/// Gives every primitive the material that it has in the variant of that name, or of that index if no variant
/// has the name. An empty name restores the default materials. A renderer shows the change after
/// Renderer::set_scene(). Throws Error listing the variants when there is no such one. Cost: linear in
/// primitives.
void apply_variant(Scene& scene, const std::string& variant);

/// The axis of a file's coordinates that points up. A scene in memory is always y up.
enum class UpAxis : uint8_t { x, y, z, minus_x, minus_y, minus_z };

/// How load_scene() reads a file. The defaults read the file as it is.
struct LoadOptions {
    std::string variant; ///< the material variant to draw, by name or index; empty: the default materials
    std::optional<UpAxis> up; ///< the axis of the file's coordinates that points up: the scene is turned so
                              ///< that it becomes +y; none: what the file or its format says, else y. FBX and
                              ///< COLLADA are turned by the axis that they name before this

    bool operator==(const LoadOptions& other) const = default;
};

/// Reads a scene: .gltf and .glb, and .obj .ply .stl .fbx .dae.
///
/// Throws Error naming file and place (a JSON pointer or a byte offset) when the file is broken beyond
/// repair; what can be repaired is, and is listed in `Scene::warnings`. Never allocates more than a small
/// multiple of the file's size.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// The scene at a moment: every node's place, and every node's morph weights.
struct ScenePose {
    std::vector<glm::dmat4> world_from_node;
    std::vector<std::vector<float>> morph_weights; ///< per node; empty without morph targets
};

/// Evaluates the hierarchy at `time_s` of animation `animation` (looping; no_index, or no animation: the rest
/// pose). Cost: linear in nodes and channels.
[[nodiscard]] ScenePose pose_scene(const Scene& scene, double time_s, Index animation = 0);

/// A box along the axes; empty until it is extended.
struct Bounds {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    void extend(const glm::dvec3& point)
    {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }

    [[nodiscard]] bool empty() const { return !(min.x <= max.x); }

    [[nodiscard]] glm::dvec3 center() const { return 0.5 * (min + max); }

    [[nodiscard]] double radius() const { return empty() ? 0.0 : 0.5 * glm::length(max - min); }
};

/// World bounds of all vertices in `pose`, skinned and morphed (exactly, on the CPU). Cost: linear in
/// vertices.
[[nodiscard]] Bounds scene_bounds(const Scene& scene, const ScenePose& pose);

/// Where the picture is taken from, in world space.
struct Camera {
    glm::dvec3 eye{0.0, 0.0, 5.0};
    glm::dvec3 target{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double vertical_fov_rad = 0.6;
    std::optional<double> orthographic_half_height_m; ///< set: parallel projection
    double near_m = 0.01;
};

/// The camera of the file named `name`, placed by `pose`; a number picks by index. Throws Error listing the
/// names there are.
[[nodiscard]] Camera scene_camera(const Scene& scene, const ScenePose& pose, const std::string& name);

/// Where the sun stands of a style: whoever frames a picture leaves room for the shadow that it throws.
struct SunBearing {
    double azimuth_deg = -34.0; ///< 0 is +z, 90 +x, for an eye at 35 degrees
    double elevation_deg = 45.0;
    bool turns = true;                   ///< with the side that the framed view shows
    bool rules = false;                  ///< in place of the scene's own light
    bool throws = true;                  ///< whether the shadow is drawn, and so wants room
    std::optional<bool> on_blank_ground; ///< whether a blank ground below the scene takes the shadow, so that
                                         ///< it is seen without a floor; none: unless the scene has a camera
};

/// Frames the scene as a person would: three-quarter view from slightly above, whole, with a margin, from the
/// side with most to draw (the front, +z, unless another shows clearly more), with room for the shadow on the
/// ground that the scene's strongest directional light throws, or else `sun`. A floor much wider than what
/// stands on it is let run out of the page. A room is seen through its open side, or through the wall that
/// faces the eye; a closed house from a corner inside. `aspect` is width / height. Throws Error when the
/// scene is so large, small or far away that it cannot be drawn. Cost: linear in vertices and triangles,
/// about 0.1 s for half a million.
[[nodiscard]] Camera framing_camera(const Scene& scene, const ScenePose& pose, double aspect,
                                    const SunBearing& sun = {});

/// Reads "eye=x,y,z target=x,y,z [fov=degrees] [up=x,y,z] [ortho] [ortho=half_height]", in any order,
/// separated by blanks. `fov` is vertical, 1 to 170. `ortho` makes a parallel projection: half its height in
/// metres, or without a number as high as the view is at the target. Throws Error that names the wrong part
/// and shows an example of the right form.
[[nodiscard]] Camera parse_camera(const std::string& text);

} // namespace estampe
