// SPDX-License-Identifier: MIT
#include "ending.hpp"

#include <algorithm>
#include <cmath>

#include "plan.hpp"

namespace temple {
namespace {

constexpr double reach_m = 2.6;     ///< of the middle
constexpr double spreads_m_s = 5.5; ///< how fast it goes from the last hall outwards
constexpr double sinks_s = 4.0;     ///< a fire
constexpr double embers = 0.07;     ///< share of its light that is left
constexpr double low_flame = 0.22;  ///< share of its height
constexpr double day_grows = 2.4;   ///< times what it was
constexpr double grows_s = 9.0;     ///< it takes
constexpr double gratings_from_s = 2.0;
constexpr double gratings_to_s = 9.0;
constexpr double gratings_down_m = 2.7;

/// 0 before, 1 after, without a jerk.
double part(double now_s, double from_s, double length_s)
{
    return glm::smoothstep(0.0, 1.0, (now_s - from_s) / length_s);
}

} // namespace

Ending::Ending(const estampe::Scene& scene, uint64_t seed)
{
    const Plan plan = make_plan(seed);
    middle_m_ = plan.rooms[static_cast<size_t>(plan.last_room)].middle_m();
    const auto begins_s = [&](const estampe::Node& node) {
        const glm::dvec3& place_m = node.transform.translation;
        return glm::distance(glm::dvec2(place_m.x, place_m.z), middle_m_) / spreads_m_s;
    };
    for (estampe::Index index = 0; index < scene.nodes.size(); ++index) {
        const estampe::Node& node = scene.nodes[index];
        const bool is_fire = node.name.starts_with("lamp ");
        if (node.light < scene.lights.size() && (is_fire || node.name == "shaft")) {
            lights_.push_back({.at_first = {node.light, scene.lights[node.light].intensity},
                               .is_daylight = !is_fire,
                               .begins_s = begins_s(node)});
        } else if (node.name == "flame") {
            flames_.push_back({.at_first = {index, node.transform}, .begins_s = begins_s(node)});
        } else if (node.name == "bars") {
            gratings_ = {index, node.transform};
        }
    }
}

bool Ending::begins_at(const glm::dvec3& feet_m) const
{
    constexpr auto floor_height_m = static_cast<double>(floor_m);
    return glm::distance(glm::dvec2(feet_m.x, feet_m.z), middle_m_) < reach_m &&
           std::abs(feet_m.y - floor_height_m) < 1.0;
}

std::vector<estampe::LightBrightness> Ending::lights(double after_s) const
{
    std::vector<estampe::LightBrightness> lights;
    lights.reserve(lights_.size());
    for (const Light& light : lights_) {
        const double share = light.is_daylight
                                 ? glm::mix(1.0, day_grows, part(after_s, light.begins_s, grows_s))
                                 : glm::mix(1.0, embers, part(after_s, light.begins_s, sinks_s));
        lights.push_back(light.at_first);
        lights.back().intensity *= static_cast<float>(share);
    }
    return lights;
}

std::vector<estampe::NodePlace> Ending::nodes(double after_s) const
{
    std::vector<estampe::NodePlace> nodes;
    nodes.reserve(flames_.size() + 1);
    for (const Flame& flame : flames_) {
        nodes.push_back(flame.at_first);
        nodes.back().transform.scale *= glm::mix(1.0, low_flame, part(after_s, flame.begins_s, sinks_s));
    }
    if (gratings_.node != estampe::no_index) {
        nodes.push_back(gratings_);
        nodes.back().transform.translation.y -=
            gratings_down_m * part(after_s, gratings_from_s, gratings_to_s - gratings_from_s);
    }
    return nodes;
}

bool Ending::are_open(double after_s)
{
    return after_s > gratings_to_s;
}

} // namespace temple
