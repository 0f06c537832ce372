// SPDX-License-Identifier: MIT
#pragma once

// Materials and their textures on the GPU. Textures are sorted into five size classes, each one array image,
// because not every device can index textures freely.

#include <array>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "gpu/resources.hpp"
#include "shaders/scene.glsl.h"
#include "techniques/surface/surface.hpp"

namespace estampe::surface {

inline constexpr std::array<uint32_t, 5> texture_class_px{256, 512, 1024, 2048, 4096};

struct MaterialBuffers {
    std::vector<shared::MaterialRecord> records; ///< one a material, and the ground's last
    gpu::Buffer materials;                       ///< the same on the device
    std::array<gpu::Image, 5> textures;
};

/// Where each texture of `scene` that a colour, normal or occlusion uses will live; `layers` counts the
/// layers by class.
struct TexturePlan {
    std::vector<uint32_t> location; ///< class in bits 0-3, layer in 4-23; no_texture when unused
    std::array<std::vector<Index>, 5> layers;
    uint32_t reduced = 0;  ///< textures of a class smaller than they are
    uint32_t left_out = 0; ///< textures for which there was no layer
};

/// What a class has no more than `most_layers` for goes to the next smaller one that has room, else to a
/// larger one.
[[nodiscard]] TexturePlan plan_textures(const Scene& scene, uint32_t most_layers);

/// What the materials and meshes of `scene` need of the shaders.
[[nodiscard]] SceneNeeds scene_needs(const Scene& scene, const TexturePlan& plan);

/// The records of all materials, with one more for the ground.
[[nodiscard]] std::vector<shared::MaterialRecord> material_records(const Scene& scene,
                                                                   const TexturePlan& plan);

/// Uploads textures, resized to their class and with all mip levels, and materials; `plan` is for the layers
/// that `device` offers. Throws Error when memory runs out. Cost: about 30 ms for a texture of 2048 x 2048,
/// on two threads.
[[nodiscard]] MaterialBuffers upload_materials(gpu::Device& device, const Scene& scene,
                                               const TexturePlan& plan);

/// Gives a material without textures another colour, linear. Cost: an upload of all records.
void recolor(gpu::Device& device, MaterialBuffers& buffers, Index material, const glm::vec3& color);

/// What became of textures that are not drawn as they are, a line each.
[[nodiscard]] std::vector<std::string> notes_of(const TexturePlan& plan);

/// The textures as handles of one graph.
[[nodiscard]] std::array<gpu::ImageId, 5> import_textures(gpu::Graph& graph, MaterialBuffers& materials);

} // namespace estampe::surface
