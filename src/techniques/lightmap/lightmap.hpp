// SPDX-License-Identifier: MIT
#pragma once

// Light that was worked out ahead, looked up where it is seen.

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

/// The maps of a scene, and where its triangles lie in them.
struct MapData {
    std::vector<LightImage> layers;          ///< of any sizes
    std::vector<shared::LightmapSlot> slots; ///< one a draw
    std::vector<glm::vec2> corners;          ///< three a triangle, 0 to 1 from the top left
};

struct MapBuffers {
    gpu::Buffer slots;
    gpu::Buffer corners;
    gpu::Image maps; ///< rgba16f, a layer a map
};

/// Uploads maps, all stretched to the size of the largest, with one coarser level: charts of a map are not
/// far enough apart for more. Throws Error when they are beyond the device's limits. Cost: about 30 ns a
/// texel.
[[nodiscard]] MapBuffers upload_maps(gpu::Device& device, const MapData& data);

struct LightmapInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::BufferId visibility;
    gpu::BufferId triangles;
    gpu::BufferId posed_vertices;
    float scale = 1.0F; ///< from the maps' exposure to the frame's
    glm::uvec2 size_px{0};
};

/// Writes  rgba16f: irradiance over pi; 1 in alpha where a map says something
/// Cost    one full-screen dispatch, with one look into a map a pixel
[[nodiscard]] gpu::ImageId add_lightmap(gpu::Graph& graph, const LightmapInputs& in, MapBuffers& maps);

} // namespace estampe::lightmap
