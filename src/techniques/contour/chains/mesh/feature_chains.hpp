// SPDX-License-Identifier: MIT
#pragma once

// Feature lines: borders, boundaries, creases, ridges and valleys as whole lines. Feature lines do not move
// on the surface, so feature lines are linked only once.

#include <span>
#include <vector>

#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/bending.hpp"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {

/// Which edges of a mesh get feature lines (creases and other lines fixed to the surface).
struct FeatureChoice {
    /// Smallest fold of a crease where the shading breaks; a fold with smooth shading needs at least 60
    /// degrees.
    float crease_deg = 34.0F;
    bool borders = true;
    bool boundaries = true;
    bool creases = true;
    /// Draws edges that the file marks; a mesh with marks has no lines at its unmarked folds and borders.
    bool marked = true;
    bool operator==(const FeatureChoice&) const = default;
};

/// Feature lines along the vertices of an edge mesh, and the remaining edges, which may be outlines in a
/// view.
struct FeatureChains {
    std::vector<shared::FeaturePoint>
        points; ///< points of all chains, chain by chain; a closed chain repeats its first point at the end
    std::vector<shared::FeatureChain> chains;
    /// Edges without a feature line where the shading breaks; each edge is stored as its two triangle sides.
    std::vector<glm::uvec2> loose_edges;
    bool leave_edges = false; ///< some points lie between vertices, and some line segments cross triangles
};

/// Links edges of one kind to chains, where the edges meet and bend by no more than 60 degrees; the
/// straightest pairs are linked first. Cost: linear in the number of feature edges and hard edges.
[[nodiscard]] FeatureChains string_features(const EdgeMesh& mesh, std::span<const glm::vec3> positions,
                                            const FeatureChoice& choice);

struct RidgeChoice {
    bool ridges = false;
    bool valleys = false;
    /// Smallest turn of the surface over a hundredth of the object's size, at the sharpest point of a line;
    /// all other points of the line need two thirds of the turn `ridge_deg`.
    float ridge_deg = 15.0F;
    bool operator==(const RidgeChoice&) const = default;
};

/// Appends the ridges and valleys of a surface to `features`: lines along which the greatest curvature has a
/// maximum in the direction of that curvature. The points of ridges and valleys lie on edges, between two
/// vertices, so the lines follow the deformation of the mesh. Leaves out lines shorter than 1/30 of the
/// object, and lines that touch a border, an edge where the shading breaks, or a line that is already in
/// `features`.
///
/// Cost    linear
/// Source  Ohtake, Belyaev and Seidel, "Ridge-Valley Lines on Meshes via Implicit Surface Fitting", 2004
void add_ridges(const RestSurface& surface, std::span<const Bending> bendings, const RidgeChoice& choice,
                FeatureChains& features);

} // namespace estampe::contour
