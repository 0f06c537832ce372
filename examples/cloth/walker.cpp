// SPDX-License-Identifier: MIT
#include "walker.hpp"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "kit.hpp"

namespace kit {
namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): this whole file uses one library

constexpr float pi = std::numbers::pi_v<float>;

enum Joint : uint16_t {
    hips,
    chest,
    crown,
    left_shoulder,
    left_elbow,
    left_hand,
    right_shoulder,
    right_elbow,
    right_hand,
    left_hip,
    left_knee,
    left_foot,
    right_hip,
    right_knee,
    right_foot,
    joint_count
};

struct Bind {
    Joint parent;
    glm::vec3 place_m;
};

/// The first joint is the root, which is its own parent.
constexpr std::array<Bind, joint_count> binds{{{hips, {0.0F, 0.95F, 0.0F}},
                                               {hips, {0.0F, 1.38F, 0.0F}},
                                               {chest, {0.0F, 1.66F, 0.0F}},
                                               {chest, {0.21F, 1.38F, 0.0F}},
                                               {left_shoulder, {0.25F, 1.1F, 0.0F}},
                                               {left_elbow, {0.26F, 0.85F, 0.0F}},
                                               {chest, {-0.21F, 1.38F, 0.0F}},
                                               {right_shoulder, {-0.25F, 1.1F, 0.0F}},
                                               {right_elbow, {-0.26F, 0.85F, 0.0F}},
                                               {hips, {0.1F, 0.88F, 0.0F}},
                                               {left_hip, {0.1F, 0.48F, 0.0F}},
                                               {left_knee, {0.1F, 0.08F, 0.0F}},
                                               {hips, {-0.1F, 0.88F, 0.0F}},
                                               {right_hip, {-0.1F, 0.48F, 0.0F}},
                                               {right_knee, {-0.1F, 0.08F, 0.0F}}}};

struct Limb {
    Joint from;
    Joint to;
    float radius_m;
};

constexpr std::array<Limb, 12> limbs{{{hips, chest, 0.15F},
                                      {chest, crown, 0.1F},
                                      {chest, left_shoulder, 0.07F},
                                      {chest, right_shoulder, 0.07F},
                                      {left_shoulder, left_elbow, 0.055F},
                                      {left_elbow, left_hand, 0.045F},
                                      {right_shoulder, right_elbow, 0.055F},
                                      {right_elbow, right_hand, 0.045F},
                                      {left_hip, left_knee, 0.085F},
                                      {left_knee, left_foot, 0.065F},
                                      {right_hip, right_knee, 0.085F},
                                      {right_knee, right_foot, 0.065F}}};

/// Adds a capsule around a bone. The capsule moves with the joint at which the bone begins.
void add_limb(Primitive& body, const Limb& limb)
{
    const glm::vec3 from = binds.at(limb.from).place_m;
    const glm::vec3 to = binds.at(limb.to).place_m;
    const glm::vec3 along = glm::normalize(to - from);
    const glm::vec3 aside = glm::normalize(glm::cross(along, glm::vec3(0.0F, 0.0F, 1.0F)));
    const glm::vec3 across = glm::cross(along, aside);
    constexpr uint32_t segments = 16;
    constexpr uint32_t rings = 12; // rings of both round ends together
    for (uint32_t ring = 0; ring <= rings; ++ring) {
        const float polar = pi * static_cast<float>(ring) / rings;
        const glm::vec3 end = 2 * ring < rings ? from : to;
        for (uint32_t i = 0; i <= segments; ++i) {
            const float angle = 2.0F * pi * static_cast<float>(i % segments) / segments;
            const glm::vec3 normal = std::sin(polar) * (std::cos(angle) * aside + std::sin(angle) * across) -
                                     std::cos(polar) * along;
            if (ring < rings && i < segments) {
                const auto k = static_cast<uint32_t>(body.positions.size());
                const auto corners = {k, k + 1, k + segments + 1, k + 1, k + segments + 2, k + segments + 1};
                body.indices.insert(body.indices.end(), corners.begin(), corners.end());
            }
            body.positions.push_back(end + limb.radius_m * normal);
            body.normals.push_back(normal);
            body.uvs[0].emplace_back(limb.radius_m * angle, glm::dot(body.positions.back() - from, along));
            body.joints_0.emplace_back(limb.from, 0, 0, 0);
            body.weights_0.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
        }
    }
}

/// Swings a joint about x, `lead` of a stride ahead. Knees and elbows bend in one direction only.
AnimationChannel swing(Index node, float most_rad, float middle_rad, float lead)
{
    AnimationChannel channel{.node = node, .path = AnimatedPath::rotation};
    for (int i = 0; i <= 64; ++i) {
        const float time_s = 0.0625F * static_cast<float>(i);
        const float angle = middle_rad + most_rad * std::sin(2.0F * pi * (time_s + lead));
        channel.times_s.push_back(time_s);
        for (const float part : {std::sin(0.5F * angle), 0.0F, 0.0F, std::cos(0.5F * angle)}) {
            channel.values.push_back(part);
        }
    }
    return channel;
}

} // namespace

Walker add_walker(Scene& scene, glm::dvec3 foot_m)
{
    Primitive body;
    for (const Limb& limb : limbs) {
        add_limb(body, limb);
    }
    Skin skin{.name = "walker"};
    const auto first = static_cast<Index>(scene.nodes.size());
    for (uint16_t i = 0; i < joint_count; ++i) {
        const Bind& own = binds.at(i);
        const glm::vec3 parent_m = i == 0 ? -glm::vec3(foot_m) : binds.at(own.parent).place_m;
        scene.nodes.push_back({.name = "joint", .transform = {.translation = own.place_m - parent_m}});
        if (i == 0) {
            scene.roots.push_back(first);
        } else {
            scene.nodes[first + i].parent = first + own.parent;
            scene.nodes[first + own.parent].children.push_back(first + i);
        }
        skin.joints.push_back(first + i);
        skin.joint_from_bind.push_back(glm::translate(glm::mat4(1.0F), -own.place_m));
    }
    AnimationChannel go{.node = first, .path = AnimatedPath::translation};
    for (int i = 0; i <= 64; ++i) {
        const float time_s = 0.0625F * static_cast<float>(i);
        const float bob_m = 0.02F * std::cos(4.0F * pi * time_s);
        go.times_s.push_back(time_s);
        const glm::vec3 place = glm::vec3(foot_m) + binds.front().place_m;
        go.values.insert(go.values.end(), {place.x, place.y + bob_m, place.z + 1.2F * time_s});
    }
    scene.animations.push_back({.name = "walk",
                                .channels = {go, swing(first + left_hip, 0.45F, 0.0F, 0.0F),
                                             swing(first + right_hip, 0.45F, 0.0F, 0.5F),
                                             swing(first + left_knee, 0.3F, 0.35F, 0.35F),
                                             swing(first + right_knee, 0.3F, 0.35F, 0.85F),
                                             swing(first + left_shoulder, 0.4F, 0.0F, 0.5F),
                                             swing(first + right_shoulder, 0.4F, 0.0F, 0.0F),
                                             swing(first + left_elbow, 0.15F, -0.35F, 0.5F),
                                             swing(first + right_elbow, 0.15F, -0.35F, 0.0F)},
                                .duration_s = 4.0F});
    const auto skin_index = static_cast<Index>(scene.skins.size());
    scene.skins.push_back(std::move(skin));
    scene.nodes[add(scene, "walker", std::move(body), {})].skin = skin_index;
    return {.skin = skin_index, .chest = chest};
}

void bind(Primitive& primitive, uint16_t joint)
{
    primitive.joints_0.assign(primitive.positions.size(), {joint, 0, 0, 0});
    primitive.weights_0.assign(primitive.positions.size(), {1.0F, 0.0F, 0.0F, 0.0F});
}

} // namespace kit
