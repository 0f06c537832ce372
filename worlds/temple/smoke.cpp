// SPDX-License-Identifier: MIT
#include "smoke.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include "lamps.hpp"

namespace temple {
namespace {

constexpr double seen_within_m = 26.0;
constexpr double box_half_m = 1.8;  ///< of the box that smoke rises in
constexpr float over_foot_m = 0.1F; ///< of the fire its floor is

bool is_within(const Room& room, const glm::vec2& place_m)
{
    return glm::all(glm::greaterThan(place_m, room.low_m())) &&
           glm::all(glm::lessThan(place_m, room.high_m()));
}

} // namespace

std::vector<Plume> find_plumes(const Plan& plan, uint64_t seed)
{
    constexpr size_t of_each = 2;
    const std::vector<glm::vec2> way = find_way(plan);
    const Lamps lamps = hang_lamps(plan, seed);
    std::vector<Plume> plumes;
    for (const int index : {0, plan.last_room}) {
        const Room& room = plan.rooms[static_cast<size_t>(index)];
        std::vector<Plume> own;
        for (const PlacedFlame& flame : lamps.flames) {
            if (flame.is_fire && is_within(room, {flame.place_m.x, flame.place_m.z})) {
                own.push_back({flame.place_m + glm::vec3(0.0F, over_foot_m, 0.0F), index});
            }
        }
        const auto enters =
            std::ranges::find_if(way, [&](const glm::vec2& place_m) { return is_within(room, place_m); });
        const glm::vec2 door_m = enters == way.end() ? room.middle_m() : *enters;
        std::ranges::sort(own, std::ranges::greater(), [&](const Plume& plume) {
            return glm::distance(door_m, glm::vec2(plume.foot_m.x, plume.foot_m.z));
        });
        own.resize(std::min(own.size(), of_each));
        plumes.insert(plumes.end(), own.begin(), own.end());
    }
    return plumes;
}

void add_smoke(estampe::Scene& scene, const std::vector<Plume>& plumes)
{
    for (size_t i = 0; i < plumes.size(); ++i) {
        scene.roots.push_back(static_cast<estampe::Index>(scene.nodes.size()));
        estampe::Node& node = scene.nodes.emplace_back();
        node.name = "smoke " + std::to_string(i);
        node.transform = {.translation = plumes[i].foot_m, .scale = glm::dvec3(0.0)};
    }
}

std::vector<estampe::NodePlace> smoke_places(estampe::Index first, const std::vector<Plume>& plumes,
                                             const glm::dvec3& eye_m, const std::vector<bool>& in_sight)
{
    std::vector<estampe::NodePlace> places;
    for (const Plume& plume : plumes) {
        const bool is_seen = in_sight[static_cast<size_t>(plume.room)] &&
                             glm::distance(eye_m, glm::dvec3(plume.foot_m)) < seen_within_m;
        places.push_back({first + static_cast<estampe::Index>(places.size()),
                          {.translation = plume.foot_m, .scale = glm::dvec3(is_seen ? box_half_m : 0.0)}});
    }
    return places;
}

} // namespace temple
