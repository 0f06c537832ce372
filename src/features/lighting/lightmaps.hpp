// SPDX-License-Identifier: MIT
#pragma once

// From lightmaps as files have them to lightmaps as triangles wear them.

#include <optional>

#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>

#include "techniques/lightmap/lightmap.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// A map on the triangles of `meshes`, which were built from `scene`: a baked one on what stands still, or
/// the pictures that the scene's file names, on what has the UVs for them. What is looked through and the
/// ground wear none. Throws Error when a baked map was made for another scene, and when pictures are worn by
/// nothing. Cost: linear in triangles.
[[nodiscard]] lightmap::MapData worn_map(const Lightmap& map, const Scene& scene,
                                         const pose::MeshData& meshes);

/// A map on the device.
struct WornLight {
    lightmap::MapBuffers maps;
    float exposure = 1.0F; ///< 0: light as it is to be seen, whatever that of the lights
    float level = 0.0F;    ///< mean brightness of the map
    uint32_t kinds = 0;    ///< of lights that the map holds, see BakedLights
};

/// Uploads worn_map() of a map, if there is one. Throws Error as that, and as lightmap::upload_maps().
[[nodiscard]] std::optional<WornLight> upload_baked(gpu::Device& device, const Lightmap* map,
                                                    const Scene& scene, const pose::MeshData& meshes);

} // namespace estampe::features
