// SPDX-License-Identifier: MIT
#include "demons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "demon_body.hpp"

namespace temple {
namespace {

using estampe::Index;

constexpr size_t most_cells = 6;
constexpr int forms = 3; ///< torn otherwise

/// Where smoke leaves it: joints of strands.
struct Wisp {
    int strand;
    int joint;
};

constexpr std::array<Wisp, 7> wisps{{{0, 3}, {0, 5}, {1, 4}, {2, 4}, {3, 4}, {4, 3}, {0, 1}}};

const size_t joint_count = rest_joints().size();

Haunt room_haunt(const Plan& plan, size_t room, float size)
{
    constexpr float wall_m = 0.6F;
    const float apart_m = wall_m + size * Demon::half_width_m;
    Haunt haunt{.low_m = plan.rooms[room].low_m() + apart_m,
                .high_m = plan.rooms[room].high_m() - apart_m,
                .pillars = {},
                .room = static_cast<int>(room),
                .is_cell = plan.rooms[room].kind == RoomKind::cell,
                .size = size};
    for (const PlacedColumn& column : plan.columns) {
        if (column.room == static_cast<int>(room)) {
            haunt.pillars.emplace_back(column.place_m,
                                       1.42F * foot_half_m(column.column) + size * Demon::half_width_m);
        }
    }
    return haunt;
}

/// On the sand, clear of what stands there.
Haunt sand_haunt(const Site& site, const glm::vec2& low, const glm::vec2& high, float size)
{
    Haunt haunt{.low_m = low, .high_m = high, .pillars = {}, .is_on_floor = false, .size = size};
    const float wide_m = size * Demon::half_width_m;
    for (const StandingColumn& column : site.columns) {
        haunt.pillars.emplace_back(column.place_m, 1.42F * foot_half_m(column.column) + wide_m);
    }
    for (const glm::vec3& drum : site.drums) {
        haunt.pillars.emplace_back(drum.x, drum.y, 1.9F + wide_m);
    }
    haunt.pillars.emplace_back(-5.4F, -4.0F, 1.6F + wide_m); // the figure
    for (const Sheet& sheet : site.sheets) {
        haunt.pillars.emplace_back(sheet.corner_m.x, sheet.corner_m.z, 0.3F + wide_m);
    }
    return haunt;
}

glm::dquat facing(const Demon& demon)
{
    return glm::angleAxis(static_cast<double>(demon.yaw_rad()), glm::dvec3(0.0, 1.0, 0.0));
}

glm::dquat nodding(const Demon& demon)
{
    return glm::angleAxis(static_cast<double>(demon.pitch_rad()), glm::dvec3(1.0, 0.0, 0.0));
}

} // namespace

std::vector<Haunt> find_haunts(const Plan& plan, const Site& site)
{
    std::vector<Haunt> haunts;
    const auto is_shut = [&](size_t room) {
        return std::ranges::any_of(plan.doors, [&](const Door& door) {
            return door.is_barred && (door.a == static_cast<int>(room) || door.b == static_cast<int>(room));
        });
    };
    for (const bool wants_shut : {true, false}) {
        for (size_t room = 0; room < plan.rooms.size() && haunts.size() < most_cells; ++room) {
            if (plan.rooms[room].kind == RoomKind::cell && is_shut(room) == wants_shut) {
                haunts.push_back(room_haunt(plan, room, 1.0F));
            }
        }
    }
    haunts.push_back(room_haunt(plan, static_cast<size_t>(plan.last_room), 1.5F));
    haunts.push_back(sand_haunt(site, {-15.5F, -6.0F}, {-7.5F, 8.0F}, 1.15F));
    haunts.push_back(sand_haunt(site, {1.5F, -13.0F}, {8.0F, 4.0F}, 1.0F));
    haunts.push_back(sand_haunt(site, {-3.6F, 50.0F}, {3.6F, 66.0F}, 1.1F));
    const glm::vec2 giant = site.colossus_m;
    haunts.push_back(sand_haunt(site, giant + glm::vec2(-7.0F, 18.0F), giant + glm::vec2(6.0F, 25.0F), 1.0F));
    haunts.push_back(sand_haunt(site, {-68.0F, 88.0F}, {-56.0F, 102.0F}, 1.1F));
    return haunts;
}

Demons::Demons(const Plan& plan, const Site& site, const estampe::Terrain& desert, uint64_t seed)
    : seed_(seed)
{
    const auto on_sand = [desert](const glm::vec2& place) {
        return static_cast<float>(desert.sample(place.x, place.y).height_m);
    };
    const auto on_floor = [](const glm::vec2&) { return floor_m; };
    for (const Haunt& haunt : find_haunts(plan, site)) {
        const Dice dice(seed, 200 + all_.size());
        all_.emplace_back(
            haunt, haunt.is_on_floor ? std::function<float(const glm::vec2&)>(on_floor) : on_sand, dice);
    }
}

void Demons::step(double seconds, const glm::dvec3& walker_m, const glm::vec2& wind_m_s)
{
    owed_s_ += std::max(seconds, 0.0);
    // A step that is all but due is taken: moments are sums of what has been rounded.
    for (; owed_s_ > Demon::step_s - 1e-9; owed_s_ -= Demon::step_s) {
        for (Demon& demon : all_) {
            demon.step(glm::vec3(walker_m), wind_m_s);
        }
    }
}

void Demons::add_to(estampe::Scene& scene) const
{
    const auto ink = static_cast<Index>(scene.materials.size());
    const Index pale = ink + 1;
    scene.materials.push_back(
        {.name = "demon", .base_color = {0.006F, 0.006F, 0.009F, 1.0F}, .metallic = 0.0F});
    scene.materials.back().double_sided = true;
    scene.materials.back().unlit = true;
    scene.materials.push_back(
        {.name = "demon's eye", .base_color = {0.93F, 0.9F, 0.72F, 1.0F}, .metallic = 0.0F});
    scene.materials.back().unlit = true;
    const auto first_mesh = static_cast<Index>(scene.meshes.size());
    for (int form = 0; form < forms; ++form) {
        scene.meshes.push_back(build_demon(Dice(seed_, 300 + static_cast<uint64_t>(form)), ink, pale));
    }
    std::vector<glm::mat4> joint_from_bind;
    for (const glm::vec3& joint : rest_joints()) {
        joint_from_bind.push_back(glm::translate(glm::mat4(1.0F), -joint));
    }
    const auto first = static_cast<Index>(scene.nodes.size());
    for (size_t i = 0; i < all_.size(); ++i) {
        const std::string number = std::to_string(i);
        const auto root = static_cast<Index>(scene.nodes.size());
        const auto add = [&](const std::string& name, Index parent) -> estampe::Node& {
            const auto index = static_cast<Index>(scene.nodes.size());
            estampe::Node& node = scene.nodes.emplace_back();
            node.name = name;
            node.parent = parent;
            if (parent != estampe::no_index) {
                scene.nodes[parent].children.push_back(index);
            }
            return node;
        };
        scene.roots.push_back(root);
        add("demon " + number, estampe::no_index);
        estampe::Skin skin{.name = "demon " + number, .joints = {}, .joint_from_bind = joint_from_bind};
        for (size_t joint = 0; joint < joint_count; ++joint) {
            // Eyes turn with the head.
            const bool is_eye = joint + 2 >= joint_count;
            skin.joints.push_back(static_cast<Index>(scene.nodes.size()));
            add("joint", is_eye ? root + 1 : root);
        }
        for (const Wisp& wisp : wisps) {
            add("wisp " + number,
                root + 1 + static_cast<Index>(first_joint(wisp.strand)) + static_cast<Index>(wisp.joint));
        }
        add("stain " + number, root);
        estampe::Node& shown = add("body of demon " + number, root);
        shown.mesh = first_mesh + static_cast<Index>(i % forms);
        shown.skin = static_cast<Index>(scene.skins.size());
        scene.skins.push_back(std::move(skin));
    }
    for (const estampe::NodePlace& place : places(first)) {
        scene.nodes[place.node].transform = place.transform;
    }
}

std::vector<estampe::NodePlace> Demons::places(Index first,
                                               const std::function<bool(const Demon&)>& is_hidden) const
{
    std::vector<estampe::NodePlace> places;
    Index node = first;
    const auto put = [&](const glm::dvec3& place, const glm::dquat& turned, const glm::dvec3& scale) {
        places.push_back({node++, {.translation = place, .rotation = turned, .scale = scale}});
    };
    constexpr glm::dquat straight(1.0, 0.0, 0.0, 0.0);
    for (const Demon& demon : all_) {
        const Index root = node;
        const auto size = static_cast<double>(demon.haunt().size);
        const bool is_gone = demon.mood() == Mood::gone || (is_hidden && is_hidden(demon));
        const auto left = static_cast<double>(demon.body());
        // Running out it grows thin, and sinks.
        const double thin = std::max(std::sqrt(std::max(left, 0.0)), 1e-3);
        const glm::dvec3 head(demon.head());
        const glm::dquat turned = facing(demon);
        put(head, turned, glm::dvec3(is_gone ? 1e-3 * size : size));
        for (int strand = 0; strand < strand_count; ++strand) {
            for (const glm::vec3& joint : demon.joints(strand)) {
                const glm::dvec3 local = glm::conjugate(turned) * (glm::dvec3(joint) - head) / size;
                const bool is_head = node == root + 1;
                const glm::dquat nod = is_head ? nodding(demon) : straight;
                put(local, nod, glm::dvec3(thin));
            }
        }
        for (const size_t eye : {joint_count - 2, joint_count - 1}) {
            const auto open = static_cast<double>(demon.eyes());
            put(glm::dvec3(rest_joints()[eye]), straight, {0.6 + 0.4 * open, std::max(open, 0.02), 1.0});
        }
        // They are turned against each other, so that no two streams look alike; upwards on the whole.
        for (size_t i = 0; i < wisps.size(); ++i) {
            const double lean = wisps[i].strand == 0 ? 0.5 : 1.1;
            const glm::dquat aside = glm::angleAxis(2.4 * static_cast<double>(i), glm::dvec3(0.0, 1.0, 0.0)) *
                                     glm::angleAxis(-lean, glm::dvec3(1.0, 0.0, 0.0));
            put(glm::dvec3(0.0), aside, glm::dvec3(is_gone ? 0.0 : (0.5 + 0.5 * left) / thin));
        }
        const double ground_m = -static_cast<double>(Demon::head_m) * (1.0 - 0.55 * (1.0 - left));
        put({0.0, ground_m + 0.1, 0.0}, straight,
            glm::dvec3(is_gone ? 0.0 : static_cast<double>(demon.stain_m()) / size));
        put(glm::dvec3(0.0), straight, glm::dvec3(1.0));
    }
    return places;
}

std::vector<Hollow> Demons::hollows() const
{
    std::vector<Hollow> hollows;
    for (const Demon& demon : all_) {
        if (!demon.haunt().is_on_floor) {
            hollows.push_back(
                {demon.place_m(), 0.42F * demon.haunt().size * demon.body(), 1.5F * demon.haunt().size});
        }
    }
    return hollows;
}

} // namespace temple
