// SPDX-License-Identifier: MIT
#include "features/cloth/seen_bodies.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "shaders/mesh.glsl.h"

namespace estampe::features {
namespace {

constexpr uint32_t most_nodes = 192; // along the longest side of a body

/// The joint that no other of a skin is above.
Index root_of(const Scene& scene, const Skin& skin)
{
    for (const Index joint : skin.joints) {
        if (std::ranges::find(skin.joints, scene.nodes[joint].parent) == skin.joints.end()) {
            return joint;
        }
    }
    return no_index;
}

/// The skeleton of a draw that is a body's, or none.
Index skeleton_of(const Scene& scene, const pose::DrawSource& source)
{
    const Node& node = scene.nodes[source.node];
    if (node.skin >= scene.skins.size() || source.instance != 0) {
        return no_index;
    }
    const Primitive& primitive = scene.meshes[node.mesh].primitives[source.primitive];
    const bool is_body =
        primitive.topology == Topology::triangles && cloth_of(scene, node, primitive) == nullptr;
    return is_body ? root_of(scene, scene.skins[node.skin]) : no_index;
}

std::vector<double> areas_of(const Primitive& primitive)
{
    std::vector<double> areas_m2(primitive.positions.size(), 0.0);
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::array corners{primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]};
        const glm::vec3& from = primitive.positions.at(corners[0]);
        const double area_m2 = glm::length(
            glm::cross(primitive.positions.at(corners[1]) - from, primitive.positions.at(corners[2]) - from));
        for (const uint32_t corner : corners) {
            areas_m2[corner] += area_m2 / 6.0;
        }
    }
    return areas_m2;
}

/// What each joint of a draw's skin moves.
void append_parts(const Primitive& primitive, uint32_t draw, std::vector<SeenBody::Part>& parts)
{
    std::map<uint32_t, SeenBody::Part> of_joint;
    const std::vector<double> areas_m2 = areas_of(primitive);
    const auto gather = [&](const std::vector<glm::u16vec4>& joints, const std::vector<glm::vec4>& weights) {
        for (size_t i = 0; i < std::min({joints.size(), weights.size(), primitive.positions.size()}); ++i) {
            for (int k = 0; k < 4; ++k) {
                if (!(weights[i][k] > 0.0F)) {
                    continue;
                }
                const glm::vec3& place = primitive.positions[i];
                const uint32_t joint = joints[i][k];
                SeenBody::Part& part =
                    of_joint
                        .try_emplace(
                            joint,
                            SeenBody::Part{.draw = draw, .joint = joint, .min_m = place, .max_m = place})
                        .first->second;
                part.min_m = glm::min(part.min_m, place);
                part.max_m = glm::max(part.max_m, place);
                part.area_m2 += double{weights[i][k]} * areas_m2[i];
            }
        }
    };
    gather(primitive.joints_0, primitive.weights_0);
    gather(primitive.joints_1, primitive.weights_1);
    for (const auto& [joint, part] : of_joint) {
        parts.push_back(part);
    }
}

/// Turns z to the shortest of three sides.
glm::quat turn_to_shortest(const glm::vec3& sides)
{
    constexpr float half = 0.70710678F; // of a right angle, its cosine and its sine
    if (sides.z <= sides.x && sides.z <= sides.y) {
        return {1.0F, 0.0F, 0.0F, 0.0F};
    }
    return sides.x <= sides.y ? glm::quat(half, 0.0F, half, 0.0F) : glm::quat(half, -half, 0.0F, 0.0F);
}

void finish(SeenBody& body)
{
    const auto most =
        std::ranges::max_element(body.parts, {}, [](const SeenBody::Part& part) { return part.area_m2; });
    std::iter_swap(body.parts.begin(), most);
    glm::vec3 min_m = body.parts.front().min_m;
    glm::vec3 max_m = body.parts.front().max_m;
    for (const SeenBody::Part& part : body.parts) {
        min_m = glm::min(min_m, part.min_m);
        max_m = glm::max(max_m, part.max_m);
    }
    body.solid = {.kind = cloth::SolidKind::seen,
                  .centre_m = 0.5F * (min_m + max_m),
                  .rotation = turn_to_shortest(max_m - min_m)};
    const glm::vec2 sides(glm::abs(glm::inverse(body.solid.rotation) * (max_m - min_m)));
    const float node_m = std::max({sides.x, sides.y, 1e-6F}) / static_cast<float>(most_nodes);
    body.mesh.nodes = glm::uvec2(glm::max(glm::ceil(sides / node_m), glm::vec2(8.0F)));
}

} // namespace

std::vector<SeenBody> seen_bodies(const Scene& scene, const pose::MeshData& layout)
{
    std::vector<SeenBody> bodies;
    std::map<Index, size_t> of_skeleton;
    std::map<uint32_t, size_t> of_draw;
    for (uint32_t draw = 0; draw < layout.sources.size(); ++draw) {
        const pose::DrawSource& source = layout.sources[draw];
        const Index skeleton = skeleton_of(scene, source);
        if (skeleton == no_index) {
            continue;
        }
        const auto [found, is_new] = of_skeleton.try_emplace(skeleton, bodies.size());
        if (is_new) {
            bodies.emplace_back();
        }
        of_draw[draw] = found->second;
        append_parts(scene.meshes[scene.nodes[source.node].mesh].primitives[source.primitive], draw,
                     bodies[found->second].parts);
    }
    for (const glm::uvec4& triangle : layout.triangles) {
        const auto found = of_draw.find(triangle.w & shared::triangle_draw_mask);
        if (found != of_draw.end()) {
            bodies[found->second].mesh.triangles.emplace_back(triangle);
        }
    }
    std::erase_if(bodies,
                  [](const SeenBody& body) { return body.parts.empty() || body.mesh.triangles.empty(); });
    std::ranges::for_each(bodies, finish);
    return bodies;
}

cloth::Solid placed_body(const SeenBody& body, const pose::MeshData& layout, const pose::PoseData& pose,
                         uint32_t number)
{
    const auto matrix_of = [&](const SeenBody::Part& part) {
        return glm::dmat4(pose.joints.at(layout.draws[part.draw].first_joint + part.joint));
    };
    cloth::Solid solid = cloth::placed(body.solid, matrix_of(body.parts.front()));
    const glm::dquat back(glm::inverse(solid.rotation));
    glm::dvec3 half_m(0.0);
    for (const SeenBody::Part& part : body.parts) {
        const glm::dmat4 place = matrix_of(part);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 upper((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
            const glm::dvec3 point(place * glm::dvec4(glm::mix(part.min_m, part.max_m, upper), 1.0));
            half_m = glm::max(half_m, glm::abs(back * (point - glm::dvec3(solid.centre_m))));
        }
    }
    constexpr double beside = 1.04; // room about what is seen
    solid.half_m = glm::vec3(beside * half_m + 1e-4);
    solid.grid = number;
    return solid;
}

} // namespace estampe::features
