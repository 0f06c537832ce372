// SPDX-License-Identifier: MIT
#pragma once

// Procedural meshes. Triangles are counter-clockwise seen from outside, and normals have unit length. Texture
// coordinates are metres on the surface, so that strokes have one scale everywhere. u runs along the
// direction in which a pen would hatch the surface (courses of a wall, shafts of a column, rings of a turned
// form). Sizes are positive, in metres. A number of segments that is too low for a solid is raised to the
// smallest valid number. Solids are watertight if vertices at equal places are merged, because positions on
// both sides of a seam are equal bit for bit. Each shape has its lowest point at y = 0 and its centre on the
// y axis, unless its comment says otherwise. Cost: linear in vertices, but quadratic in the corners of an
// extruded outline.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe::shapes {

/// A rectangle on the ground that faces up: u runs along x, v along z, with `cells` squares per side.
[[nodiscard]] Primitive plane(float width, float depth, uint32_t cells = 1);

/// A rectangle in the plane z = 0 that faces +z; its lower edge is on the ground.
[[nodiscard]] Primitive quad(float width, float height);

/// A box with hard edges; the texture coordinate u runs horizontally on its sides.
[[nodiscard]] Primitive box(const glm::vec3& size);

/// A sphere around the origin; the texture coordinate u runs along the parallels.
[[nodiscard]] Primitive sphere(float radius, uint32_t segments = 32, uint32_t rings = 16);

/// A torus around the y axis, centred on the origin; the texture coordinate u runs around the axis, v around
/// the tube.
[[nodiscard]] Primitive torus(float radius, float tube_radius, uint32_t segments = 48,
                              uint32_t tube_segments = 20);

[[nodiscard]] Primitive cylinder(float radius, float height, uint32_t segments = 32);

[[nodiscard]] Primitive cone(float radius, float height, uint32_t segments = 32);

/// Turns a profile of (radius, height) points about the y axis. The outside of the shape is to the right of
/// the profile's direction, so a vase is listed from its foot up. Corners sharper than `crease_rad` stay
/// hard. The shape is a solid if the profile starts and ends on the axis, or ends where it starts.
[[nodiscard]] Primitive lathe(std::span<const glm::vec2> profile, uint32_t segments = 32,
                              float crease_rad = 0.7F);

/// Extrudes an outline in the xy plane (counter-clockwise seen from +z, simple, without holes) along z, from
/// -depth / 2 to depth / 2. The texture coordinate u runs along x on the two faces and along z on the sides.
/// Corners sharper than `crease_rad` stay hard. An outline of fewer than three corners gives an empty mesh.
[[nodiscard]] Primitive extrude(std::span<const glm::vec2> outline, float depth, float crease_rad = 0.7F);

/// A wall along x with round arches through it. The piers between the arches reach the ground.
struct ArchWall {
    float height = 6.0F;
    float thickness = 1.0F;
    uint32_t arches = 5;
    float opening = 3.0F;   ///< width of an arch's opening
    float pier = 1.2F;      ///< width of the piers: the parts of the wall between two arches and at both ends
    float springing = 2.5F; ///< height above the ground at which the round part of the arches begins
    uint32_t arch_segments = 20;
};

[[nodiscard]] float arch_wall_length(const ArchWall& wall);

/// Makes a wall with arches, centred on x. The wall must be higher than springing + opening / 2; a lower wall
/// is raised to just above.
[[nodiscard]] Primitive arch_wall(const ArchWall& wall);

/// The shaft of a Doric column: round flutes between sharp edges (arrises); the shaft narrows upwards with a
/// slight swell. The texture coordinate u runs up the shaft.
struct FlutedColumn {
    float radius_bottom = 0.6F;
    float radius_top = 0.48F;
    float height = 6.0F;
    uint32_t flutes = 20;
    uint32_t flute_segments = 6;
    uint32_t rings = 8;
    float flute_depth = 0.05F; ///< depth of a flute, as a share of the radius
    float break_height = 0.0F; ///< height of the uneven break at the top; 0: the top is cut horizontally
};

[[nodiscard]] Primitive fluted_column(const FlutedColumn& column);

/// Solid stairs that rise towards -z.
[[nodiscard]] Primitive stairs(float width, float rise, float run, uint32_t steps);

/// A rod from `a` to `b` with round ends: each end is a half sphere of `rings` rings around its point.
[[nodiscard]] Primitive rod(const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b,
                            uint32_t segments = 16, uint32_t rings = 4);

/// Returns a matrix that rotates about the y axis, counter-clockwise seen from above, and then translates.
[[nodiscard]] glm::mat4 at(const glm::vec3& place, float turn_deg = 0.0F);

/// Adds the mesh `part`, placed by `to_from_part`, to the mesh `whole`; the material of `whole` stays. A
/// mirroring placement also reverses the winding of the triangles. If either mesh has edge marks, triangles
/// without any get the mark 0: none of their edges is drawn.
void append(Primitive& whole, const Primitive& part, const glm::mat4& to_from_part);

/// Gathers placed shapes of several materials into one mesh:
///
/// MeshBuilder lamp;
///     lamp.add(iron, cylinder(0.05F, 3.0F));
///     lamp.add(glass, sphere(0.2F), at({0.0F, 3.2F, 0.0F}));
///     scene.meshes.push_back(lamp.mesh("lamp"));
///
/// Shapes with edge marks (edges chosen to be drawn) stay apart from shapes without edge marks, whose sharp
/// folds are drawn.
class MeshBuilder {
public:
    /// Adds a shape. `material` is an index of Scene::materials, or a value of an enumeration of such
    /// indices.
    template <typename Material>
    void add(Material material, const Primitive& shape, const glm::mat4& placed = glm::mat4(1.0F))
    {
        append(part(static_cast<Index>(material), !shape.edge_marks.empty()), shape, placed);
    }

    /// Adds all shapes of the builder `other`, transformed by the matrix `placed`.
    void add(const MeshBuilder& other, const glm::mat4& placed = glm::mat4(1.0F));

    /// The primitive that collects the shapes of a material, to add vertices and triangles directly.
    [[nodiscard]] Primitive& part(Index material, bool has_edge_marks);

    /// Returns the finished mesh: for each material, in ascending order, one primitive without edge marks and
    /// one with edge marks. Empty primitives are left out.
    [[nodiscard]] Mesh mesh(const std::string& name) const;

private:
    std::map<std::pair<Index, bool>, Primitive> parts_;
};

} // namespace estampe::shapes
