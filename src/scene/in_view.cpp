// SPDX-License-Identifier: MIT
#include "scene/in_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/pose.hpp"

namespace estampe {
namespace {

/// The five sides of what a camera sees; there is no far one.
class View {
public:
    View(const Camera& camera, double aspect)
        : view_from_world_(glm::lookAt(camera.eye, camera.target, camera.up))
    {
        constexpr double margin = 1.02; // lines are drawn beside what they outline
        if (camera.orthographic_half_height_m) {
            const double half_m = margin * *camera.orthographic_half_height_m;
            sides_ = {glm::dvec4(1, 0, 0, aspect * half_m), glm::dvec4(-1, 0, 0, aspect * half_m),
                      glm::dvec4(0, 1, 0, half_m), glm::dvec4(0, -1, 0, half_m)};
            return;
        }
        const double up = margin * std::tan(0.5 * camera.vertical_fov_rad);
        sides_ = {glm::dvec4(1, 0, -aspect * up, 0), glm::dvec4(-1, 0, -aspect * up, 0),
                  glm::dvec4(0, 1, -up, 0), glm::dvec4(0, -1, -up, 0)};
        near_m_ = camera.near_m;
    }

    /// Whether all points are on the outer side of one of the sides.
    [[nodiscard]] bool excludes(std::span<const glm::dvec3> points) const
    {
        std::array<bool, 5> outside{true, true, true, true, true};
        for (const glm::dvec3& point : points) {
            const glm::dvec4 seen = view_from_world_ * glm::dvec4(point, 1.0);
            for (size_t side = 0; side < sides_.size(); ++side)
                outside[side] = outside[side] && glm::dot(sides_[side], seen) < 0.0;
            outside[4] = outside[4] && -seen.z < near_m_;
            if (std::find(outside.begin(), outside.end(), true) == outside.end())
                return false;
        }
        return true;
    }

private:
    glm::dmat4 view_from_world_;
    std::array<glm::dvec4, 4> sides_{};
    double near_m_ = -std::numeric_limits<double>::infinity(); ///< a parallel projection shows all depths
};

Bounds bounds_at_rest(const Mesh& mesh)
{
    Bounds bounds;
    for (const Primitive& primitive : mesh.primitives)
        for (const glm::vec3& position : primitive.positions)
            bounds.extend(position);
    return bounds;
}

bool bends(const Scene& scene, const Node& node)
{
    const Mesh& mesh = scene.meshes[node.mesh];
    return node.skin != no_index ||
           std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const Primitive& primitive) { return !primitive.morph_targets.empty(); });
}

std::array<glm::dvec3, 8> corners_of(const Bounds& box, const glm::dmat4& world_from_box)
{
    std::array<glm::dvec3, 8> corners;
    for (size_t i = 0; i < corners.size(); ++i)
        corners[i] = glm::dvec3(world_from_box * glm::dvec4((i & 1) != 0 ? box.max.x : box.min.x,
                                                            (i & 2) != 0 ? box.max.y : box.min.y,
                                                            (i & 4) != 0 ? box.max.z : box.min.z, 1.0));
    return corners;
}

bool sees_node(const View& view, const Node& node, const Bounds& box, const glm::dmat4& world_from_node)
{
    if (box.empty())
        return false;
    if (node.instances.empty())
        return !view.excludes(corners_of(box, world_from_node));
    return std::any_of(node.instances.begin(), node.instances.end(), [&](const glm::mat4& instance) {
        return !view.excludes(corners_of(box, world_from_node * glm::dmat4(instance)));
    });
}

} // namespace

bool may_see_anything(const Scene& scene, const ScenePose& pose, const Camera& camera, double aspect)
{
    if (scene.terrain || scene.meshes.empty())
        return true;
    const View view(camera, aspect);
    std::vector<std::optional<Bounds>> boxes(scene.meshes.size());
    bool any_bends = false;
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        const Node& node = scene.nodes[index];
        if (node.mesh == no_index)
            continue;
        if (bends(scene, node)) {
            any_bends = true;
            continue;
        }
        std::optional<Bounds>& box = boxes[node.mesh];
        if (!box)
            box = bounds_at_rest(scene.meshes[node.mesh]);
        if (sees_node(view, node, *box, pose.world_from_node[index]))
            return true;
    }
    bool sees_bent = false;
    if (any_bends)
        visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
            sees_bent = sees_bent || !view.excludes(posed.positions);
        });
    return sees_bent;
}

} // namespace estampe
