// SPDX-License-Identifier: MIT
#pragma once

// From lightmaps as files have them to lightmaps as triangles wear them, and lights whose light they hold
// already.

#include <optional>

#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>

#include "techniques/light/light.hpp"
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

/// The bit of a light's kind, of BakedLights.
[[nodiscard]] uint32_t kind_of(const shared::LightRecord& record);

/// Makes room for a map, if there is one, in the light of a frame: leaves out lights of the kinds that it
/// holds already, and dims the others, where the style wants that. Returns what the map is to be multiplied
/// by.
[[nodiscard]] float make_room(light::Lighting& lighting, const std::optional<WornLight>& worn,
                              const lightmap::LightmapStyle& style);

} // namespace estampe::features
