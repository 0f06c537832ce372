// SPDX-License-Identifier: MIT
#pragma once

// Converts a scene's meshes to GPU data on the CPU: one vertex list, one triangle list, and one record per
// drawn copy of a primitive.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <estampe/scene.hpp>

#include "shaders/scene.glsl.h"

namespace estampe::pose {

/// A range of consecutive triangles of the triangle list.
struct Range {
    uint32_t first = 0;
    uint32_t count = 0;
    bool plain = true; ///< no triangle of the range is two-sided or mirrored
};

/// Triangles that cast shadows for the same groups, and that are either all movable or all static.
struct CasterRun {
    Range range;
    bool masked = false;
    Groups groups = all_groups;
    bool moves = false; ///< the triangles may move by an animation, a skin or morph targets
};

/// The node, primitive and instance that a draw call draws, for posing.
struct DrawSource {
    Index node = 0;
    uint32_t primitive = 0; ///< index of the primitive in the node's mesh
    uint32_t instance = 0;  ///< index into Node::instances; 0 without instances
    Bounds local_bounds; ///< bounds of the rest vertices in object space; for cloth, including its range of
                         ///< motion
};

/// A mesh whose vertices another part of the program poses, such as terrain. A foreign mesh casts no shadow
/// into shadow maps and has no bounds.
struct ForeignMesh {
    Index node = 0; ///< node of the foreign mesh; the node's only primitive has no vertices
    Index material = 0;
    Index instead_of = no_index; ///< node whose mesh is replaced by the foreign mesh; no_index: none
    /// Approximate first positions of the vertices of the foreign mesh (not in the scene's file), in world
    /// space.
    std::vector<glm::dvec3> places;
    std::vector<glm::uvec3> triangles;
    Bounds near; ///< bounds of the view, for a scene whose only mesh is the foreign mesh
};

/// Flag in MeshData::edge_marks: the triangle's primitive has edges that an author marked.
inline constexpr uint8_t marks_edges = 8;

/// Draw calls, vertices and triangles of a scene. Triangles come in the order opaque, masked, blended,
/// ground.
struct MeshData {
    std::vector<shared::RestVertex> rest_vertices;
    std::vector<shared::SkinVertex> skin_vertices;
    std::vector<shared::MorphOffset> morph_offsets;
    std::vector<glm::uvec4> triangles; ///< indices of three posed vertices, and the draw call with flags
    /// Per posed vertex: position in the rest pose, in units of `stroke_unit_m`.
    std::vector<glm::vec3> stroke_coordinates;
    /// Per triangle: Primitive::edge_marks (edges that an author marked), plus `marks_edges` if its primitive
    /// has marks; empty if no primitive has marks.
    std::vector<uint8_t> edge_marks;
    std::vector<uint32_t> draw_of_vertex; ///< number of the draw call, per posed vertex
    /// Records of draw calls, without matrices; the mirrored flags of records and triangles are equal.
    std::vector<shared::DrawRecord> draws;
    std::vector<DrawSource> sources; ///< source of each draw call; the ground has none and comes last
    Range opaque, masked, blended, ground;
    /// Most layers of `blended` triangles behind each other from any view, counted up to 8.
    uint32_t blended_sheets = 0;
    std::vector<CasterRun> casters; ///< parts of `opaque` and `masked` that cast shadows
    bool has_cut_outs = false;      ///< some draw call has the flag draw_is_cut, but not draw_is_foliage
    bool has_foliage = false;       ///< some draw call has the flag shared::draw_is_foliage
    uint32_t joint_count = 0;
    uint32_t morph_weight_count = 0;
    /// First vertex of the foreign mesh (not in the scene's file), if any.
    std::optional<uint32_t> foreign_vertex;
    /// Origin, in world space, of anchor space (coordinates relative to a nearby origin). The origin is a
    /// multiple of 64 m if there is a foreign mesh (not in the scene's file).
    glm::dvec3 anchor{0.0};
    /// Value of `anchor` when stroke coordinates were computed. If there is a foreign mesh (not in the
    /// scene's file), `anchor` may follow the eye later.
    glm::dvec3 rest_anchor{0.0};
    double stroke_unit_m = 1.0;
    Bounds bounds; ///< bounds of the rest pose in world space
};

/// Packs and unpacks a unit vector in the format of shaders/unit.glsl.
[[nodiscard]] uint32_t pack_normal(glm::vec3 normal);
[[nodiscard]] glm::vec3 unpack_normal(uint32_t packed);

/// Packs the light groups of an object in the format of DrawRecord::groups.
[[nodiscard]] uint32_t packed_groups(const LightLinks& links);

/// Computes MeshData::edge_marks (edges that authors marked). Cost: linear in triangles if any primitive has
/// edge marks.
[[nodiscard]] std::vector<uint8_t> edge_marks_of(const MeshData& meshes, const Scene& scene);

/// Whether every draw call has the default light links (all lights light all objects).
[[nodiscard]] bool has_plain_links(const MeshData& meshes);

/// The anchor (origin of all positions on the GPU) for a scene with the given bounds and a foreign mesh (not
/// in the scene's file).
[[nodiscard]] glm::dvec3 anchor_beside_foreign(const Bounds& bounds);

/// Builds the mesh data of `scene`. Strokes follow UVs if `uvs_are_usable` accepts the primitive's UVs.
/// Otherwise strokes follow the position in the rest pose, so that strokes stick to skinned and morphing
/// bodies. Adds a ground of material `ground_material` under the scene as its own range. The mesh `foreign`
/// (not in the scene's file) becomes the last opaque mesh. Throws Error if the scene is too large for
/// `check_drawn_size`, or if scene/scene_limits.hpp rejects its extent or a position. Cost: linear in
/// vertices drawn.
[[nodiscard]] MeshData build_meshes(const Scene& scene, Index ground_material,
                                    const ForeignMesh* foreign = nullptr);

/// Converts lines to thin wires and points to small dots, as triangles, so that they are drawn, lit and
/// shadowed like other meshes. Wires and dots keep the skin and morph targets of their vertices. Cost: 10
/// triangles per line, 8 per point.
[[nodiscard]] Primitive drawn_body(const Primitive& primitive, float radius_m);

/// Upper bound on the number of a primitive's layers behind each other from any viewpoint, counted up to
/// `enough`. A flat part or a convex one-sided part has one layer. A part of any other form, or one that
/// deforms, counts as `enough`. Cost: n log n in triangles; quadratic in the triangles of a convex part, up
/// to 50 ms.
[[nodiscard]] uint32_t most_sheets(const Primitive& primitive, bool two_sided, uint32_t enough);

/// Whether a primitive's first UV set can carry strokes: present, finite, nearly undistorted, and not cut
/// into islands, at whose borders strokes would break. Cost: linear in triangles.
[[nodiscard]] bool uvs_are_usable(const Primitive& primitive);

/// Whether a primitive is a round body: most of its area is curved, as its normals tell, the normals point in
/// all directions, and few edges are folds. A box, a cylinder, a cone, a slightly bent sheet or a device of
/// many parts is not round. Cost: linear in triangles.
[[nodiscard]] bool is_round(const Primitive& primitive);

/// The data of a pose, which changes from frame to frame, ready for upload.
struct PoseData {
    std::vector<shared::DrawRecord> draws;
    /// Matrices of joints, from bind pose to anchor space (relative to a nearby origin).
    std::vector<glm::mat4> joints;
    std::vector<float> morph_weights;
    /// World bounds of shadow casters, without a floor at the lowest level and without transparent objects.
    Bounds casters;
    bool operator==(const PoseData& other) const;
};

[[nodiscard]] PoseData pose_meshes(const MeshData& meshes, const Scene& scene, const ScenePose& pose);

/// An infinite box, for objects that may be anywhere.
[[nodiscard]] Bounds everywhere();

/// Boxes in anchor space (relative to a nearby origin) around draw calls that differ between the poses
/// `before` and `now`, covering both positions. A skinned body's box covers the reach of all its joints; the
/// box is infinite if morph weights changed. Cost: linear in draw calls and joints.
[[nodiscard]] std::vector<Bounds> moved_places(const MeshData& meshes, const PoseData& before,
                                               const PoseData& now);

/// Whether no triangle is two-sided or mirrored, as Range::plain states.
[[nodiscard]] bool is_plain(std::span<const glm::uvec4> triangles);

/// Updates the mirrored flags of triangles and ranges to match the draw calls that `pose` mirrors. Returns
/// whether any flag changed. Initially no triangle is flagged. Cost: linear in draw calls, and in triangles
/// if any flag changed.
[[nodiscard]] bool turn_triangles(MeshData& meshes, const PoseData& pose);

/// Indices of solid triangles, which are opaque or masked, without blank ground and terrain.
[[nodiscard]] std::vector<uint32_t> solid_triangles(const MeshData& data);

} // namespace estampe::pose
