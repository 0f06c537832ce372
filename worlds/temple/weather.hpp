// SPDX-License-Identifier: MIT
#pragma once

// The temple's weather and its time of day, as a line of time that chance lays out: one wind for sand, flags
// and ink, gusts, storms of sand that rise, close the view and pass, tornadoes that walk by, clouds, and a
// sun that goes on. And what the wind carries: sand over the ground and in storms, and a tornado's trunk.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

namespace temple {

/// What it may be told to be like, for as long as one looks.
enum class WeatherKind : uint8_t { calm, gusts, storm, tornado };

/// The kind of that name; nothing for another.
[[nodiscard]] std::optional<WeatherKind> weather_named(std::string_view name);

/// All names that weather_named() takes.
[[nodiscard]] std::vector<std::string> weather_names();

/// A tornado on its way.
struct Tornado {
    glm::vec2 foot_m{0.0F};
    float strength = 0.0F; ///< 0 there is none, to 1
};

/// The weather at a moment.
struct Weather {
    float wind_m_s = 7.0F;
    double blown_m = 0.0; ///< how far the wind has blown since the beginning
    float gusts = 0.0F;   ///< 0 to 1
    float dust = 0.0F;    ///< in the air: 0 to 1, where one sees no farther than a room is long
    float clouds = 0.0F;  ///< share of the sky
    Tornado tornado;
    std::optional<float> hour; ///< of the sun; nothing: it stands as the scene has it
};

inline constexpr float wind_to_deg = 200.0F; ///< where it blows to, always: 0 is +x, 90 is +z
inline constexpr float calm_m_s = 7.0F;
inline constexpr float strongest_m_s = 19.0F;

/// Unit: where the wind blows to, along x and z.
[[nodiscard]] glm::vec2 wind_way();

/// What was asked for.
struct WeatherChoice {
    std::optional<WeatherKind> kind; ///< nothing: it changes
    std::optional<float> hour;       ///< where the sun stands; nothing: it goes on, or stands in stills
    float hours_a_minute = 0.0F;     ///< that the sun goes on, from the hour or from the scene's own
};

/// All weather of a temple. Each moment is worked out by itself: it is the same whatever was asked before.
class WeatherTimeline {
public:
    static constexpr double rises_s = 9.0; ///< a storm
    static constexpr double holds_s = 9.0;
    static constexpr double passes_s = 11.0;
    static constexpr double between_s = 75.0;    ///< from the middle of one to that of the next, about
    static constexpr double sun_steps_a_s = 6.0; ///< in which the hour goes on

    WeatherTimeline(uint64_t seed, WeatherChoice choice) : seed_(seed), choice_(choice) {}

    /// Cost: a few hundred sums.
    [[nodiscard]] Weather at(double time_s) const;

private:
    [[nodiscard]] double storm_s(int64_t number) const;
    [[nodiscard]] float dust_at(double time_s) const;
    [[nodiscard]] float gusts_at(double time_s) const;
    [[nodiscard]] double wind_at(double time_s) const;
    [[nodiscard]] Tornado tornado_at(double time_s) const;

    uint64_t seed_;
    WeatherChoice choice_;
};

/// Adds `sand N`, `whirl N` and `murk N`, which give particles, and `eddy N`, which turns ink; all of
/// no size until they are moved; and the funnel of a tornado.
void add_air(estampe::Scene& scene);

/// Who is in it.
struct AirView {
    glm::dvec3 eye_m{0.0};
    double time_s = 0.0;
    std::function<float(const glm::vec2&)> ground_m;
    std::function<bool(const glm::vec2&)> is_roofed; ///< no sand rises there
};

/// Where they are in a weather, for Renderer::place(); `first` is the scene's node `sand 0`. Those that give
/// nothing have no size.
[[nodiscard]] std::vector<estampe::NodePlace> air_places(estampe::Index first, const Weather& weather,
                                                         const AirView& view);

} // namespace temple
