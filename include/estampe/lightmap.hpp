// SPDX-License-Identifier: MIT
#pragma once

// Light worked out ahead: what `estampe bake` makes and a renderer adds to the light that it finds itself.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace estampe {

/// A picture of linear light, Rec. 709: rows from top to bottom.
struct LightImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::vec3> texels; ///< width * height

    [[nodiscard]] bool empty() const noexcept { return texels.empty(); }

    bool operator==(const LightImage&) const = default;
};

/// Kinds of light, as bits.
enum BakedLights : uint32_t { baked_directional = 1, baked_point = 2, baked_spot = 4 };

/// A picture of light that a scene's file lays on a mesh, by a UV set of that mesh.
struct WornPicture {
    uint32_t picture = 0; ///< into Lightmap::pictures
    uint32_t uv_set = 1;
    float intensity = 1.0F; ///< the picture is multiplied by this

    bool operator==(const WornPicture&) const = default;
};

/// Light on the still triangles of one scene, and where each of them lies in the picture; or pictures that
/// the scene's file names itself.
struct Lightmap {
    LightImage light;               ///< irradiance over pi, at the exposure below
    std::vector<glm::vec2> corners; ///< three a still triangle of the scene, 0 to 1 from the top left
    std::string geometry;           ///< which scene it is for: a fingerprint of its still triangles
    float exposure = 1.0F;          ///< what the scene's lights were multiplied by
    uint32_t baked_lights = 0;      ///< lights that are in the map themselves; a renderer leaves these out
    std::string settings;           ///< how it was made, in words

    /// Not empty: these are worn, and nothing above counts. Linear light as it is to be seen, 1 for white,
    /// whatever the exposure of the lights.
    std::vector<LightImage> pictures;
    std::vector<std::optional<WornPicture>> of_node;     ///< one a node, its parents' word counted
    std::vector<std::optional<WornPicture>> of_material; ///< where the node says nothing
    std::optional<WornPicture> of_scene;                 ///< where neither does

    bool operator==(const Lightmap&) const = default;
};

/// Writes an OpenEXR picture in half floats that any program for HDR pictures opens; the rest of the map is
/// in its header. Beside `path` first, then renamed. Throws Error when it cannot be written.
void save_lightmap(const Lightmap& map, const std::filesystem::path& path);

/// The lightmaps that a glTF file names itself, if it does: `lightmap` in the "estampe" object of the
/// `extras` of a node (for itself and what is below it), a material or the scene, or MOZ_lightmap of a
/// material:
///
///     "extras": {"estampe": {"lightmap": {"uri": "room.png", "texCoord": 1, "intensity": 1.0}}}
///     "extras": {"estampe": {"lightmap": {"texture": 3}}}
///     "extensions": {"MOZ_lightmap": {"index": 3, "texCoord": 1, "intensity": 1.0}}
///
/// A uri stands beside the file or is embedded; pictures are OpenEXR (linear) or PNG, JPEG, WebP (sRGB). The
/// scene may name a map of `estampe bake` instead, and nothing else a map then. UVs count as they are,
/// without KHR_texture_transform. Keys and values that are not understood are left out, and load_scene()
/// warns of them. Throws Error naming file and JSON pointer when what is named is missing or cannot be read.
/// Cost: reads the file once more, and decodes what is in it only where maps are named.
[[nodiscard]] std::optional<Lightmap> named_lightmap(const std::filesystem::path& scene_file);

/// Reads what save_lightmap() writes. Throws Error naming the file when it is missing, damaged, or an OpenEXR
/// picture that is no map.
[[nodiscard]] Lightmap load_lightmap(const std::filesystem::path& path);

} // namespace estampe
