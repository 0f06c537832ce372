// SPDX-License-Identifier: MIT
#pragma once

// Materials and textures on the GPU. Textures are sorted into five classes by size, each stored in one array
// image, because not every device can index textures freely.

#include <array>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "gpu/resources.hpp"
#include "shaders/scene.glsl.h"
#include "techniques/surface/shade.glsl.h"
#include "techniques/surface/surface.hpp"

namespace estampe::surface {

inline constexpr std::array<uint32_t, 5> texture_class_px{256, 512, 1024, 2048, 4096};

struct MaterialBuffers {
    std::vector<shared::MaterialRecord> records; ///< one record per material, then the ground's record
    std::vector<shared::ShadeRecord> shades;     ///< result of shade_records()
    gpu::Buffer materials;                       ///< copy of `records` on the device
    std::array<gpu::Image, 5> textures;
};

/// The array layer of each texture of `scene` that a colour, shade, normal or occlusion uses; `layers` lists
/// textures by size class.
struct TexturePlan {
    /// Per texture: size class in bits 0-3, layer in 4-23; no_texture if unused.
    std::vector<uint32_t> location;
    std::array<std::vector<Index>, 5> layers;
    uint32_t reduced = 0;  ///< number of textures stored in a class below their size
    uint32_t left_out = 0; ///< number of textures for which no layer was free
};

/// Assigns textures to classes of sizes. When a class already has `most_layers`, a texture goes to the next
/// smaller class with room, else to a larger one.
[[nodiscard]] TexturePlan plan_textures(const Scene& scene, uint32_t most_layers);

/// Shader features that the materials and meshes of `scene` need.
[[nodiscard]] SceneNeeds scene_needs(const Scene& scene, const TexturePlan& plan);

/// The records of all materials, then one for the ground.
[[nodiscard]] std::vector<shared::MaterialRecord> material_records(const Scene& scene,
                                                                   const TexturePlan& plan);

/// Colours in the shade, one record per material; a record without flags for a material that has no shade
/// texture. Empty if no material has one.
[[nodiscard]] std::vector<shared::ShadeRecord> shade_records(const Scene& scene, const TexturePlan& plan);

/// Mean linear colour of a picture, over about four thousand texels; transparent texels do not count.
[[nodiscard]] glm::vec3 mean_color(const Image& image);

/// Uploads pictures as the layers of one array image, each resized to the size class of the largest picture,
/// with all mip levels. Throws Error when memory runs out, or when there are more pictures than the device
/// has layers. Cost: as upload_materials().
[[nodiscard]] gpu::Image upload_pictures(gpu::Device& device, std::vector<Image> pictures);

/// Uploads materials, and textures resized to the size of their class with all mip levels. `plan` must
/// respect the layer limit of `device`. Throws Error when memory runs out. Cost: about 30 ms for a texture of
/// 2048 x 2048 texels, on two threads.
[[nodiscard]] MaterialBuffers upload_materials(gpu::Device& device, const Scene& scene,
                                               const TexturePlan& plan);

/// Sets the linear colour of a material without textures. Cost: an upload of all records.
void recolor(gpu::Device& device, MaterialBuffers& buffers, Index material, const glm::vec3& color);

/// Messages to the user about reduced or omitted textures, one line each.
[[nodiscard]] std::vector<std::string> notes_of(const TexturePlan& plan);

/// Imports the texture arrays of all size classes into a graph.
[[nodiscard]] std::array<gpu::ImageId, 5> import_textures(gpu::Graph& graph, MaterialBuffers& materials);

} // namespace estampe::surface
