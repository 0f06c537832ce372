// SPDX-License-Identifier: MIT
#pragma once

// Light on what never moves, worked out on the processor by following paths from each texel of a map.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>

namespace estampe::bake {

enum class LampKind : uint8_t { directional, point, spot, pyramid };

/// A light that throws its own rays, in space relative to StaticTriangles::anchor. Its colour is what a
/// surface that faces it gets, as irradiance over pi: at any distance (directional), at one metre, or beside
/// the lamp (unit volume).
struct Lamp {
    LampKind kind = LampKind::directional;
    glm::vec3 position{0.0F};
    glm::vec3 direction{0.0F, 1.0F, 0.0F}; ///< towards a directional light; along a spot's beam
    glm::vec3 color{1.0F};
    float range_m = 0.0F;    ///< 0: unlimited
    float cone_scale = 0.0F; ///< spots: saturate(cos(angle) * scale + offset) squared
    float cone_offset = 1.0F;
    glm::vec3 side{1.0F, 0.0F, 0.0F}; ///< pyramids: unit, square to the beam, across two of the four sides
    bool unit_volume = false;         ///< weakens by 1 - (d / range)^2, not by the square of the distance
    Groups groups = all_groups;       ///< lights what is lit by one of them
    Groups casters = all_groups;      ///< blocked by what throws shadows for one of them
    bool baked = false; ///< whether its own light is in the map, beside what it throws off other surfaces
};

struct BakeSettings {
    uint32_t size = 1024;   ///< texels a side, 16 to 4096
    uint32_t samples = 128; ///< paths a texel
    uint32_t bounces = 3;   ///< surfaces that light may be thrown off on its way
    uint32_t seed = 1;
    glm::vec3 sky{0.0F};    ///< radiance from above the horizon
    glm::vec3 ground{0.0F}; ///< and from below
    std::vector<Lamp> lamps;
    float exposure = 1.0F; ///< of the lamps, noted in the map
    bool smooth = true;    ///< takes noise out where neighbours on a surface agree
};

/// One map in the making.
///
/// Light of the lamps, of the sky and of glowing materials is thrown off surfaces in the colour of their
/// materials, alike to all sides and from both; masked and see-through triangles let rays pass. The map holds
/// what arrives at each texel after at most `bounces` surfaces (and at once, from sky, glowing materials and
/// baked lamps), as irradiance over pi, on the side that the normals point to.
///
/// Source  Kajiya, "The Rendering Equation", 1986; Veach and Guibas, "Optimally Combining Sampling
///         Techniques for Monte Carlo Rendering", 1995; Talbot et al., "Importance Resampling for Global
///         Illumination", 2005 (the choice of a lamp); rays by Embree.
class Bake {
public:
    /// Cuts and packs charts, and builds what rays need. `scene` must outlive the bake. Throws Error when no
    /// triangle that takes light stands still, or charts do not fit. Cost: about 3 us a triangle and 0.1 us
    /// a texel.
    Bake(const Scene& scene, const BakeSettings& settings);
    ~Bake();
    Bake(const Bake&) = delete;
    Bake& operator=(const Bake&) = delete;

    /// Works for about `seconds` on all cores; returns whether there is more to do. How often it is called,
    /// and by how many threads the work is done, changes no bit of the map.
    bool work(double seconds);

    /// Share of the work that is done.
    [[nodiscard]] double done() const;

    /// Takes up work that save_progress() wrote; false, and nothing taken, where `path` holds none of this
    /// scene and these settings.
    [[nodiscard]] bool load_progress(const std::filesystem::path& path);

    /// Writes beside `path` first and renames. Throws Error.
    void save_progress(const std::filesystem::path& path) const;

    /// The map of what has been done so far, filtered, and spread into the gaps between charts.
    [[nodiscard]] Lightmap map() const;

    [[nodiscard]] size_t texel_count() const;
    [[nodiscard]] float texels_per_m() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace estampe::bake
