// SPDX-License-Identifier: MIT
#pragma once

// Bakes lightmaps: computes on the CPU the light that surfaces reflect onto each other. Link the CMake
// target estampe::bake, which exists if ESTAMPE_BAKE is on, and requires Embree and TBB.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>

namespace estampe {

/// Resolution, quality and content of a baked lightmap.
struct BakeSettings {
    uint32_t size = 1024;   ///< Texels per side of the map, 16 to 4096
    uint32_t samples = 128; ///< Light paths traced from each texel; at least 1
    uint32_t bounces = 3;   ///< Largest number of reflections in one light path
    uint32_t seed = 1;      ///< Seed of the random numbers; another seed gives different noise
    bool smooth = true; ///< Denoises the map; each texel is averaged with neighbouring texels of its surface
    /// Kinds of lights, as bits of BakedLights; their direct light is also stored in the map.
    uint32_t direct = 0;
    float sky = 1.0F; ///< Factor on the ambient light that the style sets; 0 or more
};

/// Progressive baking of one lightmap.
///
/// A bake uses the lights with which a picture of the scene is drawn in this style: the scene's own lights,
/// or the default sun or lamp if the scene has no lights. Ambient light comes from the sky, and objects can
/// block it. Surfaces reflect light diffusely, in the colour of their material. Movable objects and masked or
/// see-through triangles are left out.
///
/// Each texel holds irradiance over pi on the front of the surface (the side of its normals). It contains
/// light that arrives after at most `bounces` reflections, and direct light from the sky, from emissive
/// materials and from lights of the kinds in BakeSettings::direct. The same scene, style and settings give
/// the same bytes, for any number of threads and of calls of work().
///
/// Source  Kajiya, "The Rendering Equation", 1986; Veach and Guibas, "Optimally Combining Sampling Techniques
///         for Monte Carlo Rendering", 1995
class LightmapBake {
public:
    /// Cuts the surface into charts, packs them into the map, and builds the ray tracing structure. Throws
    /// Error if no triangle that receives light is static, if the charts do not fit into the map, or if the
    /// style names lights or objects that do not exist. Cost: about 3 us per triangle and 0.1 us per texel.
    LightmapBake(Scene scene, const Style& style, const BakeSettings& settings = {});
    ~LightmapBake();
    LightmapBake(LightmapBake&&) noexcept;
    LightmapBake& operator=(LightmapBake&&) noexcept;
    LightmapBake(const LightmapBake&) = delete;
    LightmapBake& operator=(const LightmapBake&) = delete;

    /// Bakes for about `seconds` on all cores. Returns whether the bake needs more work.
    bool work(double seconds);

    /// Share of the bake's work that is done, 0 to 1.
    [[nodiscard]] double done() const;

    /// Continues from progress that save_progress() wrote to `path`. Returns false and changes nothing if the
    /// file does not exist, or if it was written for another scene, lighting or settings.
    [[nodiscard]] bool load_progress(const std::filesystem::path& path);

    /// Saves the progress of the bake, so that load_progress() can continue it later. Writes a temporary file
    /// beside `path` and renames it. Throws Error if the file cannot be written.
    void save_progress(const std::filesystem::path& path) const;

    /// The lightmap as baked so far, for Renderer::set_scene() and save_lightmap().
    [[nodiscard]] Lightmap map() const;

    /// Number of texels that are covered by surfaces.
    [[nodiscard]] size_t texel_count() const;
    /// Resolution of the lightmap on the surfaces, in texels per metre.
    [[nodiscard]] float texels_per_m() const;

    /// Returns whether movable objects were left out of the lightmap, because their light is not baked.
    [[nodiscard]] bool leaves_out_moving() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe
