// SPDX-License-Identifier: MIT
#include "air.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "dice.hpp"
#include "funnel.hpp"

namespace temple {
namespace {

constexpr int sand_side = 7; ///< of the square of emitters about the eye
constexpr double sand_cell_m = 11.0;
constexpr int whirls = 26; ///< of sand about the tornado's foot, and on its skin
constexpr int skirts = 14; ///< of these about its foot
constexpr int murks = 8;   ///< of ink

/// Turns +y that way.
glm::dquat towards(const glm::dvec3& way)
{
    const glm::dvec3 unit = glm::normalize(way);
    const glm::dvec3 axis = glm::cross(glm::dvec3(0.0, 1.0, 0.0), unit);
    return glm::length(axis) > 1e-9 ? glm::angleAxis(std::acos(unit.y), glm::normalize(axis))
                                    : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// 0 to 1, of a cell of the ground.
double chance_of(int64_t x, int64_t z, uint64_t which)
{
    return static_cast<double>(Dice(static_cast<uint64_t>(x * 73'856'093 ^ z * 19'349'663), which).share());
}

estampe::NodePlace sand_at(estampe::Index node, int column, int row, const Weather& weather,
                           const AirView& view)
{
    // Each has the cell of its own number, counted round, that is nearest to the eye: when the eye goes on,
    // cells that fall behind come again in front.
    const auto nearest = [](double eye_m, int number) {
        const double cell = eye_m / sand_cell_m;
        return number + sand_side * static_cast<int64_t>(std::llround((cell - number) / sand_side));
    };
    const int64_t x = nearest(view.eye_m.x, column);
    const int64_t z = nearest(view.eye_m.z, row);
    const glm::dvec2 place = sand_cell_m * (glm::dvec2(static_cast<double>(x), static_cast<double>(z)) +
                                            0.8 * (glm::dvec2(chance_of(x, z, 1), chance_of(x, z, 2)) - 0.5));
    const double most_m = 0.5 * sand_side * sand_cell_m;
    const double away_m = std::max(std::abs(place.x - view.eye_m.x), std::abs(place.y - view.eye_m.z));
    // Gusts wander over the ground.
    const double waves =
        0.5 + 0.5 * std::sin(0.9 * view.time_s - 0.16 * glm::dot(place, glm::dvec2(wind_way())) +
                             6.0 * chance_of(x / 3, z / 3, 3));
    const double often =
        static_cast<double>(weather.gusts) * (0.45 + 0.55 * waves) + 0.9 * static_cast<double>(weather.dust);
    const double gives = std::clamp((often - 0.75 * chance_of(x, z, 4)) / 0.3, 0.0, 1.0);
    const bool is_none = gives <= 0.02 || away_m > most_m - 0.2 || view.is_roofed(glm::vec2(place));
    const glm::dvec3 blows(wind_way().x, 0.25, wind_way().y);
    const double size = (0.55 + 0.45 * gives) * (1.0 + 0.8 * static_cast<double>(weather.dust));
    return {node,
            {.translation = {place.x, static_cast<double>(view.ground_m(glm::vec2(place))) + 0.25, place.y},
             .rotation = towards(blows),
             .scale = glm::dvec3(is_none ? 0.0 : size)}};
}

/// Beside the funnel's skin, so far off and turning with it.
estampe::NodePlace whirl_at(estampe::Index node, double share, double angle, double off_m, double size,
                            const Weather& weather, const AirView& view)
{
    const auto strength = static_cast<double>(weather.tornado.strength);
    const double turned = angle - funnel_turn_rad(share, view.time_s);
    const glm::dvec2 out(std::cos(turned), std::sin(turned));
    const glm::dvec2 place = glm::dvec2(weather.tornado.foot_m) + funnel_sway_m(share, view.time_s) +
                             (strength * funnel_radius_m(share) + off_m) * out;
    const double lifted_m = 0.5 * funnel_m * (1.0 - glm::smoothstep(0.0, 1.0, strength));
    const double height_m = static_cast<double>(view.ground_m(weather.tornado.foot_m)) + 0.5 +
                            funnel_m * share + (share > 0.1 ? lifted_m : 0.0);
    const glm::dvec3 blows(out.y, share > 0.1 ? 0.35 : 0.12, -out.x);
    return {node,
            {.translation = {place.x, height_m, place.y},
             .rotation = towards(blows),
             .scale = glm::dvec3(strength < 0.03 ? 0.0 : size * (0.4 + 0.6 * strength))}};
}

} // namespace

void add_air(estampe::Scene& scene)
{
    const auto add = [&](const std::string& name, int count) {
        for (int i = 0; i < count; ++i) {
            scene.roots.push_back(static_cast<estampe::Index>(scene.nodes.size()));
            estampe::Node& node = scene.nodes.emplace_back();
            node.name = name + " " + std::to_string(i);
            node.transform.scale = glm::dvec3(0.0);
        }
    };
    add("sand", sand_side * sand_side);
    add("whirl", whirls);
    add("murk", murks);
    add("eddy", 1);
    add_funnel(scene);
}

std::vector<estampe::NodePlace> air_places(estampe::Index first, const Weather& weather, const AirView& view)
{
    std::vector<estampe::NodePlace> places;
    estampe::Index node = first;
    for (int row = 0; row < sand_side; ++row) {
        for (int column = 0; column < sand_side; ++column) {
            places.push_back(sand_at(node++, column, row, weather, view));
        }
    }
    constexpr double golden = std::numbers::pi * 0.7639320225;
    for (int i = 0; i < whirls; ++i) {
        const double angle = 2.0 * golden * i;
        const bool is_skirt = i < skirts;
        const double part = is_skirt ? (i + 0.5) / skirts : (i - skirts + 0.5) / (whirls - skirts);
        places.push_back(is_skirt ? whirl_at(node++, 0.03 * part, angle, 1.0 + 7.0 * part, 1.0, weather, view)
                                  : whirl_at(node++, 0.1 + 0.9 * part, angle, 0.6 + 4.0 * part * part,
                                             0.22 + 0.2 * part, weather, view));
    }
    for (int i = 0; i < murks; ++i) {
        const double part = (i + 0.5) / murks;
        places.push_back(whirl_at(node++, part, 2.0 + 2.0 * golden * i, 0.8 + 2.0 * part, 0.5 + 0.5 * part,
                                  weather, view));
    }
    const auto strength = static_cast<double>(weather.tornado.strength);
    const glm::vec2 foot = weather.tornado.foot_m;
    places.push_back(
        {node++,
         {.translation = {foot.x, static_cast<double>(view.ground_m(foot)) + 0.4 * funnel_m, foot.y},
          .scale = glm::dvec3(0.5 * funnel_m * strength)}});
    const auto trunk =
        funnel_places(node, weather.tornado, static_cast<double>(view.ground_m(foot)), view.time_s);
    places.insert(places.end(), trunk.begin(), trunk.end());
    return places;
}

} // namespace temple
