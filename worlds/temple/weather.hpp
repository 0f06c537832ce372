// SPDX-License-Identifier: MIT
#pragma once

// The temple's weather and time of day, as a random timeline: wind, gusts, sandstorms, tornadoes, clouds and
// a moving sun. The wind moves sand, flags and ink alike. The file also declares the nodes that the wind
// moves: emitters of sand, and the funnel of a tornado.

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

/// A kind of weather that a user may choose; the weather then stays of this kind.
enum class WeatherKind : uint8_t { calm, gusts, storm, tornado };

/// Returns the kind of weather with that name; nothing for an unknown name.
[[nodiscard]] std::optional<WeatherKind> weather_named(std::string_view name);

/// Returns all names that weather_named() accepts.
[[nodiscard]] std::vector<std::string> weather_names();

/// State of a tornado at one time.
struct Tornado {
    glm::vec2 foot_m{0.0F};
    float strength = 0.0F; ///< Strength of the tornado, 0 to 1; 0: there is no tornado
};

/// The temple's weather at one time.
struct Weather {
    float wind_m_per_s = 7.0F;
    double blown_m = 0.0; ///< Distance that the wind has blown since time 0
    float gusts = 0.0F;   ///< Strength of the gusts, 0 to 1
    float dust = 0.0F; ///< Dust in the air, 0 to 1; at 1 the view reaches only as far as the length of a room
    float clouds = 0.0F; ///< Share of the sky that clouds cover
    Tornado tornado;
    /// Hour of the day from which the sun's position follows; nothing: the sun of the scene.
    std::optional<float> hour;
};

/// Direction towards which the wind always blows: 0 is +x, 90 is +z.
inline constexpr float wind_to_deg = 200.0F;
inline constexpr float calm_m_per_s = 7.0F;
inline constexpr float strongest_m_per_s = 19.0F;

/// Returns the unit vector along x and z towards which the wind blows.
[[nodiscard]] glm::vec2 wind_way();

/// The weather that the user asked for.
struct WeatherChoice {
    std::optional<WeatherKind> kind; ///< Kind of the weather; none: the kind changes over time
    /// Hour of the day from which the sun's position follows. Nothing: the sun moves in films and walks, and
    /// is the scene's sun in single pictures.
    std::optional<float> hour;
    float hours_a_minute = 0.0F; ///< Speed of the sun, starting from `hour` or from the scene's own hour
};

/// The weather of a temple at any moment. The weather of each moment is computed independently of earlier
/// calls.
class WeatherTimeline {
public:
    static constexpr double rises_s = 9.0; ///< Time in which a sandstorm rises
    static constexpr double holds_s = 9.0;
    static constexpr double passes_s = 11.0;
    static constexpr double between_s = 75.0; ///< Average time from the middle of one sandstorm to the next
    /// Number of steps per second in which the hour of the day advances.
    static constexpr double sun_steps_a_s = 6.0;

    WeatherTimeline(uint64_t seed, WeatherChoice choice) : seed_(seed), choice_(choice) {}

    /// Returns the weather at a time. Cost: a few hundred additions.
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

/// Adds the nodes that the wind moves: the particle emitters `sand N`, `whirl N` and `murk N`, the ink
/// vortices `eddy N`, and the funnel of a tornado. Emitters and vortices have size 0 until they are placed.
void add_air(estampe::Scene& scene);

/// The camera and the ground near it, on which the transforms of air_places() depend.
struct AirView {
    glm::dvec3 eye_m{0.0};
    double time_s = 0.0;
    std::function<float(const glm::vec2&)> ground_m;
    /// Returns whether a roof covers a place. No sand rises under a roof.
    std::function<bool(const glm::vec2&)> is_roofed;
};

/// Returns the transforms of the nodes of add_air(), for Renderer::place(); `first` is the index of the
/// scene's node `sand 0`. Inactive nodes have size 0.
[[nodiscard]] std::vector<estampe::NodePlace> air_places(estampe::Index first, const Weather& weather,
                                                         const AirView& view);

} // namespace temple
