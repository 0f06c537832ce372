// SPDX-License-Identifier: MIT
#pragma once

// Light worked out ahead: what `estampe bake` makes and a renderer adds to the light that it finds itself.

#include <cstdint>
#include <filesystem>
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

/// Light on the still triangles of one scene, and where each of them lies in the picture.
struct Lightmap {
    LightImage light;               ///< irradiance over pi, at the exposure below
    std::vector<glm::vec2> corners; ///< three a still triangle of the scene, 0 to 1 from the top left
    std::string geometry;           ///< which scene it is for: a fingerprint of its still triangles
    float exposure = 1.0F;          ///< what the scene's lights were multiplied by
    uint32_t baked_lights = 0;      ///< lights that are in the map themselves; a renderer leaves these out
    std::string settings;           ///< how it was made, in words
    bool operator==(const Lightmap&) const = default;
};

/// Writes an OpenEXR picture in half floats that any program for HDR pictures opens; the rest of the map is
/// in its header. Beside `path` first, then renamed. Throws Error when it cannot be written.
void save_lightmap(const Lightmap& map, const std::filesystem::path& path);

/// Reads what save_lightmap() writes. Throws Error naming the file when it is missing, damaged, or an OpenEXR
/// picture that is no map.
[[nodiscard]] Lightmap load_lightmap(const std::filesystem::path& path);

} // namespace estampe
