// SPDX-License-Identifier: MIT
#pragma once

// Lightmaps: baked light that `estampe bake` or another program made, and that a renderer adds to its own
// lighting.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/read_scope.hpp>

namespace estampe {

/// An image of linear light, Rec. 709 primaries: rows from top to bottom.
struct LightImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::vec3> texels; ///< Linear colours of the image, width * height values

    [[nodiscard]] bool empty() const noexcept { return texels.empty(); }

    bool operator==(const LightImage&) const = default;
};

/// Bits for the kinds of lights whose direct light a lightmap contains.
enum BakedLights : uint32_t { baked_directional = 1, baked_point = 2, baked_spot = 4 };

/// A lightmap picture that the scene's file assigns to a mesh, and the UV set that places the picture on the
/// mesh.
struct WornPicture {
    uint32_t picture = 0; ///< Index of the picture in Lightmap::pictures
    uint32_t uv_set = 1;
    float intensity = 1.0F; ///< Factor on the colours of the lightmap picture

    bool operator==(const WornPicture&) const = default;
};

/// Baked light: either one map for the static triangles of a scene, with the texture coordinates of the map,
/// or the pictures that the scene's file itself assigns to meshes.
struct Lightmap {
    LightImage light; ///< Light of each texel, stored as irradiance over pi, multiplied by `exposure`
    /// Texture coordinates in the map for the corners of the static triangles, three per triangle: 0 to 1,
    /// from the top left.
    std::vector<glm::vec2> corners;
    /// Hash of the scene's static triangles. A renderer uses the hash to check that the map belongs to the
    /// scene.
    std::string geometry;
    float exposure = 1.0F; ///< Factor on the intensity of the scene's lights when the map was baked
    /// Kinds of lights whose direct light is already in the map, as bits of BakedLights. A renderer does not
    /// add direct light that is already in the lightmap a second time.
    uint32_t baked_lights = 0;
    std::string settings; ///< Settings of the bake as text

    /// Lightmap pictures that the scene's file assigns to meshes. If there are any, the baked map's members
    /// `light` to `settings` are ignored. The pictures hold linear light as displayed, where 1 is white,
    /// regardless of the exposure of the lights.
    std::vector<LightImage> pictures;
    /// For each node of the scene: its lightmap picture, or the picture that the node inherits from its
    /// parents.
    std::vector<std::optional<WornPicture>> of_node;
    /// For each material of the scene: its lightmap picture; only used if the node has no lightmap picture.
    std::vector<std::optional<WornPicture>> of_material;
    /// Lightmap picture of the whole scene; used if neither the node nor the material has one.
    std::optional<WornPicture> of_scene;

    bool operator==(const Lightmap&) const = default;
};

/// Writes a baked lightmap as an OpenEXR picture in half floats, which any HDR program opens. The header of
/// the OpenEXR file holds the map's texture coordinates and settings. The file is written beside `path` and
/// renamed. Throws Error if the file cannot be written.
void save_lightmap(const Lightmap& map, const std::filesystem::path& path);

/// Reads the lightmaps that a glTF file refers to; empty if it refers to none. A lightmap is given by
/// `lightmap` in the "estampe" object of the `extras` of a node (for that node and its descendants), a
/// material or the scene, or by MOZ_lightmap of a material:
///
///     "extras": {"estampe": {"lightmap": {"uri": "room.png", "texCoord": 1, "intensity": 1.0}}}
///     "extras": {"estampe": {"lightmap": {"texture": 3}}}
///     "extensions": {"MOZ_lightmap": {"index": 3, "texCoord": 1, "intensity": 1.0}}
///
/// A uri is relative to the file, or a data uri. Pictures are OpenEXR (linear) or PNG, JPEG, WebP (sRGB).
/// Instead of pictures per node or material, the scene may name one map made by `estampe bake`. No node or
/// material may then name a lightmap. KHR_texture_transform is not applied to the UVs. Unknown keys and
/// values are ignored, and load_scene() warns of unknown keys. Throws Error with file and JSON pointer if a
/// picture is missing, unreadable or outside of `scope`, or if a baked map is named beside other lightmaps.
/// Cost: reads the file once more, and decodes it only if it names lightmaps.
[[nodiscard]] std::optional<Lightmap> named_lightmap(const std::filesystem::path& scene_file,
                                                     const ReadScope& scope = {});

/// Reads a lightmap file that save_lightmap() wrote. Throws Error that names the file if the file is missing
/// or damaged, lies outside of `scope`, or is an OpenEXR picture without a lightmap.
[[nodiscard]] Lightmap load_lightmap(const std::filesystem::path& path, const ReadScope& scope = {});

} // namespace estampe
