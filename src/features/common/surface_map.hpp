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

/// Content of the texture atlas over all surfaces as the shaders read it; see shaders/surface_map.glsl and
/// shaders/map_corners.glsl.
struct SurfaceMapData {
    uint32_t size = 0;         ///< Texels per side of the atlas
    float texels_per_m = 0.0F; ///< Resolution of the atlas on the surfaces, at the scale of the rest pose
    /// For each texel, row by row: number of the triangle + 1 (0: no triangle), and the weights of the
    /// triangle's corners 2 and 3.
    std::vector<glm::uvec4> texels;
    /// Position of the triangles' corners in the atlas, three per triangle, in texels; negative outside the
    /// atlas.
    std::vector<glm::vec2> corners;
    uint32_t cut_draws = 0; ///< Number of draw calls without usable UVs, whose triangles were cut into charts
};

/// Packs all opaque and masked surfaces except ground and terrain into a square atlas of `size` texels per
/// side. The UVs of a draw call are used if they cover all its triangles without overlap; the second UV set
/// is tried first. If neither UV set is usable, the triangles of the draw call are cut into charts, as
/// `estampe bake` does. Throws Error if the charts do not fit. Cost: a few microseconds per triangle.
[[nodiscard]] SurfaceMapData make_surface_map(const pose::MeshData& layout, uint32_t size);

/// The texture atlas over all surfaces, on the device.
struct SurfaceMap {
    gpu::Buffer texels;
    gpu::Buffer corners;
    uint32_t size = 0;
    float texels_per_m = 0.0F;
    uint32_t cut_draws = 0;
};

[[nodiscard]] SurfaceMap upload_surface_map(gpu::Device& device, const SurfaceMapData& data);

} // namespace estampe::features
