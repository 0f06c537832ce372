// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "style/parameter.hpp"
#include "style/wind.hpp"

namespace estampe::smoke {

/// Positions of the samples of smoke along view rays.
enum class Sampling : uint8_t {
    rays, ///< equal steps from the ray's entry into the box, with random offsets
    axis, ///< planes of the grid, across the main axis of the view
    view  ///< planes that face the eye
};

/// Pressure solver of the smoke's fluid simulation.
enum class Solver : uint8_t { automatic, spectral, multigrid, jacobi, mass };
enum class Advection : uint8_t { automatic, linear, cubic, maccormack };
enum class Stepping : uint8_t { project, reflect };

enum class Medium : uint8_t { wash, strokes, both };

struct SmokeStyle {
    bool enabled = false;
    std::string objects = "smoke*";
    uint32_t cells = 64;
    float age_s = 5.0F;
    float source = 0.24F;
    float amount_per_s = 6.0F;
    float rise_s = 3.0F;
    float wind_m_per_s = 0.0F;
    wind::Wind wind; ///< wind of the scene's section [wind]; the smoke's section has no key for it
    float curl = 1.0F;
    bool obstacles = false;
    Solver solver = Solver::automatic;
    uint32_t jacobi_passes = 80;
    Advection advection = Advection::automatic;
    Stepping stepping = Stepping::project;
    float life_s = 4.0F;
    float fuel_per_s = 0.0F;
    float burn_s = 0.4F;
    float burn_heat = 1.0F;
    float soot = 0.5F;
    float explodes_above = 0.0F;
    float explosion_per_s = 12.0F;
    float blast_at_s = -1.0F;
    float blast_heat = 40.0F;
    float humidity = 0.0F;
    float cloud_base = 0.4F;
    float humidity_outside = 0.7F;
    float latent_heat = 1.0F;
    float thickness = 6.0F;
    bool puffs = true;
    float puff = 0.16F;
    Sampling sampling = Sampling::rays;
    float step = 0.7F;
    float scatter = 0.0F;
    float edge = 0.5F;
    Medium medium = Medium::both;
    glm::vec3 color = style::srgb(0xffffff);
    glm::vec3 shade_color = style::srgb(0xd5d6d3);
    glm::vec3 deep_color = style::srgb(0xa2a6a8);
    float opacity = 1.0F;
    float shade_below = 0.42F;
    float deep_below = 0.18F;
    float form = 0.75F;
    float line_mm = 0.4F;
    float stroke_mm = 0.22F;
    float darkness = 0.4F;
    bool shaded = true;
    float shadow = 1.0F;
    float glow = 0.0F;
    glm::vec3 glow_color = style::srgb(0xffb060);
    float flame = 1.0F;
    glm::vec3 flame_color = style::srgb(0xffe2a0);
    int seed = 1;
};

/// Whether the smoke contains fuel that burns.
[[nodiscard]] inline bool is_burning(const SmokeStyle& style)
{
    return style.fuel_per_s > 0.0F;
}

/// Whether hot air expands.
[[nodiscard]] inline bool is_explosive(const SmokeStyle& style)
{
    return style.explodes_above > 0.0F;
}

/// Whether a blast goes off at `blast_at_s`, with air that is hot enough to expand.
[[nodiscard]] inline bool is_blasting(const SmokeStyle& style)
{
    return is_explosive(style) && style.blast_at_s >= 0.0F && style.blast_heat > style.explodes_above;
}

[[nodiscard]] inline bool is_moist(const SmokeStyle& style)
{
    return style.humidity > 0.0F;
}

[[nodiscard]] const style::Table<SmokeStyle>& smoke_table();

} // namespace estampe::smoke
