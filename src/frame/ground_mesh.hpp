// SPDX-License-Identifier: MIT
#pragma once

#include "techniques/pose/mesh_data.hpp"

namespace estampe::frame {

/// The scene with a node and a material "terrain" at their lists' ends, which its terrain is drawn as.
[[nodiscard]] Scene with_terrain_node(const Scene& scene);

/// The mesh of the terrain of a scene with such a node, as it lies before any eye has looked.
[[nodiscard]] pose::ForeignMesh ground_mesh(const Scene& scene);

} // namespace estampe::frame
