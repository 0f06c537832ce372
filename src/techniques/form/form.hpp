// SPDX-License-Identifier: MIT
#pragma once

// Strokes that follow form: two coordinates over a triangle mesh whose lines of equal value run across and
// along the form, as in an engraving. Computed once per mesh on the CPU.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::form {

struct FormOptions {
    /// Mean distance between lines of neighbouring whole coordinates; 1/4 to 4 times that where lines
    /// converge or diverge. Strokes are continuous at whole numbers and finer, so this is the coarsest usable
    /// spacing. Clamped to 1/500 to 4 radii of the mesh; a quarter radius if not positive.
    float period_m = 0.0F;
    /// Distance in periods over which the direction of curvature is smoothed; 0.05 to 100.
    float smoothing = 1.0F;
    /// Up direction: on flat surfaces strokes are level. Any length but zero.
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    uint32_t seed = 1;
};

/// Places where the stripes are not perfect; no line field can be perfect everywhere.
struct FormFaults {
    uint32_t dropped_triangles = 0;  ///< no area, a non-finite vertex, or an index out of range
    uint32_t crease_edges = 0;       ///< sharper than 45 degrees; strokes may break there
    uint32_t singular_triangles = 0; ///< the direction of strokes turns by half a turn or more around them
    uint32_t branch_triangles_a = 0; ///< lines of equal a begin or end in them
    uint32_t branch_triangles_b = 0;
    float index_sum = 0.0F; ///< sum of the singularities' indices; the Euler characteristic on a closed
                            ///< smooth mesh
};

struct FormField {
    /// Coordinates (a, b) in periods for each triangle and corner, linear within a triangle. Across an inner
    /// edge they agree up to whole numbers and a common sign, so lines at whole numbers, and at any
    /// power-of-two fraction, are continuous; except across creases and across one edge of each triangle that
    /// `is_faulty`.
    std::vector<std::array<glm::vec2, 3>> corners;
    /// 1 for triangles with a branch point or a singularity, where strokes end or break.
    std::vector<uint8_t> is_faulty;
    /// False if no coordinates could be computed; then `corners` slice the solid by two families of parallel
    /// planes.
    bool follows_form = false;
    FormFaults faults;
};

/// Computes two stripe coordinates over a triangle mesh. Lines of equal a follow the direction of greatest
/// curvature, around a cylinder; lines of equal b are perpendicular, along the cylinder. On flat surfaces
/// lines are level; on horizontal ones they follow one horizontal axis. Creases attract the lines.
///
/// Vertices at the same place are merged; three indices make one triangle, counter-clockwise from outside.
/// Accepts any input: meshes that cannot be used (see FormFaults) are sliced as a solid. Throws only
/// std::bad_alloc. Deterministic. Cost: linear; on two threads about 20 us and 2 kB of temporary memory per
/// vertex. Sources: see README.md.
[[nodiscard]] FormField follow_form(std::span<const glm::vec3> positions_m,
                                    std::span<const uint32_t> triangle_indices, const FormOptions& options);

} // namespace estampe::form
