// SPDX-License-Identifier: MIT
#pragma once

// Computes two coordinates over a triangle mesh, for strokes that follow the form. Lines of equal coordinate
// run around and along the form, as in an engraving. The coordinates are computed once per mesh on the CPU.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::form {

struct FormOptions {
    /// Mean distance in metres between lines at neighbouring whole coordinates. Where lines converge or
    /// diverge, the distance varies from 1/4 to 4 times the mean. The period is the coarsest usable spacing
    /// of strokes. Clamped to 1/500 to 4 radii of the mesh; a quarter radius if not positive.
    float period_m = 0.0F;
    /// Distance over which the direction of curvature is smoothed, in periods; 0.05 to 100.
    float smoothing = 1.0F;
    /// Up direction, of any length except zero. On flat surfaces, strokes are perpendicular to `up`, that is,
    /// horizontal.
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    uint32_t seed = 1;
    /// Largest share of singular triangles among the triangles of a usable field. A field with a larger
    /// share, and with more than 64 singular triangles, is a tangle and is not used. The value 1 accepts
    /// every field.
    float most_singular_share = 1.0F;
};

/// Counts of places where strokes end, break or are missing. No line field can be smooth everywhere on a
/// closed surface.
struct FormFaults {
    /// Triangles without area, with a non-finite vertex, or with an index out of range.
    uint32_t dropped_triangles = 0;
    /// Edges where the surface bends by over 45 degrees; strokes may break at a crease.
    uint32_t crease_edges = 0;
    /// Triangles around which the direction of strokes turns by half a turn or more.
    uint32_t singular_triangles = 0;
    uint32_t branch_triangles_a = 0; ///< triangles in which lines of equal coordinate a begin or end
    uint32_t branch_triangles_b = 0;
    /// Sum of the singularities' indices; equals the Euler characteristic on a closed smooth mesh.
    float index_sum = 0.0F;
};

struct FormField {
    /// Coordinates (a, b) in periods, for each corner of each triangle; linear within a triangle. Across an
    /// inner edge, the coordinates of both triangles differ at most by whole numbers and by a common sign. So
    /// lines at whole numbers, and at power-of-two fractions, are continuous. Exceptions are creases, and one
    /// edge of each triangle that `is_faulty`.
    std::vector<std::array<glm::vec2, 3>> corners;
    /// For each triangle: 1 if the triangle has a branch point or a singularity, where strokes end or break.
    std::vector<uint8_t> is_faulty;
    /// False if no coordinates could be computed, or if the surface is so wrinkled that its lines would be a
    /// tangle, see FormOptions::most_singular_share. If false, `corners` holds coordinates that cut the solid
    /// by two sets of parallel planes.
    bool follows_form = false;
    FormFaults faults;
};

/// Computes two stripe coordinates over a triangle mesh. Lines of equal coordinate a follow the direction of
/// greatest curvature, for example around a cylinder. Lines of equal coordinate b are perpendicular to lines
/// of equal a, for example along a cylinder. On flat surfaces the lines are horizontal; on horizontal
/// surfaces they follow one horizontal axis. Near creases, the lines follow the creases.
///
/// Vertices at equal positions are merged. Three indices make one triangle, counter-clockwise from outside.
/// Accepts any input: a mesh that cannot be used gets coordinates from two sets of parallel planes. Throws
/// only std::bad_alloc. Deterministic. Cost: linear; on two threads about 20 us and 2 kB of temporary memory
/// per vertex. Sources: see README.md.
[[nodiscard]] FormField follow_form(std::span<const glm::vec3> positions_m,
                                    std::span<const uint32_t> triangle_indices, const FormOptions& options);

} // namespace estampe::form
