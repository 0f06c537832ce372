// SPDX-License-Identifier: MIT
#pragma once

// How a mesh bends at each vertex.

#include <complex>
#include <vector>

#include "techniques/form/form_mesh.hpp"

namespace estampe::form {

using Complex = std::complex<double>;

/// The curvature tensor at a vertex, in inverse radii of the mesh; positive on a ball.
struct Curvature {
    double mean = 0.0;      ///< (k1 + k2) / 2
    Complex deviator = 0.0; ///< (k1 - k2) / 2, at twice the angle of k1's direction in the tangent plane
};

/// Curvature by face from differences of vertex normals, taken to the vertices and then averaged over about
/// `reach` (in radii of the mesh), so that bumps smaller than that cancel. Cost: linear.
[[nodiscard]] std::vector<Curvature> find_curvature(const Mesh& mesh, double reach);

} // namespace estampe::form
