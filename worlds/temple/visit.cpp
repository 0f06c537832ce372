// SPDX-License-Identifier: MIT
#include "visit.hpp"

#include <algorithm>
#include <cmath>

#include "plan.hpp"

namespace temple {
namespace {

/// The ending begins when the visitor is nearer than this to the middle of the last hall.
constexpr double reach_m = 2.6;
constexpr double spreads_m_per_s = 5.5; ///< Speed at which the ending spreads from the last hall outwards
constexpr double sinks_s = 4.0;         ///< Time in which a fire becomes embers
constexpr double embers = 0.07;         ///< Share of a fire's light that remains in the ending
constexpr double low_flame = 0.22;      ///< Share of a flame's height that remains in the ending
constexpr double day_grows = 2.4;       ///< Factor by which the daylight in the halls brightens
constexpr double grows_s = 9.0;         ///< Time in which the daylight brightens
constexpr double gratings_from_s = 2.0;
constexpr double gratings_to_s = 9.0;
constexpr double gratings_down_m = 2.7;

/// Returns the progress of a change: 0 before `from_s`, 1 from `length_s` later, with a smooth transition.
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
        return glm::distance(glm::dvec2(place_m.x, place_m.z), middle_m_) / spreads_m_per_s;
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

walk::Solids solids_of(const estampe::Scene& scene)
{
    return walk::Solids(scene, [](const estampe::Node& node) { return node.name != "flame"; });
}

walk::SandAt sand_of(const estampe::Terrain& desert, const double& time_s)
{
    return [&desert, &time_s](const glm::dvec2& place_m) {
        const estampe::HeightSample sample = desert.sample(place_m.x, place_m.y, time_s);
        return walk::Sand{sample.height_m, sample.slope};
    };
}

Visit::Visit(const estampe::Scene& scene, uint64_t seed)
    : desert_(*scene.terrain), solids_(solids_of(scene)), ending_(scene, seed)
{
    constexpr glm::dvec3 beginning_m(-1.2, 0.0, 80.0);
    walker_.emplace(walk::Place(solids_, sand_of(desert_, time_s_)), walk::Body{}, beginning_m);
}

void Visit::go(const walk::Intent& intent, double seconds, double time_s)
{
    time_s_ = time_s;
    walker_->advance(intent, seconds);
    if (since_arrival_s_) {
        *since_arrival_s_ += seconds;
    } else if (ending_.begins_at(walker_->feet_m())) {
        since_arrival_s_ = 0.0;
    }
    solids_.set_gone(ending_.gratings(), since_arrival_s_ && Ending::are_open(*since_arrival_s_));
}

Tour::Tour(const Visit& visit, uint64_t seed)
    : visit_(visit), chart_(visit.walker().place(), visit.walker().body(), visit.walker().feet_m(),
                            {.low_m = {-42.0, -66.0}, .high_m = {36.0, 108.0}})
{
    const Plan plan = make_plan(seed);
    std::vector<glm::dvec2> stations{{-1.2, 80.0}, {18.0, 98.0}, {-20.0, 90.0}, {0.0, 30.0},
                                     {-24.0, 2.0}, {13.0, 6.0},  {0.0, -19.0}};
    // The rooms of the tour, sorted by the length of the path from the portal. The last hall comes last.
    std::vector<size_t> rooms;
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
        if (static_cast<int>(i) != plan.last_room && find_open(plan.rooms[i])) {
            rooms.push_back(i);
        }
    }
    const glm::dvec2 portal_m(plan.doors.front().place_m);
    std::ranges::sort(rooms, {}, [&](size_t i) {
        return chart_.way(portal_m - glm::dvec2(0.0, 2.0), *find_open(plan.rooms[i])).size();
    });
    rooms.push_back(static_cast<size_t>(plan.last_room));
    for (const size_t i : rooms) {
        if (const std::optional<glm::dvec2> open = find_open(plan.rooms[i])) {
            stations.push_back(*open);
            halls_ += plan.rooms[i].kind == RoomKind::cell ? 0 : 1;
        }
    }
    stations.push_back(portal_m + glm::dvec2(0.0, 3.0));
    stations.push_back(stations.front());
    glm::dvec2 from_m = stations.front();
    for (const glm::dvec2& station : stations) {
        const std::vector<glm::dvec3> leg = chart_.way(from_m, station);
        if (!leg.empty()) {
            way_.insert(way_.end(), leg.begin(), leg.end());
            from_m = station;
        }
    }
}

walk::Intent Tour::intent()
{
    const glm::dvec3& feet_m = visit_.walker().feet_m();
    constexpr double ahead_m = 0.7;
    while (glm::distance(glm::dvec2(feet_m.x, feet_m.z), target_m()) < ahead_m) {
        if (++next_ == way_.size()) {
            next_ = 0;
            ++rounds_;
        }
    }
    const glm::dvec2 way = target_m() - glm::dvec2(feet_m.x, feet_m.z);
    return {.way = way / glm::length(way), .runs = feet_m.z > -14.0};
}

std::optional<glm::dvec2> Tour::find_open(const Room& room) const
{
    const glm::dvec2 middle_m(room.middle_m());
    for (double far_m = 0.0; far_m < 2.0; far_m += 0.3) {
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.7854 * k;
            const glm::dvec2 at = middle_m + far_m * glm::dvec2(std::cos(angle), std::sin(angle));
            if (chart_.reaches(at)) {
                return at;
            }
        }
    }
    return std::nullopt;
}

} // namespace temple
