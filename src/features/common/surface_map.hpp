// SPDX-License-Identifier: MIT
#pragma once

// A texture atlas over all surfaces: each point of a triangle has its own texel, whose position and normal
// follow the pose. Values computed per texel can be reused in the next picture, and blurred along the
// surface.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/resources.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// The atlas as the shaders read it, see shaders/surface_map.glsl and shaders/map_corners.glsl.
struct SurfaceMapData {
    uint32_t size = 0;              ///< texels per side
    float texels_per_m = 0.0F;      ///< at the scale of the rest pose
    std::vector<glm::uvec4> texels; ///< row by row: triangle + 1, or 0; weights of corners 2 and 3
    std::vector<glm::vec2> corners; ///< three per triangle, in texels; negative outside the atlas
    uint32_t cut_draws = 0;         ///< number of draw calls without usable UVs, which were cut into charts
};

/// Packs all opaque and masked surfaces except ground and terrain into a square of `size` texels per side.
/// The UVs of a draw call are used if they cover all its triangles without overlap; the second UV set is
/// tried first. Otherwise the triangles of the draw call are cut into charts, as `estampe bake` does. Throws
/// Error if the charts do not fit. Cost: a few microseconds per triangle.
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
