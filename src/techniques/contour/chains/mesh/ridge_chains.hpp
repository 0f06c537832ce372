// SPDX-License-Identifier: MIT
#pragma once

// Ridges and valleys of smooth surfaces as whole lines: they hold to the surface, so they are strung once.

#include <span>

#include "techniques/contour/chains/mesh/bending.hpp"
#include "techniques/contour/chains/mesh/feature_chains.hpp"

namespace estampe::contour {

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
