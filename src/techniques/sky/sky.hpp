// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "gpu/graph/graph.hpp"
#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::sky {

enum class SkyFollow : uint8_t { automatic, sun, none };

struct SkyStyle {
    style::AutoToggle enabled = style::AutoToggle::automatic;
    glm::vec3 horizon = style::srgb(0xf0dca2);
    glm::vec3 zenith = style::srgb(0x5f9a92);
    float darkness = 0.22F;
    float width_mm = 0.34F;
    float halo_mm = 4.0F;
    SkyFollow follow = SkyFollow::automatic;
    glm::vec3 noon_horizon = style::srgb(0xf4eed6);
    glm::vec3 noon_zenith = style::srgb(0x78aebd);
    glm::vec3 dusk_horizon = style::srgb(0xe3a06f);
    glm::vec3 dusk_zenith = style::srgb(0x4d6b80);
    glm::vec3 night_horizon = style::srgb(0x4a5c74);
    glm::vec3 night_zenith = style::srgb(0x1d2740);
    float night_darkness = 0.5F;
    int steps = 0;
    glm::vec3 high_band = style::srgb(0x1f3f6e);
    float high_band_deg = 90.0F;
    glm::vec3 low_band = style::srgb(0xd98a5f);
    float low_band_deg = 0.0F;
    float disc_deg = 0.0F;
    glm::vec3 sun_color = style::srgb(0xc8452f);
    glm::vec3 moon_color = style::srgb(0xf6efd6);
    float moon_lit = 1.0F;
};

[[nodiscard]] const style::Table<SkyStyle>& sky_table();

struct SkyInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    gpu::ImageId depth;  ///< r32f: reversed depth (1 at the near plane), 0 for the background
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    std::optional<float> daylight_rad; ///< elevation of the sun; only set if the style's `sun.by` is place
    float pixels_per_mm = 1.0F;
    bool drawn = false;
    /// Distances on the page to things, see techniques/halo; if set, strokes thin out around things.
    std::optional<gpu::ImageId> halo;
    glm::uvec2 size_px{0};
    /// If set, paints the sky only in the listed tiles of the page; the list comes from
    /// surface::add_far_tiles(). All other tiles stay blank.
    std::optional<gpu::BufferId> tiles;
    /// If set, leaves a pixel blank if its visible surface is nearer to the eye than `far_m`.
    std::optional<float> far_m;
};

struct Sky {
    gpu::ImageId wash; ///< rgba16f: transmittance of the sky's paint
    gpu::ImageId ink;  ///< r16f: coverage by the sky's strokes, 0 to 1
};

/// The colours of the sky at a time of day.
struct SkyColors {
    glm::vec3 horizon{0.0F};
    glm::vec3 zenith{0.0F};
    float darkness = 0.0F; ///< darkness of the sky's strokes at the zenith
};

/// Returns the sky's colours for a direction of the sun. If the style's sky does not follow the sun, the
/// colours are constant.
[[nodiscard]] SkyColors colors_under(const SkyStyle& style, const glm::vec3& towards_sun,
                                     const std::optional<float>& daylight_rad);

/// Returns the sun's elevation from which the sky's colours are computed, in radians. Returns none if the
/// style keeps the colours fixed.
[[nodiscard]] std::optional<double> followed_elevation_rad(const SkyStyle& style,
                                                           const glm::vec3& towards_sun,
                                                           const std::optional<float>& daylight_rad);

/// Returns the sky's colours at an elevation of the sun. Below -10 degrees it is night, and at -2 degrees
/// dusk. From 4 to 12 degrees, the colours are the style's horizon and zenith colours. From 40 degrees on it
/// is noon. The transitions are smooth.
[[nodiscard]] SkyColors colors_at(const SkyStyle& style, double sun_elevation_rad);

/// Paints the sky of the page. Returns blank images of one texel if the style draws no sky. Cost: one
/// dispatch over the page or a list of tiles; next to nothing without a sky.
[[nodiscard]] Sky add_sky(gpu::Graph& graph, const SkyInputs& in, const SkyStyle& style);

} // namespace estampe::sky
