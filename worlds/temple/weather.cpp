// SPDX-License-Identifier: MIT
#include "weather.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "kit.hpp"

namespace temple {
namespace {

constexpr double first_storm_s = 38.0;
/// Hour of the day that corresponds to the position of the sun in the scene.
constexpr float usual_hour = 16.67F;
constexpr std::array<std::pair<std::string_view, WeatherKind>, 4> kinds{{{"calm", WeatherKind::calm},
                                                                         {"gusts", WeatherKind::gusts},
                                                                         {"storm", WeatherKind::storm},
                                                                         {"tornado", WeatherKind::tornado}}};

double smooth(double low, double high, double x)
{
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// Returns smooth noise between 0 and 1, with a random value at each whole number.
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
    const auto most = static_cast<double>(strongest_m_per_s - calm_m_per_s);
    return static_cast<double>(calm_m_per_s) + most * std::min(0.55 * gusts + 0.6 * dust, 1.0);
}

Tornado WeatherTimeline::tornado_at(double time_s) const
{
    // Place behind the temple where the tornado begins. The tornado's first place lies on the line along
    // which the wind blows.
    constexpr glm::dvec2 from_m(78.0, -88.0);
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
        // A tornado appears before a sandstorm, and disappears in the sandstorm.
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
    Weather weather{.wind_m_per_s = static_cast<float>(wind_at(time_s)),
                    .gusts = gusts_at(time_s),
                    .dust = dust_at(time_s),
                    .tornado = tornado_at(time_s)};
    // Integrates the wind's speed over time: whole steps, each with the speed in its middle, and a shorter
    // last step.
    const double end_s = std::max(time_s, 0.0);
    const auto whole = static_cast<int64_t>(end_s / step_s);
    for (int64_t i = 0; i < whole; ++i) {
        weather.blown_m += step_s * wind_at((static_cast<double>(i) + 0.5) * step_s);
    }
    const double left_s = end_s - static_cast<double>(whole) * step_s;
    weather.blown_m += left_s * wind_at(static_cast<double>(whole) * step_s + 0.5 * left_s);
    const double veil = noise(seed_ + 13, time_s / 40.0);
    // The cloud cover is rounded in steps too small to be seen. Clouds are then rebuilt only when the rounded
    // value changes, not for every picture.
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
        // The sun moves only on every fourth frame of a film, so that its shadows need not be drawn again for
        // every picture. In this time the shadows move by a pixel at most. The tolerance assigns a time on
        // the border of two steps to the later step.
        const double held_s = std::floor(sun_steps_a_s * end_s + 1e-6) / sun_steps_a_s;
        const double passed = static_cast<double>(choice_.hours_a_minute) * held_s / 60.0;
        weather.hour = static_cast<float>(std::fmod(from + passed, 24.0));
    }
    return weather;
}

namespace {

using estampe::Index;
using estampe::Primitive;

constexpr double funnel_m = 46.0; ///< Height of the tornado's funnel

/// Number of rings of the funnel; the rings are stacked, the first at the foot.
constexpr int ring_count = 12;
constexpr uint32_t skin_columns = 40;
constexpr uint32_t skin_rows = 44;
constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr double hidden_deep_m = 200.0; ///< Depth below the ground at which an inactive tornado is hidden

/// Returns the offset of the funnel's axis from its foot at `share` of the funnel's height, along x and z.
glm::dvec2 funnel_sway_m(double share, double time_s)
{
    const glm::dvec2 ahead(wind_way());
    const glm::dvec2 aside(-ahead.y, ahead.x);
    return share * (9.0 * share * ahead + 4.5 * std::sin(0.55 * time_s + 3.6 * share) * aside +
                    2.6 * std::sin(0.83 * time_s + 5.2 * share) * ahead);
}

/// Returns the radius of the tornado's funnel at `share` of the funnel's height.
double funnel_radius_m(double share)
{
    // The funnel has a thin foot, a trunk that widens slowly, and a wide top.
    return 0.8 + 3.2 * share + 11.0 * std::pow(share, 3.5) + 1.5 * std::exp(-60.0 * share * share);
}

/// Returns the rotation of the funnel at `share` of the funnel's height, clockwise from above.
double funnel_turn_rad(double share, double time_s)
{
    return 2.1 * time_s - 0.9 * share;
}

double joint_share(int joint)
{
    return static_cast<double>(joint) / (ring_count - 1);
}

/// Returns the distance of the funnel's surface from its axis, as a multiple of the radius. Strands of sand
/// wind around the funnel and fray its upper end.
double strands_at(double share, double angle)
{
    return 1.0 + 0.17 * std::sin(3.0 * angle - 9.0 * share) +
           0.09 * std::sin(7.0 * angle - 16.0 * share + 1.3) * (0.4 + share) +
           0.05 * std::sin(11.0 * angle + 23.0 * share);
}

glm::vec3 skin_at(double share, double angle)
{
    const double out_m = funnel_radius_m(share) * strands_at(share, angle);
    const double torn_m =
        3.4 * glm::smoothstep(0.8, 1.0, share) * std::sin(5.0 * angle) * std::cos(2.0 * angle + 0.7);
    return {out_m * std::cos(angle), funnel_m * share + torn_m, out_m * std::sin(angle)};
}

Primitive trunk(Index material)
{
    Primitive part;
    part.material = material;
    // Rise of a strand of sand per turn; with this value, pen strokes meet at the seam of the funnel's
    // surface.
    constexpr double rises_m = 8.0;
    constexpr double tiny = 1e-3;
    for (uint32_t row = 0; row <= skin_rows; ++row) {
        const double share = static_cast<double>(row) / skin_rows;
        for (uint32_t column = 0; column <= skin_columns; ++column) {
            const double angle = whole_turn * column / skin_columns;
            part.positions.emplace_back(skin_at(share, angle));
            // The skin has no direction below its lowest ring, whose normals are those just above it.
            const double above = std::max(share, 2.0 * tiny);
            const glm::vec3 around = skin_at(above, angle + tiny) - skin_at(above, angle - tiny);
            const glm::vec3 up = skin_at(above + tiny, angle) - skin_at(above - tiny, angle);
            part.normals.push_back(glm::normalize(glm::cross(up, around)));
            part.uvs[0].emplace_back(4.0 * angle, 0.6 * funnel_m * share - rises_m * angle / whole_turn);
            const double along = share * (ring_count - 1);
            const auto below = static_cast<uint16_t>(std::min(static_cast<int>(along), ring_count - 2));
            const auto part_above = static_cast<float>(along - below);
            part.joints_0.emplace_back(below, below + 1, 0, 0);
            part.weights_0.emplace_back(1.0F - part_above, part_above, 0.0F, 0.0F);
        }
    }
    constexpr uint32_t stride = skin_columns + 1;
    for (uint32_t row = 0; row < skin_rows; ++row) {
        for (uint32_t column = 0; column < skin_columns; ++column) {
            const uint32_t low = row * stride + column;
            const uint32_t high = low + stride;
            part.indices.insert(part.indices.end(), {low, high, low + 1, low + 1, high, high + 1});
        }
    }
    return part;
}

/// Returns the transforms of the funnel's nodes. `first` is the index of the node `funnel`.
std::vector<estampe::NodePlace> funnel_places(Index first, const Tornado& tornado, double ground_m,
                                              double time_s)
{
    std::vector<estampe::NodePlace> places;
    const auto strength = static_cast<double>(tornado.strength);
    const bool is_there = strength > 0.03;
    // The tornado grows from a thin thread that comes down from above. At its end the tornado becomes a
    // thread again.
    const double grown = glm::smoothstep(0.0, 1.0, strength);
    const double lifted_m = is_there ? 0.5 * funnel_m * (1.0 - grown) : -hidden_deep_m;
    places.push_back({first,
                      {.translation = {tornado.foot_m.x, ground_m - 0.6 + lifted_m, tornado.foot_m.y},
                       .rotation = {1.0, 0.0, 0.0, 0.0},
                       .scale = glm::dvec3(is_there ? 1.0 : 1e-3)}});
    Index node = first + 1;
    for (int joint = 0; joint < ring_count; ++joint) {
        const double share = joint_share(joint);
        const glm::dvec2 sway_m = funnel_sway_m(share, time_s);
        const double wide = std::max(grown, 0.05) * (1.0 + 0.06 * std::sin(1.7 * time_s + 7.0 * share));
        places.push_back(
            {node++,
             {.translation = {sway_m.x, funnel_m * share, sway_m.y},
              .rotation = glm::angleAxis(-funnel_turn_rad(share, time_s), glm::dvec3(0.0, 1.0, 0.0)),
              .scale = {wide, 1.0, wide}}});
    }
    places.push_back({node, {.translation = {}, .rotation = {1.0, 0.0, 0.0, 0.0}, .scale = glm::dvec3(1.0)}});
    return places;
}

/// Adds the tornado's node `funnel`, its joints, and its skinned mesh, and appends its material. The funnel
/// is hidden until it is placed.
void add_funnel(estampe::Scene& scene)
{
    const auto sand = static_cast<Index>(scene.materials.size());
    scene.materials.push_back(
        {.name = "funnel", .base_color = {0.26F, 0.19F, 0.115F, 1.0F}, .metallic = 0.0F});
    scene.materials.back().double_sided = true;
    const auto root = static_cast<Index>(scene.nodes.size());
    scene.roots.push_back(root);
    scene.nodes.emplace_back().name = "funnel";
    estampe::Skin skin{.name = "funnel", .joints = {}, .joint_from_bind = {}};
    const auto add = [&](const std::string& name) -> estampe::Node& {
        scene.nodes[root].children.push_back(static_cast<Index>(scene.nodes.size()));
        estampe::Node& node = scene.nodes.emplace_back();
        node.name = name;
        node.parent = root;
        return node;
    };
    for (int joint = 0; joint < ring_count; ++joint) {
        skin.joints.push_back(static_cast<Index>(scene.nodes.size()));
        const auto height_m = static_cast<float>(funnel_m * joint_share(joint));
        skin.joint_from_bind.push_back(glm::translate(glm::mat4(1.0F), {0.0F, -height_m, 0.0F}));
        add("turn");
    }
    estampe::Node& body = add("body of funnel");
    body.mesh = static_cast<Index>(scene.meshes.size());
    body.skin = static_cast<Index>(scene.skins.size());
    scene.meshes.push_back({.name = "funnel", .primitives = {trunk(sand)}});
    scene.skins.push_back(std::move(skin));
    for (const estampe::NodePlace& place : funnel_places(root, {}, 0.0, 0.0)) {
        scene.nodes[place.node].transform = place.transform;
    }
}

constexpr int sand_side = 7; ///< Emitters along a side of the square grid of sand emitters around the eye
constexpr double sand_cell_m = 11.0;
constexpr int whirls = 26; ///< Number of sand emitters around the tornado's foot and on its funnel
constexpr int skirts = 14; ///< Number of the tornado's sand emitters that are around its foot
constexpr int murks = 8;   ///< Number of emitters of ink clouds

/// Returns a rotation that turns +y towards a direction.
glm::dquat towards(const glm::dvec3& way)
{
    const glm::dvec3 unit = glm::normalize(way);
    const glm::dvec3 axis = glm::cross(glm::dvec3(0.0, 1.0, 0.0), unit);
    return glm::length(axis) > 1e-9 ? glm::angleAxis(std::acos(unit.y), glm::normalize(axis))
                                    : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// Returns a random number from 0 to 1 for a cell of the ground.
double chance_of(int64_t x, int64_t z, uint64_t which)
{
    return static_cast<double>(Dice(static_cast<uint64_t>(x * 73'856'093 ^ z * 19'349'663), which).share());
}

estampe::NodePlace sand_at(estampe::Index node, int column, int row, const Weather& weather,
                           const AirView& view)
{
    // Each sand emitter has a number along x and along z. The emitter is placed in the nearest cell of the
    // ground with the emitter's numbers (modulo the grid's side). When the eye moves on, an emitter that
    // falls behind reappears in front.
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
    // Gusts of wind move across the ground as waves.
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

/// Returns the transform of an emitter that rotates with the tornado's funnel, at the distance `off_m` from
/// the funnel's surface.
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
