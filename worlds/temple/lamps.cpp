// SPDX-License-Identifier: MIT
#include "lamps.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include <estampe/shapes.hpp>

#include "kit.hpp"

namespace temple {
namespace {

namespace shapes = estampe::shapes;

const glm::vec3 fire(1.0F, 0.68F, 0.36F);
const glm::vec3 daylight(0.86F, 0.95F, 1.0F);

class Hanger {
public:
    explicit Hanger(Lamps& lamps) : lamps_(lamps) {}

    /// Adds a lamp: a bowl on three chains below a ceiling.
    void lamp(const glm::vec3& place_m, float ceiling_m, float candela)
    {
        const std::array<glm::vec2, 7> bowl{{{0.0F, -0.2F},
                                             {0.08F, -0.19F},
                                             {0.2F, -0.1F},
                                             {0.26F, 0.0F},
                                             {0.23F, 0.0F},
                                             {0.16F, -0.08F},
                                             {0.0F, -0.12F}}};
        lamps_.kit.add(Stuff::iron, shapes::lathe(bowl, 18), at(place_m));
        for (const glm::vec2 side :
             {glm::vec2(0.24F, 0.0F), glm::vec2(-0.12F, 0.2F), glm::vec2(-0.12F, -0.2F)}) {
            lamps_.kit.add(Stuff::iron, rod(place_m + glm::vec3(side.x, 0.0F, side.y),
                                            {place_m.x, ceiling_m, place_m.z}, 0.012F, 0.012F, 5, 3));
        }
        lamps_.flames.push_back({place_m + glm::vec3(0.0F, -0.06F, 0.0F), false});
        light(place_m + glm::vec3(0.0F, 0.22F, 0.0F), candela, false);
    }

    /// Adds a brazier: a bowl of embers on a foot.
    void brazier(const glm::vec3& place_m, float candela, bool throws_shadows)
    {
        const std::array<glm::vec2, 11> foot{{{0.0F, 0.0F},
                                              {0.36F, 0.0F},
                                              {0.3F, 0.1F},
                                              {0.09F, 0.2F},
                                              {0.07F, 0.75F},
                                              {0.16F, 0.86F},
                                              {0.4F, 0.98F},
                                              {0.5F, 1.16F},
                                              {0.45F, 1.16F},
                                              {0.3F, 1.05F},
                                              {0.0F, 1.02F}}};
        lamps_.kit.add(Stuff::iron, shapes::lathe(foot, 24), at(place_m));
        lamps_.flames.push_back({place_m + glm::vec3(0.0F, 1.04F, 0.0F), true});
        light(place_m + glm::vec3(0.0F, 1.75F, 0.0F), candela, throws_shadows);
    }

    /// Adds the daylight that falls through a hole in the roof, as a spot light above the hole.
    void shaft(const glm::vec3& hole_m, float depth_m)
    {
        constexpr float above_m = 5.0F;
        const float edge = shaft_half_m / above_m;
        estampe::Light light{.name = "shaft",
                             .type = estampe::LightType::spot,
                             .color = daylight,
                             .intensity = 2.2F * (above_m + depth_m) * (above_m + depth_m),
                             .range_m = 3.0F * (above_m + depth_m),
                             .inner_cone_rad = 0.9F * std::atan(edge),
                             .outer_cone_rad = 1.1F * std::atan(edge),
                             .shape = estampe::SpotShape::pyramid};
        lamps_.lights.push_back({std::move(light), hole_m + glm::vec3(0.0F, above_m, 0.0F)});
    }

private:
    void light(const glm::vec3& place_m, float candela, bool throws_shadows)
    {
        estampe::Light light{.name = "lamp " + std::to_string(lamps_.lights.size()),
                             .color = fire,
                             .intensity = candela,
                             .range_m = 1.5F * std::sqrt(candela) + 4.0F};
        light.casters = throws_shadows ? estampe::all_groups : estampe::Groups{0};
        lamps_.lights.push_back({std::move(light), place_m});
    }

    Lamps& lamps_;
};

void light_room(Hanger& hanger, const Plan& plan, int index, Dice& dice)
{
    const Room& room = plan.rooms[static_cast<size_t>(index)];
    const glm::vec2 low = room.low_m();
    const glm::vec2 high = room.high_m();
    const glm::vec2 middle = room.middle_m();
    const float ceiling = floor_m + room.height_m;
    const glm::ivec2 modules = room.last - room.first;
    switch (room.kind) {
    case RoomKind::cell:
        // A cell's lamp hangs near the wall, so that it does not block the way.
        hanger.lamp(
            {middle.x + dice.between(-1.2F, 1.2F), floor_m + 2.5F, middle.y + dice.between(-1.2F, 1.2F)},
            ceiling, 6.0F);
        break;
    case RoomKind::corridor:
    case RoomKind::fallen:
        if (!room.is_roofed()) {
            break;
        }
        for (int z = 0; z < modules.y; ++z) {
            for (int x = 0; x < modules.x; ++x) {
                hanger.lamp({low.x + module_m * (static_cast<float>(x) + 0.5F), floor_m + 2.9F,
                             low.y + module_m * (static_cast<float>(z) + 0.5F)},
                            ceiling, 5.5F);
            }
        }
        break;
    case RoomKind::entrance:
    case RoomKind::hall:
    case RoomKind::last: {
        const bool is_great = room.kind != RoomKind::hall;
        const float in = 1.5F;
        const std::array<glm::vec2, 4> corners{{{low.x + in, low.y + in},
                                                {high.x - in, low.y + in},
                                                {high.x - in, high.y - in},
                                                {low.x + in, high.y - in}}};
        for (size_t i = 0; i < corners.size(); ++i) {
            // In each of the two great halls, only one fire casts shadows.
            const bool throws_shadows = is_great && i == (room.kind == RoomKind::last ? 0U : 1U);
            if (is_great || i % 2 == 0) {
                hanger.brazier({corners[i].x, floor_m, corners[i].y}, is_great ? 32.0F : 24.0F,
                               throws_shadows);
            }
        }
        // Lamps hang along the middle of the hall, where no columns stand.
        const bool is_along_x = modules.x >= modules.y;
        for (int i = 0; i < std::max(modules.x, modules.y); i += 2) {
            const float along = module_m * (static_cast<float>(i) + 0.5F);
            hanger.lamp({is_along_x ? low.x + along : middle.x, floor_m + 0.62F * room.height_m,
                         is_along_x ? middle.y : low.y + along},
                        ceiling, 14.0F);
        }
        if (const std::optional<glm::vec2> hole = shaft_of(plan, index)) {
            hanger.shaft({hole->x, ceiling, hole->y}, room.height_m);
        }
        break;
    }
    }
}

void add_flame(Kit& kit, const glm::vec3& place_m, float height_m)
{
    const float h = height_m;
    const std::array<glm::vec2, 6> drop{{{0.0F, 0.0F},
                                         {0.3F * h, 0.15F * h},
                                         {0.38F * h, 0.42F * h},
                                         {0.22F * h, 0.9F * h},
                                         {0.07F * h, 1.5F * h},
                                         {0.0F, 1.9F * h}}};
    kit.add(Stuff::flame, shapes::lathe(drop, 10, 2.0F), at(place_m));
}

} // namespace

Kit build_flame(bool is_fire)
{
    Kit kit;
    add_flame(kit, {}, is_fire ? 0.2F : 0.1F);
    if (is_fire) {
        for (const glm::vec3 tongue : {glm::vec3(0.17F, -0.01F, 0.1F), glm::vec3(-0.13F, -0.01F, 0.14F),
                                       glm::vec3(-0.05F, -0.01F, -0.19F)}) {
            add_flame(kit, tongue, 0.12F);
        }
    }
    return kit;
}

Lamps hang_lamps(const Plan& plan, uint64_t seed)
{
    Dice dice(seed, 40);
    Lamps lamps;
    Hanger hanger(lamps);
    for (size_t i = 0; i < plan.rooms.size(); ++i) {
        light_room(hanger, plan, static_cast<int>(i), dice);
    }
    return lamps;
}

namespace {

constexpr double seen_within_m = 26.0;
constexpr double box_half_m = 1.8;  ///< Half the size of the box in which the brazier's smoke is simulated
constexpr float over_foot_m = 0.1F; ///< Height of the smoke box's floor above the foot of the fire

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
