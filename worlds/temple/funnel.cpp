// SPDX-License-Identifier: MIT
#include "funnel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace temple {
namespace {

using estampe::Index;
using estampe::Primitive;

constexpr int ring_count = 12; ///< one over the other, the first at the foot
constexpr uint32_t skin_columns = 40;
constexpr uint32_t skin_rows = 44;
constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr double hidden_deep_m = 200.0; ///< below the ground, where it is none

double joint_share(int joint)
{
    return static_cast<double>(joint) / (ring_count - 1);
}

/// How far from the middle the skin is, in shares of the radius: strands of sand wind about it, which tear
/// its upper end.
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
    constexpr double rises_m = 8.0; // of a strand in one turn; strokes meet where the skin closes
    constexpr double tiny = 1e-3;
    for (uint32_t row = 0; row <= skin_rows; ++row) {
        const double share = static_cast<double>(row) / skin_rows;
        for (uint32_t column = 0; column <= skin_columns; ++column) {
            const double angle = whole_turn * column / skin_columns;
            part.positions.emplace_back(skin_at(share, angle));
            const glm::vec3 around = skin_at(share, angle + tiny) - skin_at(share, angle - tiny);
            const glm::vec3 up = skin_at(share + tiny, angle) - skin_at(share - tiny, angle);
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

} // namespace

glm::dvec2 funnel_sway_m(double share, double time_s)
{
    const glm::dvec2 ahead(wind_way());
    const glm::dvec2 aside(-ahead.y, ahead.x);
    return share * (9.0 * share * ahead + 4.5 * std::sin(0.55 * time_s + 3.6 * share) * aside +
                    2.6 * std::sin(0.83 * time_s + 5.2 * share) * ahead);
}

double funnel_radius_m(double share)
{
    // A thin foot, a trunk that widens slowly, and a mouth.
    return 0.8 + 3.2 * share + 11.0 * std::pow(share, 3.5) + 1.5 * std::exp(-60.0 * share * share);
}

double funnel_turn_rad(double share, double time_s)
{
    return 2.1 * time_s - 0.9 * share;
}

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

std::vector<estampe::NodePlace> funnel_places(Index first, const Tornado& tornado, double ground_m,
                                              double time_s)
{
    std::vector<estampe::NodePlace> places;
    const auto strength = static_cast<double>(tornado.strength);
    const bool is_there = strength > 0.03;
    // It comes down from above as a thread, and goes as one.
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

} // namespace temple
