// SPDX-License-Identifier: MIT
#pragma once

// Borders, boundaries, creases, ridges and valleys as whole lines: they hold to the surface, so they are
// strung once.

#include <span>
#include <vector>

#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/bending.hpp"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {

/// Which edges have lines of their own.
struct FeatureChoice {
    float crease_deg = 34.0F; ///< where shading breaks; where it goes on, 60 degrees at the least
    bool borders = true;
    bool boundaries = true;
    bool creases = true;
    bool marked =
        true; ///< what the file marks; where it does, folds and borders that it leaves out have none
    bool operator==(const FeatureChoice&) const = default;
};

/// Lines over the vertices of an edge mesh, and what is left for outlines to find from view to view.
struct FeatureChains {
    std::vector<shared::FeaturePoint>
        points; ///< chain after chain; the first again at the end of a closed one
    std::vector<shared::FeatureChain> chains;
    std::vector<glm::uvec2> loose_edges; ///< hard edges that have no line of their own
    bool leave_edges = false;            ///< some points lie between vertices, some pieces within triangles
};

/// Strings the edges of one kind together where they meet and bend by no more than 60 degrees, the
/// straightest first. Cost: linear in features and hard edges.
[[nodiscard]] FeatureChains string_features(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                                            const FeatureChoice& choice);

struct RidgeChoice {
    bool ridges = false;
    bool valleys = false;
    float ridge_deg = 15.0F; ///< turn of the surface over a hundredth of the object's size: its sharpest
                             ///< place must have this, all of a line two thirds of it
    bool operator==(const RidgeChoice&) const = default;
};

/// Appends to `features` the lines along which a surface bends most, outwards or inwards, as one goes across
/// them: where the greatest curvature has a maximum along its own direction. Points lie on edges, between two
/// vertices, and so keep to whatever becomes of these. What is shorter than 1/30 of the object is left out,
/// and what touches a border, a hard edge or a line that `features` has already.
///
/// Cost    linear
/// Source  Ohtake, Belyaev and Seidel, "Ridge-Valley Lines on Meshes via Implicit Surface Fitting", 2004
void add_ridges(const RestSurface& surface, std::span<const Bending> bendings, const RidgeChoice& choice,
                FeatureChains& features);

} // namespace estampe::contour
