// SPDX-License-Identifier: MIT
#pragma once

// A map that lies on all surfaces: each place of a triangle has a texel of its own, whose place and normal
// follow the pose. What is found for texels can be kept, and spreads along the surface.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/resources.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// The map as the shaders read it, see shaders/surface_map.glsl and shaders/map_corners.glsl.
struct SurfaceMapData {
    uint32_t size = 0;         ///< texels a side
    float texels_per_m = 0.0F; ///< in the rest pose
    std::vector<glm::uvec4>
        texels; ///< row by row: triangle + 1, or 0; weights of its second and third corner
    std::vector<glm::vec2> corners; ///< three a triangle, in texels; negative where it lies in no map
    uint32_t cut_draws = 0;         ///< whose coordinates serve for nothing, and which were cut into charts
};

/// Lays all that is opaque or masked into a square of `size` texels a side, but for ground and terrain: as
/// one of its own sets of UVs lays it, the second before the first, where all triangles are there and none
/// lies over another; else as charts that are cut, as `estampe bake` does. Throws Error when the charts do
/// not fit. Cost: a few microseconds a triangle.
[[nodiscard]] SurfaceMapData make_surface_map(const pose::MeshData& layout, uint32_t size);

/// A SurfaceMapData on the device.
struct SurfaceMap {
    gpu::Buffer texels;
    gpu::Buffer corners;
    uint32_t size = 0;
    float texels_per_m = 0.0F;
    uint32_t cut_draws = 0;
};

[[nodiscard]] SurfaceMap upload_surface_map(gpu::Device& device, const SurfaceMapData& data);

} // namespace estampe::features
