// SPDX-License-Identifier: MIT
#pragma once

// Assigns the lightmaps of files to triangles, and removes the lights whose light the maps already contain.

#include <optional>

#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>

#include "techniques/light/light.hpp"
#include "techniques/lightmap/lightmap.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// Assigns a lightmap to the triangles of `meshes`, which were built from `scene`. A baked map is assigned to
/// static triangles; pictures that the scene's file names are assigned to meshes with UVs for them.
/// Transparent surfaces and the ground get no lightmap. Throws Error if a baked map was made for another
/// scene, or if no mesh can use the pictures. Cost: linear in triangles.
[[nodiscard]] lightmap::MapData worn_map(const Lightmap& map, const Scene& scene,
                                         const pose::MeshData& meshes);

/// A lightmap on the device, with its exposure and the lights that it contains.
struct WornLight {
    lightmap::MapBuffers maps;
    float exposure = 1.0F; ///< Exposure of the bake; 0: no exposure is applied to the map
    float level = 0.0F;    ///< Mean luminance of the lightmap
    uint32_t kinds = 0;    ///< Kinds of lights that the map contains, as bits of BakedLights
};

/// Uploads the lightmap `map` as worn_map() assigns it to triangles; nothing if `map` is null. Throws Error
/// as worn_map() and lightmap::upload_maps() do.
[[nodiscard]] std::optional<WornLight> upload_baked(gpu::Device& device, const Lightmap* map,
                                                    const Scene& scene, const pose::MeshData& meshes);

/// Returns the BakedLights bit of a light's kind.
[[nodiscard]] uint32_t kind_of(const shared::LightRecord& record);

/// Prepares a frame's lights for a lightmap: removes lights of the kinds that the map already contains. If
/// the style asks for balance, also dims the other lights. Returns the factor for the map's values; 0 without
/// a map.
[[nodiscard]] float make_room(light::Lighting& lighting, const std::optional<WornLight>& worn,
                              const lightmap::LightmapStyle& style);

} // namespace estampe::features
