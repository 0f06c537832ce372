// SPDX-License-Identifier: MIT
#pragma once

// Strokes that follow form. Computes two coordinates over a triangle mesh. Lines of equal value run around
// and along the form, as in an engraving. The coordinates are computed once per mesh on the CPU.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::form {

struct FormOptions {
    /// Mean distance between the lines of neighbouring whole coordinates; where lines converge or diverge,
    /// the distance is 1/4 to 4 times that. Strokes are continuous at whole numbers and finer fractions, so
    /// this is the coarsest usable spacing. Clamped to 1/500 to 4 radii of the mesh; a quarter radius if not
    /// positive.
    float period_m = 0.0F;
    /// Distance over which the direction of curvature is smoothed, in periods; 0.05 to 100.
    float smoothing = 1.0F;
    /// Up direction, of any length but zero. On flat surfaces the strokes are level.
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    uint32_t seed = 1;
};

/// Counts of places where the stripes are not perfect. No line field can be perfect everywhere.
struct FormFaults {
    /// Triangles without area, with a non-finite vertex, or with an index out of range.
    uint32_t dropped_triangles = 0;
    uint32_t crease_edges = 0; ///< edges sharper than 45 degrees; strokes may break there
    /// Triangles around which the direction of strokes turns by half a turn or more.
    uint32_t singular_triangles = 0;
    uint32_t branch_triangles_a = 0; ///< triangles in which lines of equal coordinate a begin or end
    uint32_t branch_triangles_b = 0;
    /// Sum of the singularities' indices; equals the Euler characteristic on a closed smooth mesh.
    float index_sum = 0.0F;
};

struct FormField {
    /// Coordinates (a, b) in periods, for each corner of each triangle; linear within a triangle. Across an
    /// inner edge, the coordinates of both triangles agree up to whole numbers and a common sign. So lines at
    /// whole numbers, and at power-of-two fractions, are continuous. Exceptions are creases, and one edge of
    /// each triangle that `is_faulty`.
    std::vector<std::array<glm::vec2, 3>> corners;
    /// For each triangle: 1 if it has a branch point or a singularity, where strokes end or break.
    std::vector<uint8_t> is_faulty;
    /// False if no coordinates could be computed. In this case `corners` slices the solid by two families of
    /// parallel planes.
    bool follows_form = false;
    FormFaults faults;
};

/// Computes two stripe coordinates over a triangle mesh. Lines of equal a follow the direction of greatest
/// curvature, around a cylinder; lines of equal b are perpendicular to them, along the cylinder. On flat
/// surfaces the lines are level; on horizontal surfaces they follow one horizontal axis. Creases attract the
/// lines.
///
/// Vertices at the same place are merged. Three indices make one triangle, counter-clockwise from outside.
/// Accepts any input: meshes that cannot be used (see FormFaults) are sliced as a solid. Throws only
/// std::bad_alloc. Deterministic. Cost: linear; on two threads about 20 us and 2 kB of temporary memory per
/// vertex. Sources: see README.md.
[[nodiscard]] FormField follow_form(std::span<const glm::vec3> positions_m,
                                    std::span<const uint32_t> triangle_indices, const FormOptions& options);

} // namespace estampe::form
