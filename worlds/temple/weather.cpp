// SPDX-License-Identifier: MIT
#include "weather.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dice.hpp"

namespace temple {
namespace {

constexpr double first_storm_s = 38.0;
constexpr float usual_hour = 16.67F; ///< when the sun stands as the scene has it
constexpr std::array<std::pair<std::string_view, WeatherKind>, 4> kinds{{{"calm", WeatherKind::calm},
                                                                         {"gusts", WeatherKind::gusts},
                                                                         {"storm", WeatherKind::storm},
                                                                         {"tornado", WeatherKind::tornado}}};

double smooth(double low, double high, double x)
{
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Chance between 0 and 1 for a whole number, joined smoothly.
double noise(uint64_t seed, double x)
{
    const double cell = std::floor(x);
    const auto value = [&](double at) {
        return static_cast<double>(
            Dice(seed, static_cast<uint64_t>(static_cast<int64_t>(at) + 1'000'000)).share());
    };
    return value(cell) + (value(cell + 1.0) - value(cell)) * smooth(0.0, 1.0, x - cell);
}

} // namespace

std::optional<WeatherKind> weather_named(std::string_view name)
{
    for (const auto& [known, kind] : kinds) {
        if (known == name) {
            return kind;
        }
    }
    return std::nullopt;
}

std::vector<std::string> weather_names()
{
    std::vector<std::string> names;
    names.reserve(kinds.size());
    for (const auto& [name, kind] : kinds) {
        names.emplace_back(name);
    }
    return names;
}

glm::vec2 wind_way()
{
    return {std::cos(glm::radians(wind_to_deg)), std::sin(glm::radians(wind_to_deg))};
}

double WeatherTimeline::storm_s(int64_t number) const
{
    const double strays =
        number == 0
            ? 0.0
            : 14.0 * (static_cast<double>(Dice(seed_, 900 + static_cast<uint64_t>(number)).share()) - 0.5);
    return first_storm_s + between_s * static_cast<double>(number) + strays;
}

float WeatherTimeline::dust_at(double time_s) const
{
    if (choice_.kind) {
        return *choice_.kind == WeatherKind::storm     ? 1.0F
               : *choice_.kind == WeatherKind::tornado ? 0.08F
                                                       : 0.0F;
    }
    double dust = 0.0;
    const auto near = static_cast<int64_t>(std::floor((time_s - first_storm_s) / between_s + 0.5));
    for (int64_t number = std::max<int64_t>(near - 1, 0); number <= near + 1; ++number) {
        const double off_s = time_s - storm_s(number);
        const double most =
            number == 0
                ? 1.0
                : 0.55 + 0.45 * static_cast<double>(Dice(seed_, 950 + static_cast<uint64_t>(number)).share());
        dust = std::max(dust, most * smooth(-0.5 * holds_s - rises_s, -0.5 * holds_s, off_s) *
                                  (1.0 - smooth(0.5 * holds_s, 0.5 * holds_s + passes_s, off_s)));
    }
    return static_cast<float>(dust);
}

float WeatherTimeline::gusts_at(double time_s) const
{
    const double often = noise(seed_ + 11, time_s / 2.6);
    const double seldom = noise(seed_ + 12, time_s / 9.0);
    const double gust = smooth(0.35, 0.95, 0.6 * often + 0.55 * seldom);
    if (choice_.kind == WeatherKind::calm) {
        return 0.0F;
    }
    const double all = choice_.kind ? 1.0 : smooth(6.0, 16.0, time_s);
    return static_cast<float>(std::max(all * (choice_.kind == WeatherKind::gusts ? 0.35 + 0.65 * gust : gust),
                                       0.7 * static_cast<double>(dust_at(time_s))));
}

double WeatherTimeline::wind_at(double time_s) const
{
    const auto gusts = static_cast<double>(gusts_at(time_s));
    const auto dust = static_cast<double>(dust_at(time_s));
    const auto most = static_cast<double>(strongest_m_s - calm_m_s);
    return static_cast<double>(calm_m_s) + most * std::min(0.55 * gusts + 0.6 * dust, 1.0);
}

Tornado WeatherTimeline::tornado_at(double time_s) const
{
    constexpr glm::dvec2 from_m(78.0, -88.0); // on the way of the wind, behind the temple
    constexpr double lives_s = 32.0;
    const auto walked = [&](double share, double stray) {
        const glm::dvec2 way(wind_way());
        const glm::dvec2 across(-way.y, way.x);
        const double curve =
            12.0 * std::sin(5.0 * share + stray) + 4.0 * std::sin(13.0 * share + 2.0 * stray);
        return glm::vec2(from_m + 150.0 * share * way + curve * across);
    };
    if (choice_.kind) {
        if (*choice_.kind != WeatherKind::tornado) {
            return {};
        }
        const double share = 0.6 + 0.25 * (0.5 - 0.5 * std::cos(0.05 * time_s));
        return {walked(share, 1.0), 1.0F};
    }
    const auto near = static_cast<int64_t>(std::floor((time_s - first_storm_s) / between_s + 0.5));
    for (int64_t number = std::max<int64_t>(near, 0); number <= near + 1; ++number) {
        // It comes before the storm does, and goes in it.
        const double since_s = time_s - (storm_s(number) - 24.0);
        if (since_s > 0.0 && since_s < lives_s) {
            const double strength =
                smooth(0.0, 7.0, since_s) * (1.0 - smooth(lives_s - 8.0, lives_s, since_s));
            return {walked(since_s / lives_s, 1.0 + static_cast<double>(number)),
                    static_cast<float>(strength)};
        }
    }
    return {};
}

Weather WeatherTimeline::at(double time_s) const
{
    constexpr double step_s = 0.25;
    Weather weather{.wind_m_s = static_cast<float>(wind_at(time_s)),
                    .gusts = gusts_at(time_s),
                    .dust = dust_at(time_s),
                    .tornado = tornado_at(time_s)};
    // The way of the wind: whole steps, the middle of each, and what is left.
    const double end_s = std::max(time_s, 0.0);
    const auto whole = static_cast<int64_t>(end_s / step_s);
    for (int64_t i = 0; i < whole; ++i) {
        weather.blown_m += step_s * wind_at((static_cast<double>(i) + 0.5) * step_s);
    }
    const double left_s = end_s - static_cast<double>(whole) * step_s;
    weather.blown_m += left_s * wind_at(static_cast<double>(whole) * step_s + 0.5 * left_s);
    const double veil = noise(seed_ + 13, time_s / 40.0);
    // In steps that nobody sees, so that clouds need not be shaped anew for every picture.
    constexpr double cloud_steps = 1024.0;
    const double clouds = choice_.kind == WeatherKind::calm
                              ? 0.0
                              : std::min(0.02 + 0.1 * veil + 0.1 * static_cast<double>(weather.gusts) +
                                             0.35 * static_cast<double>(weather.dust) +
                                             0.25 * static_cast<double>(weather.tornado.strength),
                                         0.75);
    weather.clouds = static_cast<float>(std::round(cloud_steps * clouds) / cloud_steps);
    if (choice_.hour || choice_.hours_a_minute != 0.0F) {
        const auto from = static_cast<double>(choice_.hour.value_or(usual_hour));
        // On fours of a film, so that its shadows, which go as far as a pixel in that time, are not drawn
        // anew for every picture. A moment on the border belongs to the later step.
        const double held_s = std::floor(sun_steps_a_s * end_s + 1e-6) / sun_steps_a_s;
        const double passed = static_cast<double>(choice_.hours_a_minute) * held_s / 60.0;
        weather.hour = static_cast<float>(std::fmod(from + passed, 24.0));
    }
    return weather;
}

} // namespace temple
