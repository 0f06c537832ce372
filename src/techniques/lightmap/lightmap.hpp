// SPDX-License-Identifier: MIT
#pragma once

// Baked light: looks up lightmaps on visible surfaces.

#include <span>
#include <vector>

#include <estampe/lightmap.hpp>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "style/parameter.hpp"
#include "techniques/lightmap/lightmap.glsl.h"

namespace estampe::lightmap {

struct LightmapStyle {
    float strength = 1.0F;
    bool balance = true;
};

[[nodiscard]] const style::Table<LightmapStyle>& lightmap_table();

/// The lightmaps of a scene, and the UV coordinates of the scene's triangles.
struct MapData {
    std::vector<LightImage> layers;          ///< the lightmaps, images of any size
    std::vector<shared::LightmapSlot> slots; ///< the lightmap of each draw (mesh primitive)
    /// UV coordinates, three per triangle; (0, 0) is the top left corner of a lightmap.
    std::vector<glm::vec2> corners;
};

struct MapBuffers {
    gpu::Buffer slots;
    gpu::Buffer corners;
    gpu::Image maps; ///< image array in format rgba16f, one layer per lightmap
};

/// Uploads lightmaps. All lightmaps are resized to the size of the largest lightmap. They have only one mip
/// level, because in coarser mip levels, neighbouring charts of a lightmap would mix. Throws Error if the
/// lightmaps exceed the device's limits. Cost: about 30 ns per texel.
[[nodiscard]] MapBuffers upload_maps(gpu::Device& device, const MapData& data);

struct LightmapInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    float scale = 1.0F; ///< factor from the exposure of the lightmaps to the exposure of the frame
    glm::uvec2 size_px{0};
};

/// Looks up the baked light of each pixel.
///
/// Writes  rgba16f: irradiance over pi; alpha 1 where a lightmap applies
/// Cost    one full-screen dispatch with one texture lookup per pixel
[[nodiscard]] gpu::ImageId add_lightmap(gpu::Graph& graph, const LightmapInputs& in, MapBuffers& maps);

} // namespace estampe::lightmap
