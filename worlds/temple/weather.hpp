// SPDX-License-Identifier: MIT
#pragma once

// The temple's weather and time of day, as a random timeline: one wind for sand, flags and ink, gusts,
// sandstorms that rise, hide the view and pass, tornadoes that wander by, clouds, and a moving sun. Also the
// nodes that the wind moves: sand over the ground and in storms, and the funnel of a tornado.

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

/// The weather that a user may choose; it then stays of this kind.
enum class WeatherKind : uint8_t { calm, gusts, storm, tornado };

/// The weather of that name; nothing for an unknown name.
[[nodiscard]] std::optional<WeatherKind> weather_named(std::string_view name);

/// All names that weather_named() accepts.
[[nodiscard]] std::vector<std::string> weather_names();

/// A moving tornado.
struct Tornado {
    glm::vec2 foot_m{0.0F};
    float strength = 0.0F; ///< 0, no tornado, to 1
};

/// The weather at a moment.
struct Weather {
    float wind_m_per_s = 7.0F;
    double blown_m = 0.0; ///< distance that the wind has blown since time 0
    float gusts = 0.0F;   ///< strength of the gusts, 0 to 1
    float dust = 0.0F;    ///< dust in the air, 0 to 1; at 1 visibility is as short as a room
    float clouds = 0.0F;  ///< share of the sky that clouds cover
    Tornado tornado;
    std::optional<float> hour; ///< hour of the sun; nothing: the sun of the scene
};

inline constexpr float wind_to_deg = 200.0F; ///< direction that the wind always blows to: 0 is +x, 90 is +z
inline constexpr float calm_m_per_s = 7.0F;
inline constexpr float strongest_m_per_s = 19.0F;

/// Unit vector along x and z that the wind blows to.
[[nodiscard]] glm::vec2 wind_way();

/// The weather that the user asked for.
struct WeatherChoice {
    std::optional<WeatherKind> kind; ///< none: the kind of weather changes over time
    std::optional<float> hour;   ///< hour of the sun; nothing: it moves, or stands still in single pictures
    float hours_a_minute = 0.0F; ///< speed of the sun, starting from `hour` or from the scene's own
};

/// The weather of a temple at any moment. Each moment is computed independently of earlier calls.
class WeatherTimeline {
public:
    static constexpr double rises_s = 9.0; ///< duration in which a storm rises
    static constexpr double holds_s = 9.0;
    static constexpr double passes_s = 11.0;
    static constexpr double between_s = 75.0;    ///< average time from the middle of one storm to the next
    static constexpr double sun_steps_a_s = 6.0; ///< the hour advances in steps, this many per second

    WeatherTimeline(uint64_t seed, WeatherChoice choice) : seed_(seed), choice_(choice) {}

    /// Cost: a few hundred additions.
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

/// Adds the particle emitters `sand N`, `whirl N` and `murk N`, the ink vortices `eddy N`, and the funnel of
/// a tornado. Emitters and vortices have no size until they are placed.
void add_air(estampe::Scene& scene);

/// The camera and the ground that the air depends on.
struct AirView {
    glm::dvec3 eye_m{0.0};
    double time_s = 0.0;
    std::function<float(const glm::vec2&)> ground_m;
    std::function<bool(const glm::vec2&)> is_roofed; ///< whether a roof covers a place; no sand rises there
};

/// Transforms of the nodes of add_air(), for Renderer::place(); `first` is the scene's node `sand 0`.
/// Inactive nodes have no size.
[[nodiscard]] std::vector<estampe::NodePlace> air_places(estampe::Index first, const Weather& weather,
                                                         const AirView& view);

} // namespace temple
