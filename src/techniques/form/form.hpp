// SPDX-License-Identifier: MIT
#pragma once

// Strokes that follow form: two coordinates over a triangle mesh whose lines of equal value run across and
// along the form, as an engraver's do. Made once for each mesh, on the processor.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::form {

struct FormOptions {
    /// Mean distance between neighbouring lines of whole coordinates; it is 1/4 to 4 times that where lines
    /// converge or part. Strokes are continuous at whole numbers and finer, so this is the coarsest spacing
    /// ever wanted. Clamped to 1/500 to 4 radii of the mesh; a quarter radius when not a positive number.
    float period_m = 0.0F;
    /// Over how many periods the direction of curvature is smoothed; 0.05 to 100.
    float smoothing = 1.0F;
    /// Where nothing bends, strokes are level with regard to this direction. Any length but zero.
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    uint32_t seed = 1;
};

/// A line field or stripe pattern cannot be perfect everywhere; this is where it is not.
struct FormFaults {
    uint32_t dropped_triangles = 0;  ///< no area, no finite place, or indices past the end
    uint32_t crease_edges = 0;       ///< sharper than 45 degrees; strokes may break there
    uint32_t singular_triangles = 0; ///< where the direction of strokes turns by half a turn or more
    uint32_t branch_triangles_a = 0; ///< where lines of equal a begin or end
    uint32_t branch_triangles_b = 0;
    float index_sum = 0.0F; ///< of all singularities; the Euler characteristic on a closed smooth mesh
};

struct FormField {
    /// For each triangle and corner the coordinates (a, b), in periods, linear within a triangle. Over an
    /// inner edge they agree up to whole numbers and, both at once, a sign, so lines at whole numbers and at
    /// any power of two between them meet; not so on creases and on one edge of each triangle that
    /// `is_faulty`.
    std::vector<std::array<glm::vec2, 3>> corners;
    /// 1 for triangles that hold a branch point or a singularity: strokes end or break within them.
    std::vector<uint8_t> is_faulty;
    /// False when the mesh could not be followed: then `corners` slice the solid by two families of parallel
    /// planes.
    bool follows_form = false;
    FormFaults faults;
};

/// Two stripe coordinates over a triangle mesh. Lines of equal a run along the direction of greatest
/// curvature, across the form: round a cylinder; lines of equal b run square to them: along the cylinder.
/// Where the surface does not bend they are level, and where it is level they run along one horizontal axis;
/// creases draw them to themselves.
///
/// Vertices at the same place are one; three indices make one triangle, counter-clockwise from outside. Any
/// input is taken: what is beyond use (see FormFaults) is sliced as a solid, and nothing is thrown but
/// std::bad_alloc. Same input, same result. Cost: linear; on two threads about 20 us a vertex and 2 kB while
/// it runs. Sources: see README.md.
[[nodiscard]] FormField follow_form(std::span<const glm::vec3> positions_m,
                                    std::span<const uint32_t> triangle_indices, const FormOptions& options);

} // namespace estampe::form
