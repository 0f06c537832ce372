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
#include <estampe/read_scope.hpp>
#include <estampe/terrain.hpp>
#include <estampe/work_limits.hpp>

namespace estampe {

/// Index into one of the scene's arrays; `no_index` means none.
using Index = uint32_t;
/// Index that refers to nothing.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

/// Sixteen light groups, one bit each. A light affects the objects that share a group with the light. The
/// light is blocked by the objects that cast shadows for one of the light's groups.
using Groups = uint16_t;
/// Default groups of lights and objects.
inline constexpr Groups all_groups = 0xffff;

/// How an object interacts with lights. The links of a node and of its material are combined. The object has
/// only the groups that node and material have in common, and receives shadows only if node and material both
/// receive shadows.
struct LightLinks {
    /// Groups of the lights that light the object; ambient light always lights it.
    Groups lit_by = all_groups;
    /// Groups of the lights for which the object casts shadows; 0: the object casts no shadow.
    Groups casts_for = all_groups;
    bool receives_shadows = true;

    bool operator==(const LightLinks& other) const = default;
};

/// How a texture continues beyond its edges.
enum class Wrap : uint8_t { repeat, clamp, mirror };

/// An image that materials sample.
struct Texture {
    std::string name;
    /// Pixels of the texture. Never empty after a load: a missing image is replaced by one white pixel, with
    /// a warning.
    Image image;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
};

/// Reference of a material to a texture, with UV set and transform. The texture is sampled at
/// `transform * (u, v, 1)`, where u and v are the texture coordinates.
struct TextureRef {
    Index texture = no_index; ///< Index of the texture; no_index: the reference is empty
    uint32_t uv_set = 0;      ///< Set of texture coordinates: 0 or 1
    glm::mat3 uv_transform{1.0F};
};

/// How a material uses alpha. opaque: alpha is ignored; mask: parts below Material::alpha_cutoff are cut out;
/// blend: the surface is blended like glass.
enum class AlphaMode : uint8_t { opaque, mask, blend };

/// Toon shading of a material, as in VRMC_materials_mtoon: a colour for shaded parts, and an outline with its
/// own width and colour. With a shade texture, the surface has the colour `shade_color * shade_texture` in
/// the shade. Without a shade texture, the surface has its lit colour times `shade_color` there.
struct ToonShade {
    glm::vec3 shade_color{1.0F}; ///< Colour of the shaded parts, linear
    TextureRef shade_texture;
    /// Added to the cosine of the angle between normal and light: more lights a larger part of the surface.
    float shade_shift = 0.0F;
    /// Hardness of the step between light and shade: at 1 the colours change at once. The step goes from
    /// `shade_toony - 1` to `1 - shade_toony` of the shifted cosine.
    float shade_toony = 0.9F;
    float outline_width_m = 0.0F;  ///< Width of the outline; 0: the style decides
    glm::vec3 outline_color{0.0F}; ///< Colour of the outline, linear
};

/// Light that passes through an object: KHR_materials_transmission, KHR_materials_volume and
/// KHR_materials_ior.
struct Transmission {
    float share = 0.0F;       ///< Share of the light behind the object that passes, 0 to 1
    float thickness_m = 0.0F; ///< Thickness where the object has no back side
    /// Distance inside the object after which white light has the colour `attenuation_color`; 0: no
    /// attenuation.
    float attenuation_m = 0.0F;
    /// Colour that white light has after the distance `attenuation_m` in the object, linear.
    glm::vec3 attenuation_color{1.0F};
    /// Index of refraction of the object's inside; at 1, light passes straight. A file without a thickness
    /// describes a sheet without volume, which does not refract.
    float ior = 1.0F;
};

/// A surface material as in glTF 2.0: factors are multiplied by the texture values.
struct Material {
    std::string name;
    glm::vec4 base_color{1.0F}; ///< Base colour, linear, with straight alpha
    TextureRef base_color_texture;
    TextureRef normal_texture;
    float normal_scale = 1.0F;
    TextureRef occlusion_texture;
    float occlusion_strength = 1.0F;
    glm::vec3 emissive{0.0F}; ///< Emitted light, linear, multiplied by KHR_materials_emissive_strength
    TextureRef emissive_texture;
    float metallic = 1.0F;
    float roughness = 1.0F;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    /// Parts of a blended material are fully transparent. The visible shape then differs from the mesh, so
    /// the mesh's edges get no lines. load_scene() sets this value.
    bool has_clear_parts = false;
    /// Alpha cuts out a good part of the material's surfaces, as of leaves. Lines may then run around clumps
    /// of leaves (style key contour.clump_mm). load_scene() sets this value.
    bool is_foliage = false;
    bool double_sided = false;
    bool unlit = false;
    std::optional<ToonShade> toon;
    std::optional<Transmission> transmission; ///< Set if the material transmits light
    LightLinks links;
    std::optional<Cloth> cloth; ///< If set, objects of this material move as cloth
};

/// Kind of the elements that a primitive lists.
enum class Topology : uint8_t { points, lines, triangles };

/// Morph target: offsets of a primitive's vertices, which are added after they are multiplied by the target's
/// weight.
struct MorphTarget {
    std::vector<glm::vec3> position_offsets; ///< Offset of each vertex position; empty, or one per vertex
    std::vector<glm::vec3> normal_offsets;   ///< Offset of each vertex normal; empty, or one per vertex
};

/// Drawable part of a mesh. Each vertex array is empty or has one entry per vertex. Strips, fans and loops
/// are converted to plain lists. After a load, triangles always have normals.
struct Primitive {
    Topology topology = Topology::triangles;
    Index material = 0;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    /// Tangent per vertex: direction in xyz, and the sign of the bitangent in w. Computed if a normal map
    /// requires tangents.
    std::vector<glm::vec4> tangents;
    std::array<std::vector<glm::vec2>, 2> uvs;
    std::vector<glm::vec4> colors; ///< Colour per vertex, linear, with straight alpha
    /// Joints that move each vertex: up to eight, four in each array.
    std::vector<glm::u16vec4> joints_0, joints_1;
    /// Weights of the joints of each vertex; the sum over both arrays is one.
    std::vector<glm::vec4> weights_0, weights_1;
    std::vector<uint32_t> indices; ///< Vertices of each element: 3 per triangle, 2 per line, 1 per point
    /// Edges of the triangles that are drawn as lines because the file marks them. Empty, or one value per
    /// triangle: bit k marks the edge from corner k to the next corner, as in
    /// EXT_mesh_primitive_edge_visibility.
    std::vector<uint8_t> edge_marks;
    std::vector<MorphTarget> morph_targets;
    /// Only used for cloth: how strongly each vertex is held at its animated position (from its node, skin or
    /// morph targets); 0 is free, 1 is fixed. Empty: all vertices are free.
    std::vector<float> held;
    /// For each entry of Scene::variants (KHR_materials_variants): the material of the primitive in this
    /// variant; `no_index` keeps the default material. Empty if the primitive has no variants.
    std::vector<Index> variant_materials;
    /// Material of the primitive when no variant is applied. Set by apply_variant().
    Index default_material = no_index;
};

/// The shape of an object in its node's space; any number of nodes may share one mesh.
struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> morph_weights; ///< Default weights of the morph targets, one per target
};

/// Placement of a node in its parent's space, in metres: the node is scaled, then rotated, then translated.
struct Transform {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    /// The matrix parent_from_node of this placement.
    [[nodiscard]] glm::dmat4 matrix() const;
};

/// A node of the scene: its placement, and a mesh, a camera, a light, or only child nodes.
struct Node {
    std::string name;
    Index parent = no_index;
    std::vector<Index> children;
    /// Visibility of the node, as in KHR_node_visibility: false hides the meshes and lights of the node and
    /// of its descendants; cameras still work.
    bool visible = true;
    Transform transform;
    /// Replaces `transform` if the file gives a matrix; such a node is never animated.
    std::optional<glm::dmat4> matrix;
    Index mesh = no_index;
    Index skin = no_index;
    Index camera = no_index;
    Index light = no_index;
    LightLinks links;
    std::optional<Cloth> cloth; ///< If set, the node's mesh moves as cloth
    ClothCollider collider = ClothCollider::none;
    std::vector<float> morph_weights; ///< Weights of the node's morph targets; empty: the weights of the mesh
    /// Instances of the node's mesh, as in EXT_mesh_gpu_instancing: node_from_instance for each. Empty: one
    /// instance, with the identity.
    std::vector<glm::mat4> instances;
};

/// A skeleton that deforms meshes; `joints_0` and `joints_1` of a primitive are indices into `joints`.
struct Skin {
    std::string name;
    std::vector<Index> joints;              ///< Nodes that act as joints, by index
    std::vector<glm::mat4> joint_from_bind; ///< Inverse bind matrices, one per joint
};

/// Kind of a light. Ambient light comes from all directions, and its node's place is ignored.
enum class LightType : uint8_t { directional, point, spot, ambient };

/// How the light of a lamp decreases with the distance d: inverse_square is 1 / d^2. unit_volume is 1 - (d /
/// range)^2 within the range, as if the light's volume were scaled to the unit sphere (Zanuttini, "Recherches
/// en rendu non réaliste temps réel", Université Paris 8, 2008, chapter 4).
enum class LightFalloff : uint8_t { inverse_square, unit_volume };

/// Lit volume of a spot light: a cone, or a pyramid whose square base has its sides along the node's x and y.
enum class SpotShape : uint8_t { cone, pyramid };

/// A light as in KHR_lights_punctual, which shines along its node's -z. Intensity is in lux (directional,
/// ambient) or candela (point, spot). With LightFalloff::unit_volume the intensity is in lux, measured at the
/// light.
struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 color{1.0F}; ///< Colour of the light, linear
    float intensity = 1.0F;
    float range_m = 0.0F; ///< Distance that the light reaches; 0: unlimited
    float inner_cone_rad = 0.0F;
    /// Half the opening angle of the cone; for a pyramid half the angle between opposite sides.
    float outer_cone_rad = 0.7853982F;
    LightFalloff falloff = LightFalloff::inverse_square;
    SpotShape shape = SpotShape::cone;
    /// Radius of the glowing sphere of a point or spot light; a larger radius gives wider penumbrae, 0 gives
    /// hard shadows. Empty: `shadow.lamp_radius_m` of the style.
    std::optional<float> radius_m;
    /// Groups of the light: the light affects objects that have one of the light's groups in `lit_by`.
    Groups groups = all_groups;
    /// The light is blocked by objects that have one of the groups listed here in `casts_for`. 0: the light
    /// casts no shadows.
    Groups casters = all_groups;

    bool operator==(const Light& other) const = default;
};

/// A camera of the file, which looks along its node's -z.
struct SceneCamera {
    std::string name;
    bool orthographic = false;
    double vertical_fov_rad = 0.8;
    double half_height_m = 1.0; ///< Half the height of the view; only used by an orthographic camera
    double near_m = 0.01;
};

/// Interpolation between the keys of an animation.
enum class Interpolation : uint8_t { step, linear, cubic_spline };
/// Property of a node that an animation changes; `weights` are the weights of the node's morph targets.
enum class AnimatedPath : uint8_t { translation, rotation, scale, weights };

/// Animation of one property of one node, as keys (times and values).
struct AnimationChannel {
    Index node = no_index;
    AnimatedPath path = AnimatedPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times_s; ///< Times of the keys, in ascending order
    /// Values of the keys. The number of floats per key is 3 for translation and scale, 4 (x, y, z, w) for
    /// rotation, and one per morph target for weights. Cubic splines have three times as many.
    std::vector<float> values;
};

/// An animation of the scene: channels that play together, starting at 0 s.
struct Animation {
    std::string name;
    std::vector<AnimationChannel> channels;
    float duration_s = 0.0F; ///< Time of the last key in the animation
    /// Start of the animation's time range in the file: the first frame of a film shows this time.
    float start_s = 0.0F;
};

/// A room of the scene, as a box along the axes of world space, for culling by cells and portals (the style
/// parameter `culling.cells`). Space outside of all boxes is one further cell, outdoors. Cells hold what lies
/// in them by place: nodes are not assigned to cells.
struct SceneCell {
    std::string name;
    glm::dvec3 low_m{0.0}, high_m{0.0}; ///< Opposite corners of the box
};

/// An opening through which one sees from one cell into another. The faces of all cells must be opaque except
/// for their portals; a portal may be larger than the real opening. no_index is outdoors, outside of all
/// cells.
struct ScenePortal {
    std::vector<glm::dvec3> corners_m; ///< Convex flat polygon in world space, 3 to 12 corners in order
    Index from = no_index;             ///< Cell on one side of the portal
    Index to = no_index;               ///< Cell on the other side of the portal
};

/// The content of a scene file, as arrays that refer to each other by index. Programs can also build a scene
/// themselves; the defaults of all members are those of glTF.
struct Scene {
    std::string name;
    std::vector<Texture> textures;
    std::vector<Material> materials; ///< Materials of the scene; at least one
    std::vector<Mesh> meshes;
    /// Nodes of the scene. Nodes form a forest: each child of a node has this node as its parent, and there
    /// are no cycles.
    std::vector<Node> nodes;
    std::vector<Index> roots;
    std::vector<Skin> skins;
    std::vector<Light> lights;
    std::vector<SceneCamera> cameras;
    std::vector<Animation> animations;
    std::optional<double> frames_per_s; ///< Frame rate that the file was made for, if it gives one
    std::vector<std::string> variants;  ///< Names of the material variants; see apply_variant()
    /// Endless ground, drawn as an object and a material named "terrain".
    std::optional<Terrain> terrain;
    std::vector<std::string> extensions_used;
    /// Extensions that the file uses and that load_scene() does not support.
    std::vector<std::string> extensions_ignored;
    /// Files that the scene was read from, each once: the file that load_scene() was given, then those that
    /// it names and that were found, such as buffers, material libraries and pictures.
    std::vector<std::filesystem::path> files;
    std::vector<std::string> missing_files; ///< Images that the file refers to but that could not be opened
    /// Metres per unit of length in the file, if the file gives this factor. The scene itself is in metres.
    std::optional<double> file_unit_m;
    /// Repairs made while the scene's file was read, one line of text each. After load_scene() each line
    /// begins with the file's name.
    std::vector<std::string> warnings;
    std::vector<SceneCell> cells;     ///< Rooms of the scene; empty if the scene is not divided into rooms
    std::vector<ScenePortal> portals; ///< Openings between `cells`
};

/// Returns what is wrong with a scene that a program made or changed itself: indices out of range, arrays
/// whose lengths disagree, nodes that form no forest, numbers that are not finite. Each text names the place,
/// such as: meshes[2] "wheel", primitives[0]: indices[17] is 24, but the number of positions is 24. Empty if
/// the scene can be drawn. Lists at most 100 faults of structure and 100 of numbers. load_scene() returns
/// scenes without faults. Cost: linear in vertices, indices and nodes.
[[nodiscard]] std::vector<std::string> faults(const Scene& scene);

/// Returns the cloth material of a primitive, from its node or else from its material; null if the primitive
/// is not cloth.
[[nodiscard]] const Cloth* cloth_of(const Scene& scene, const Node& node, const Primitive& primitive);

/// Computes the normals of the triangles of a primitive, whose indices must be in range, and replaces those
/// that it has. A normal is the average of the faces that meet at a position, weighted by their angles there,
/// without faces across edges sharper than `crease_rad`: 0 shades every face flat, pi shades the whole
/// surface smoothly. Vertices are repeated where faces need different normals, and equal ones are merged; the
/// number and order of triangles stay. Cost: about 0.25 s for a million triangles.
void compute_normals(Primitive& primitive, float crease_rad);

/// Makes a rectangular sheet of cloth: a regular grid of columns x rows vertices, at least 3 x 3. The sheet
/// begins at `corner_m`; its sides are the vectors `along_m` and `down_m`. Seen from the sheet's front side,
/// the turn from `along_m` to `down_m` is clockwise. UVs are metres on the sheet.
[[nodiscard]] Primitive cloth_sheet(uint32_t columns, uint32_t rows, const glm::vec3& corner_m,
                                    const glm::vec3& along_m, const glm::vec3& down_m);

/// Assigns every primitive its material of one variant, given by name, or by index if no variant has the
/// name. An empty name restores the default materials. Renderer::set_scene() shows the change. Throws Error
/// that lists the variants if no variant matches. Cost: linear in primitives.
void apply_variant(Scene& scene, const std::string& variant);

/// The axis of a file's coordinates that points up. In memory, a scene is always y up.
enum class UpAxis : uint8_t { x, y, z, minus_x, minus_y, minus_z };

/// Options of load_scene(). The defaults read the file as it is.
struct LoadOptions {
    std::string variant; ///< Material variant, by name or index; empty: the default materials
    /// Axis of the file's coordinates that points up; the scene is rotated so that this axis becomes +y.
    /// Empty: uses the axis that the file or its format defines, else y. FBX and COLLADA scenes are first
    /// rotated by the axis that the file names.
    std::optional<UpAxis> up;
    /// Limits the files that are read: the scene's file, and all files that it names. For scenes of
    /// strangers, ReadScope::beside() of the scene's file.
    ReadScope scope;
    WorkLimits limits; ///< Limits the memory and the time of loading

    bool operator==(const LoadOptions& other) const = default;
};

/// Reads a scene from a .gltf, .glb, .obj, .ply, .stl, .fbx or .dae file.
///
/// Damage in the file is repaired if possible; `Scene::warnings` lists the repairs. Throws Error with file
/// and place (a JSON pointer or a byte offset) if the damage cannot be repaired, and if a file
/// lies outside of `options.scope`, or a limit of
/// `options.limits` is exceeded. Allocates at most a small
/// multiple of the file's size.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// Placement and morph weights of every node at one time.
struct ScenePose {
    std::vector<glm::dmat4> world_from_node; ///< Placement of each node in the world
    /// Weights of each node's morph targets; empty for a node without morph targets.
    std::vector<std::vector<float>> morph_weights;
};

/// Evaluates the node hierarchy at `time_s` of an animation, which loops. no_index, or a scene without
/// animations, gives the rest pose. Cost: linear in nodes and channels.
[[nodiscard]] ScenePose pose_scene(const Scene& scene, double time_s, Index animation = 0);

/// Axis-aligned bounding box; empty until it is extended.
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

/// Returns the bounds of all vertices of the scene in `pose`, in world space. Skinning and morphing are
/// included and computed exactly on the CPU. Cost: linear in vertices.
[[nodiscard]] Bounds scene_bounds(const Scene& scene, const ScenePose& pose);

/// Viewpoint and projection of a picture, in world space.
struct Camera {
    glm::dvec3 eye{0.0, 0.0, 5.0};
    /// Point that the camera looks at; in the middle of the picture unless `shift` moves it.
    glm::dvec3 target{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double vertical_fov_rad = 0.6;
    /// Half the height of a parallel projection; empty: perspective projection.
    std::optional<double> orthographic_half_height_m;
    double near_m = 0.01;
    /// Lens shift: how far the middle of the picture lies to the right of and above the axis of view, as
    /// shares of the picture's width and height, without the margin of its paper. At (0.5, 0), `target` is in
    /// the middle of the left edge. A shift keeps parallel lines parallel, as in drawings of facades, where
    /// turning the camera would make them converge.
    glm::dvec2 shift{0.0};

    bool operator==(const Camera& other) const = default;
};

/// Returns the camera of the scene's file with this name, or with this index if `name` is a number, placed by
/// `pose`. Throws Error that lists the names if no camera has this name or index.
[[nodiscard]] Camera scene_camera(const Scene& scene, const ScenePose& pose, const std::string& name);

/// Direction of the style's sun, for framing_camera(), which leaves room on the page for the shadow that this
/// sun casts.
struct SunBearing {
    /// Direction of the sun in degrees, seen from above: 0 is +z, 90 is +x. The value is valid for a camera
    /// that looks from an azimuth of 35 degrees.
    double azimuth_deg = -34.0;
    double elevation_deg = 45.0;
    /// The sun rotates with the camera if the framed view shows another side of the scene.
    bool turns = true;
    bool rules = false; ///< The style uses its own sun instead of the scene's lights
    bool throws = true; ///< The sun casts a drawn shadow, so the picture needs room for the shadow
    /// The shadow falls on a blank ground below the scene, so it is visible without a floor. Empty: true
    /// unless the scene has a camera.
    std::optional<bool> on_blank_ground;
};

/// Automatic camera: a three-quarter view of the whole scene from slightly above, with a margin. The
/// automatic camera shows the side with most detail: the front, +z, unless another side has clearly more. The
/// camera leaves room for the ground shadow of the scene's strongest directional light, or else of `sun`. A
/// floor much wider than the objects on it may extend beyond the page. A room is seen through its open side,
/// or through the wall that faces the camera. A closed house is seen from a corner inside the house. `aspect`
/// is width / height. Throws Error if the scene is too large, small or far away to be drawn. Cost: linear in
/// vertices and triangles, about 0.1 s for half a million.
[[nodiscard]] Camera framing_camera(const Scene& scene, const ScenePose& pose, double aspect,
                                    const SunBearing& sun = {});

/// Parses "eye=x,y,z target=x,y,z [fov=degrees] [up=x,y,z] [ortho] [ortho=half_height] [shift=right,up]", in
/// any order, separated by blanks. `fov` is vertical, 1 to 170. `shift` is Camera::shift. `ortho` selects
/// parallel projection; its number is half the height in metres, by default that of the perspective view at
/// the target. If the text is not valid, throws an Error that names the wrong part and shows a valid example.
[[nodiscard]] Camera parse_camera(const std::string& text);

} // namespace estampe
