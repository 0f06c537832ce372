// SPDX-License-Identifier: MIT
#pragma once

// Borders, boundaries, creases, ridges and valleys as whole lines. They do not move on the surface, so they
// are linked only once.

#include <span>
#include <vector>

#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/bending.hpp"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {

/// The edges that have feature lines.
struct FeatureChoice {
    float crease_deg = 34.0F; ///< where the shading breaks; where it is smooth, at least 60 degrees
    bool borders = true;
    bool boundaries = true;
    bool creases = true;
    bool marked =
        true; ///< edges that the file marks; if it marks any, its unmarked folds and borders have no lines
    bool operator==(const FeatureChoice&) const = default;
};

/// Lines along the vertices of an edge mesh, and the edges that remain for outlines to find in each view.
struct FeatureChains {
    std::vector<shared::FeaturePoint>
        points; ///< chain by chain; a closed chain repeats its first point at the end
    std::vector<shared::FeatureChain> chains;
    std::vector<glm::uvec2> loose_edges; ///< hard edges that have no feature line
    bool leave_edges = false; ///< some points lie between vertices, and some pieces within triangles
};

/// Links edges of one kind where they meet and bend by no more than 60 degrees, the straightest pairs first.
/// Cost: linear in features and hard edges.
[[nodiscard]] FeatureChains string_features(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                                            const FeatureChoice& choice);

struct RidgeChoice {
    bool ridges = false;
    bool valleys = false;
    float ridge_deg = 15.0F; ///< turn of the surface over a hundredth of the object's size; the sharpest
                             ///< point of a line must reach this, all others two thirds of it
    bool operator==(const RidgeChoice&) const = default;
};

/// Appends to `features` the ridges and valleys of a surface: lines along which the greatest curvature has a
/// maximum in its own direction. Points lie on edges between two vertices, so they follow the deformation of
/// the mesh. Leaves out lines shorter than 1/30 of the object, and lines that touch a border, a hard edge or
/// a line already in `features`.
///
/// Cost    linear
/// Source  Ohtake, Belyaev and Seidel, "Ridge-Valley Lines on Meshes via Implicit Surface Fitting", 2004
void add_ridges(const RestSurface& surface, std::span<const Bending> bendings, const RidgeChoice& choice,
                FeatureChains& features);

} // namespace estampe::contour
