// SPDX-License-Identifier: MIT
#pragma once

// Works out ahead the light that surfaces throw on each other, on the processor. In CMake estampe::bake,
// which is there where ESTAMPE_BAKE is on, and needs Embree and TBB.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>

namespace estampe {

/// How a map is made, and what of the light is in it.
struct BakeSettings {
    uint32_t size = 1024;   ///< texels a side, 16 to 4096
    uint32_t samples = 128; ///< paths of light that are followed from each texel; 1 and more
    uint32_t bounces = 3;   ///< surfaces that light may be thrown off on its way
    uint32_t seed = 1;      ///< another number gives other noise
    bool smooth = true;     ///< takes noise out where neighbours on a surface agree
    uint32_t direct = 0;    ///< kinds of lights whose own light is in the map too, see BakedLights
    float sky = 1.0F;       ///< the style's ambient light is multiplied by this; 0 and more
};

/// One lightmap in the making.
///
/// The lights are those that a picture of the scene in this style has: the scene's, or the sun or the lamp
/// that it would get, and the ambient light as a sky that things hide. What throws light on is of the colour
/// of its material, alike to all sides. What can move is left out, and so are masked and see-through
/// triangles.
///
/// The map holds what arrives at each texel after at most `bounces` surfaces, and at once from the sky,
/// glowing materials and lights of the kinds asked for: irradiance over pi, on the side that the normals
/// point to. The same scene, style and settings give the same bytes, however often and by how many threads it
/// is worked on.
///
/// Source  Kajiya, "The Rendering Equation", 1986; Veach and Guibas, "Optimally Combining Sampling Techniques
///         for Monte Carlo Rendering", 1995
class LightmapBake {
public:
    /// Cuts the surface into charts, packs them, and builds what rays need. Throws Error when no triangle
    /// that takes light stands still, when charts do not fit, and when the style names lights or objects that
    /// are not there. Cost: about 3 us a triangle and 0.1 us a texel.
    LightmapBake(Scene scene, const Style& style, const BakeSettings& settings = {});
    ~LightmapBake();
    LightmapBake(LightmapBake&&) noexcept;
    LightmapBake& operator=(LightmapBake&&) noexcept;
    LightmapBake(const LightmapBake&) = delete;
    LightmapBake& operator=(const LightmapBake&) = delete;

    /// Works for about `seconds` on all cores; returns whether there is more to do.
    bool work(double seconds);

    /// Share of the work that is done, 0 to 1.
    [[nodiscard]] double done() const;

    /// Takes up work that save_progress() wrote; false, and nothing taken, where `path` holds none of this
    /// scene, this light and these settings.
    [[nodiscard]] bool load_progress(const std::filesystem::path& path);

    /// Writes beside `path` first and renames. Throws Error when that cannot be.
    void save_progress(const std::filesystem::path& path) const;

    /// The map of what has been done so far, for Renderer::set_scene() and save_lightmap().
    [[nodiscard]] Lightmap map() const;

    /// Texels that surfaces lie on.
    [[nodiscard]] size_t texel_count() const;
    [[nodiscard]] float texels_per_m() const;

    /// Whether something was left out because it can move.
    [[nodiscard]] bool leaves_out_moving() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe
