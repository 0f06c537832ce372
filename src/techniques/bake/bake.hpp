// SPDX-License-Identifier: MIT
#pragma once

// Bakes a lightmap of static meshes on the CPU, by path tracing from each texel of the map.

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

/// A lamp for baking, to which shadow rays are traced, in space relative to StaticTriangles::anchor. The
/// lamp's colour is the irradiance divided by pi on a surface that faces the lamp: at any distance
/// (directional), at one metre, or next to the lamp (unit volume).
struct Lamp {
    LampKind kind = LampKind::directional;
    glm::vec3 position{0.0F};
    /// Direction towards a directional light; along the beam of a spot.
    glm::vec3 direction{0.0F, 1.0F, 0.0F};
    glm::vec3 color{1.0F};
    float range_m = 0.0F; ///< range of the lamp; 0: unlimited
    /// For spots: the cone's factor is saturate(cos(angle) * scale + offset) squared.
    float cone_scale = 0.0F;
    float cone_offset = 1.0F;
    /// For pyramid-shaped spots: a unit vector at a right angle to the beam, across two of the four sides.
    glm::vec3 side{1.0F, 0.0F, 0.0F};
    /// The light falls off with 1 - (distance / range)^2, not with the inverse square.
    bool unit_volume = false;
    Groups groups = all_groups; ///< object groups that the lamp lights
    /// Object groups: only an object that casts shadows for one of them blocks the lamp.
    Groups casters = all_groups;
    bool baked = false; ///< true: the lightmap holds direct and bounced light; false: bounced light only
};

struct BakeSettings {
    uint32_t size = 1024;   ///< texels per side of the lightmap, 16 to 4096
    uint32_t samples = 128; ///< number of light paths per texel
    uint32_t bounces = 3;   ///< most surfaces that reflect the light of a path
    uint32_t seed = 1;
    glm::vec3 sky{0.0F};    ///< radiance of the sky, above the horizon
    glm::vec3 ground{0.0F}; ///< radiance of the surroundings below the horizon
    std::vector<Lamp> lamps;
    float exposure = 1.0F; ///< exposure of the lamps, recorded in the lightmap
    bool smooth = true;    ///< removes noise between neighbour texels on one surface
};

/// One lightmap while it is computed.
///
/// Surfaces reflect the light of lamps, sky and glowing materials as two-sided Lambertian reflectors in the
/// colour of their materials; masked and transparent triangles let rays pass. The map holds the irradiance
/// over pi that reaches each texel after at most `bounces` surfaces, on the side that the normals point to.
/// Sky, glowing materials and baked lamps also contribute their direct light.
///
/// Source  Kajiya, "The Rendering Equation", 1986; Veach and Guibas, "Optimally Combining Sampling Techniques
///         for Monte Carlo Rendering", 1995; Talbot et al., "Importance Resampling for Global Illumination",
///         2005 (the choice of a lamp); rays by Embree.
class Bake {
public:
    /// Starts a bake: cuts and packs charts, and builds the ray acceleration structure. `scene` must outlive
    /// the bake. Throws Error if no static triangle receives light, or if the charts do not fit. Cost: about
    /// 3 us per triangle and 0.1 us per texel.
    Bake(const Scene& scene, const BakeSettings& settings);
    ~Bake();
    Bake(const Bake&) = delete;
    Bake& operator=(const Bake&) = delete;

    /// Works on the lightmap for about `seconds` on all cores; returns whether work is left. The result is
    /// bit-identical for any number of calls and of threads.
    bool work(double seconds);

    /// Share of the bake's work that is done, 0 to 1.
    [[nodiscard]] double done() const;

    /// Resumes a bake that save_progress() stored. Returns false and changes nothing if `path` holds no
    /// progress of the bake's scene with the bake's settings.
    [[nodiscard]] bool load_progress(const std::filesystem::path& path);

    /// Stores the unfinished bake, replacing the file at `path` atomically. Throws Error.
    void save_progress(const std::filesystem::path& path) const;

    /// The lightmap from the work done so far, filtered, and extended into the gaps between charts.
    [[nodiscard]] Lightmap map() const;

    [[nodiscard]] size_t texel_count() const;
    [[nodiscard]] float texels_per_m() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace estampe::bake
