// SPDX-License-Identifier: MIT
#pragma once

// The meshes of a scene in the form the GPU wants, made on the processor: one vertex list, one triangle list,
// one record for every place where a primitive is drawn.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <estampe/scene.hpp>

#include "shaders/scene.glsl.h"

namespace estampe::pose {

/// Consecutive triangles.
struct Range {
    uint32_t first = 0;
    uint32_t count = 0;
    bool plain = true; ///< none of them is two-sided or mirrored
};

/// Triangles that throw shadows for the same groups, and either may move or do not.
struct CasterRun {
    Range range;
    bool masked = false;
    Groups groups = all_groups;
    bool moves = false; ///< by an animation, a skin or morph targets; what does not stands still for ever
};

/// Where a draw comes from, for posing it later.
struct DrawSource {
    Index node = 0;
    uint32_t primitive = 0; ///< of the node's mesh
    uint32_t instance = 0;  ///< into Node::instances; 0 when there are none
    Bounds local_bounds;    ///< of the rest vertices, in object space; of cloth, about where it can come to
};

/// A mesh that is posed by somebody else: what is known of it before. It throws no shadow into maps and has
/// no bounds.
struct ForeignMesh {
    Index node = 0; ///< whose mesh is one primitive without vertices
    Index material = 0;
    Index instead_of = no_index;    ///< a node whose own mesh is left out for it
    std::vector<glm::dvec3> places; ///< about where its vertices begin, in the world
    std::vector<glm::uvec3> triangles;
    Bounds near; ///< where a scene that has nothing else takes place
};

/// In MeshData::edge_marks: the triangle's primitive says of all its edges whether they are marked.
inline constexpr uint8_t marks_edges = 8;

/// Draws, vertices and triangles of a scene. Triangles come in the order opaque, masked, blended, ground.
struct MeshData {
    std::vector<shared::RestVertex> rest_vertices;
    std::vector<shared::SkinVertex> skin_vertices;
    std::vector<shared::MorphOffset> morph_offsets;
    std::vector<glm::uvec4> triangles; ///< three posed vertices, and draw with flags
    std::vector<glm::vec3>
        stroke_coordinates; ///< one a posed vertex: place in the rest pose, in units of `stroke_unit_m`
    std::vector<uint8_t> edge_marks; ///< one a triangle, as Primitive::edge_marks, and `marks_edges` where
                                     ///< its primitive has any; empty where none has
    std::vector<uint32_t> draw_of_vertex;  ///< one a posed vertex
    std::vector<shared::DrawRecord> draws; ///< matrices not filled in; mirrored as the triangles are flagged
    std::vector<DrawSource> sources;       ///< one a draw; the ground has none and comes last
    Range opaque, masked, blended, ground;
    uint32_t blended_sheets = 0;    ///< most of `blended` that can lie one behind another, counted up to 8
    std::vector<CasterRun> casters; ///< parts of `opaque` and `masked`; what throws no shadow is in none
    uint32_t joint_count = 0;
    uint32_t morph_weight_count = 0;
    std::optional<uint32_t> foreign_vertex; ///< the first of the mesh that is posed by somebody else
    glm::dvec3 anchor{
        0.0}; ///< origin of anchor space in the world; whole multiples of 64 m beside such a mesh
    glm::dvec3 rest_anchor{0.0}; ///< the same when strokes got their coordinates; beside such a mesh the
                                 ///< anchor may go along with the eye
    double stroke_unit_m = 1.0;
    Bounds bounds; ///< of the rest pose
};

/// A unit vector as shaders/unit.glsl has it, and back.
[[nodiscard]] uint32_t pack_normal(glm::vec3 normal);
[[nodiscard]] glm::vec3 unpack_normal(uint32_t packed);

/// Groups in the form of DrawRecord::groups.
[[nodiscard]] uint32_t packed_groups(const LightLinks& links);

/// What MeshData::edge_marks is to hold. Cost: linear in triangles where some primitive marks edges.
[[nodiscard]] std::vector<uint8_t> edge_marks_of(const MeshData& meshes, const Scene& scene);

/// Whether every draw stands to all lights alike.
[[nodiscard]] bool has_plain_links(const MeshData& meshes);

/// Where the anchor is put in a scene of these bounds that has a foreign mesh.
[[nodiscard]] glm::dvec3 anchor_beside_foreign(const Bounds& bounds);

/// Builds the mesh data of `scene`. Strokes follow UVs where `uvs_are_usable` of a primitive says so,
/// otherwise the place in the rest pose, so that they stick to skinned and morphing bodies. Draws a ground of
/// material `ground_material` under the scene, as a range of its own. Throws Error when the scene is
/// larger than `check_drawn_size` lets through, or has an extent or place that scene/scene_limits.hpp
/// refuses. `foreign`, where there is one, is the last of the opaque ones. Cost: linear in vertices drawn.
[[nodiscard]] MeshData build_meshes(const Scene& scene, Index ground_material,
                                    const ForeignMesh* foreign = nullptr);

/// Lines as thin wires and points as small dots, in triangles, so that they are drawn, lit and shadowed like
/// anything else. They keep the skin and morph targets of their vertices. Cost: 10 triangles a line, 8 a
/// point.
[[nodiscard]] Primitive drawn_body(const Primitive& primitive, float radius_m);

/// Most of a primitive's surfaces that can be seen one behind another, from wherever one looks, counted up to
/// `enough`. A flat part is one, and so is a convex one seen from one side alone; of what has another form or
/// changes it nothing is known. Cost: n log n in triangles; square in those of a convex part, up to 50 ms.
[[nodiscard]] uint32_t most_sheets(const Primitive& primitive, bool two_sided, uint32_t enough);

/// Whether a primitive's first UV set can carry strokes: present, finite, hardly stretched, and not cut into
/// islands, at whose borders strokes would break. Cost: linear in triangles.
[[nodiscard]] bool uvs_are_usable(const Primitive& primitive);

/// What moves from frame to frame, ready to be copied to the GPU.
struct PoseData {
    std::vector<shared::DrawRecord> draws;
    std::vector<glm::mat4> joints; ///< anchor_from_bind
    std::vector<float> morph_weights;
    /// World bounds of what can throw a shadow: neither a floor that lies lowest nor see-through things.
    Bounds casters;
    bool operator==(const PoseData& other) const;
};

[[nodiscard]] PoseData pose_meshes(const MeshData& meshes, const Scene& scene, const ScenePose& pose);

/// A box without end, of what may be anywhere.
[[nodiscard]] Bounds everywhere();

/// Where in anchor space draws stand in either pose that do not stand alike in both: a box about both places,
/// about all its joints can do for a skinned body, and without end for one whose morph targets moved. Cost:
/// linear in draws and joints.
[[nodiscard]] std::vector<Bounds> moved_places(const MeshData& meshes, const PoseData& before,
                                               const PoseData& now);

/// Whether none of the triangles is two-sided or mirrored, as Range::plain says.
[[nodiscard]] bool is_plain(std::span<const glm::uvec4> triangles);

/// Flags the triangles of `meshes` whose draws `pose` turns inside out, and no others, and says so in all
/// ranges; returns whether any changed. Before the first call none is flagged. Cost: linear in draws, and in
/// triangles when any changed.
[[nodiscard]] bool turn_triangles(MeshData& meshes, const PoseData& pose);

/// Numbers of the triangles that are solid: opaque or cut out, and neither blank ground nor terrain.
[[nodiscard]] std::vector<uint32_t> solid_triangles(const MeshData& data);

} // namespace estampe::pose
