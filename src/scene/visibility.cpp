// SPDX-License-Identifier: MIT
#include "scene/visibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/pose.hpp"

namespace estampe {

std::vector<bool> visible_nodes(const Scene& scene)
{
    std::vector<bool> visible;
    visible.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        visible.push_back(node.visible);
    }
    std::vector<Index> open = scene.roots;
    while (!open.empty()) {
        const Index index = open.back();
        open.pop_back();
        for (const Index child : scene.nodes[index].children) {
            visible[child] = visible[child] && visible[index];
            open.push_back(child);
        }
    }
    return visible;
}

void hide_invisible(Scene& scene)
{
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!visible[i]) {
            Node& node = scene.nodes[i];
            node.visible = false;
            node.mesh = node.skin = node.light = no_index;
            node.instances.clear();
        }
    }
}

bool has_visible_light(const Scene& scene)
{
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (visible[i] && scene.nodes[i].light != no_index) {
            return true;
        }
    }
    return false;
}

namespace {

/// Largest number of triangles to test. The number is limited, so that the test does not take longer than
/// drawing the scene.
constexpr size_t most_triangles = 4'000'000;

/// The planes that bound a camera's view: four sides and the near plane. There is no far plane.
class View {
public:
    View(const Camera& camera, double aspect)
        : view_from_world_(glm::lookAt(camera.eye, camera.target, camera.up))
    {
        // Factor that widens the view, because drawn lines extend beyond the surfaces that they outline.
        constexpr double margin = 1.02;
        // Edges of the picture, in halves of its width and height from the axis of view.
        const double left = 2.0 * camera.shift.x - margin;
        const double right = 2.0 * camera.shift.x + margin;
        const double bottom = 2.0 * camera.shift.y - margin;
        const double top = 2.0 * camera.shift.y + margin;
        if (camera.orthographic_half_height_m) {
            const double half_m = *camera.orthographic_half_height_m;
            sides_ = {glm::dvec4(1, 0, 0, -left * aspect * half_m),
                      glm::dvec4(-1, 0, 0, right * aspect * half_m), glm::dvec4(0, 1, 0, -bottom * half_m),
                      glm::dvec4(0, -1, 0, top * half_m)};
            return;
        }
        const double up = std::tan(0.5 * camera.vertical_fov_rad);
        sides_ = {glm::dvec4(1, 0, left * aspect * up, 0), glm::dvec4(-1, 0, -right * aspect * up, 0),
                  glm::dvec4(0, 1, bottom * up, 0), glm::dvec4(0, -1, -top * up, 0)};
        near_m_ = camera.near_m;
        has_eye_ = true;
    }

    /// Returns the same view in the space of a mesh whose transform is `world_from_mesh`.
    [[nodiscard]] View within(const glm::dmat4& world_from_mesh) const
    {
        View view = *this;
        view.view_from_world_ *= world_from_mesh;
        return view;
    }

    /// Returns whether all points are outside of the same plane, so that nothing between them is in view.
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

    /// Returns whether some part of the triangle is inside all planes. The function is slower than
    /// excludes(), but exact: a large triangle can be out of view although its corners are outside of
    /// different planes.
    [[nodiscard]] bool holds_part_of(const std::array<glm::dvec3, 3>& corners) const
    {
        std::vector<glm::dvec4> polygon(corners.size());
        std::transform(corners.begin(), corners.end(), polygon.begin(),
                       [&](const glm::dvec3& corner) { return view_from_world_ * glm::dvec4(corner, 1.0); });
        for (size_t side = 0; side <= sides_.size(); ++side) {
            const auto depth_in = [&](const glm::dvec4& point) {
                return side < sides_.size() ? glm::dot(sides_[side], point) : -point.z - near_m_;
            };
            std::vector<glm::dvec4> kept;
            for (size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec4& from = polygon[i];
                const glm::dvec4& to = polygon[(i + 1) % polygon.size()];
                const double from_m = depth_in(from);
                const double to_m = depth_in(to);
                if (from_m >= 0.0)
                    kept.push_back(from);
                if ((from_m < 0.0) != (to_m < 0.0))
                    kept.push_back(glm::mix(from, to, from_m / (from_m - to_m)));
            }
            polygon = std::move(kept);
        }
        return !polygon.empty();
    }

    /// Returns whether the projected corners are in counter-clockwise order on the page.
    [[nodiscard]] bool is_counterclockwise(const std::array<glm::dvec3, 3>& corners) const
    {
        const auto placed = [this](const glm::dvec3& corner) {
            return glm::dvec3(view_from_world_ * glm::dvec4(corner, 1.0));
        };
        const glm::dvec3 a = placed(corners[0]);
        const glm::dvec3 normal = glm::cross(placed(corners[1]) - a, placed(corners[2]) - a);
        return has_eye_ ? glm::dot(normal, a) < 0.0 : normal.z > 0.0;
    }

    /// Returns whether the box contains the eye. Returns false for a parallel projection, which has no eye.
    [[nodiscard]] bool has_eye_in(const Bounds& box) const
    {
        const glm::dvec3 eye(glm::inverse(view_from_world_)[3]);
        return has_eye_ && glm::all(glm::greaterThan(eye, box.min)) && glm::all(glm::lessThan(eye, box.max));
    }

private:
    glm::dmat4 view_from_world_;
    std::array<glm::dvec4, 4> sides_{};
    /// Distance of the near plane; a parallel projection has no near plane.
    double near_m_ = -std::numeric_limits<double>::infinity();
    bool has_eye_ = false;
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

/// A primitive of a node.
struct PlacedPrimitive {
    Index node = no_index;
    const Primitive* primitive = nullptr;
    bool mirrored = false; ///< the transform is a mirroring, which reverses the winding of triangles
};

class Search {
public:
    Search(const Scene& scene, const View& view) : scene_(scene), view_(view) {}

    [[nodiscard]] bool has_ended() const { return found_.content == ViewContent::something; }

    [[nodiscard]] const InView& found() const { return found_; }

    /// Tests a mesh that does not deform. `box` is its bounding box in mesh space.
    void look_at_mesh(Index node, const Bounds& box, const glm::dmat4& world_from_mesh)
    {
        const auto corners = corners_of(box, world_from_mesh);
        if (view_.excludes(corners))
            return;
        const View view = view_.within(world_from_mesh);
        const bool mirrored = glm::determinant(glm::dmat3(world_from_mesh)) < 0.0;
        const auto corner_at = [&](const Primitive& primitive) {
            return [&primitive](uint32_t vertex) { return glm::dvec3(primitive.positions[vertex]); };
        };
        bool has_backs = false;
        for (const Primitive& primitive : scene_.meshes[scene_.nodes[node].mesh].primitives)
            has_backs |= look_at({node, &primitive, mirrored}, view, corner_at(primitive));
        if (has_backs)
            note_backs(node, view.has_eye_in(box), glm::length(corners.front() - corners.back()));
    }

    /// Tests a primitive that deforms, by a skin or morph targets.
    void look_at_posed(const PosedPrimitive& posed)
    {
        if (has_ended() || view_.excludes(posed.positions))
            return;
        const auto corner = [&](uint32_t vertex) { return posed.positions[vertex]; };
        if (!look_at({posed.node, posed.primitive, posed.mirrored}, view_, corner))
            return;
        Bounds box;
        for (const glm::dvec3& position : posed.positions)
            box.extend(position);
        note_backs(posed.node, view_.has_eye_in(box), 2.0 * box.radius());
    }

private:
    /// Tests the triangles of a primitive. Returns whether back faces are in view. `corner` returns the
    /// position of a vertex in the space of `view`.
    template <typename Corner>
    bool look_at(const PlacedPrimitive& placed, const View& view, const Corner& corner)
    {
        const Primitive& primitive = *placed.primitive;
        const bool moves_as_cloth = cloth_of(scene_, scene_.nodes[placed.node], primitive) != nullptr;
        if (primitive.topology != Topology::triangles || moves_as_cloth) {
            // Lines and points are drawn wider than their geometry, and cloth moves away from its rest
            // position. Therefore lines, points and cloth always count as in view.
            found_.content = ViewContent::something;
            return false;
        }
        const bool two_sided = scene_.materials[primitive.material].double_sided;
        bool has_backs = false;
        for (size_t i = 0; i + 2 < primitive.indices.size() && !has_ended(); i += 3) {
            const std::array corners{corner(primitive.indices[i]), corner(primitive.indices[i + 1]),
                                     corner(primitive.indices[i + 2])};
            const bool is_drawn = two_sided || view.is_counterclockwise(corners) != placed.mirrored;
            const auto is_in_view = [&] { return !view.excludes(corners) && view.holds_part_of(corners); };
            const bool is_too_much = ++triangles_ > most_triangles;
            if (is_too_much || (is_drawn && is_in_view()))
                found_.content = ViewContent::something;
            else if (!is_drawn && !has_backs)
                has_backs = is_in_view();
        }
        return has_backs;
    }

    void note_backs(Index node, bool holds_eye, double size_m)
    {
        if (has_ended())
            return;
        const bool is_better =
            found_.content == ViewContent::nothing || (holds_eye && (!found_.holds_eye || size_m < size_m_));
        if (!is_better)
            return;
        found_ = {ViewContent::backs_only, node, holds_eye};
        size_m_ = size_m;
    }

    const Scene& scene_;
    const View& view_;
    InView found_;
    double size_m_ = 0.0; ///< size of the bounding box of the node found_.backs_of
    size_t triangles_ = 0;
};

} // namespace

InView find_in_view(const Scene& scene, const ScenePose& pose, const Camera& camera, double aspect)
{
    if (scene.terrain || scene.meshes.empty())
        return {.content = ViewContent::something};
    const View view(camera, aspect);
    Search search(scene, view);
    std::vector<std::optional<Bounds>> boxes(scene.meshes.size());
    const std::vector<bool> visible = visible_nodes(scene);
    bool any_bends = false;
    for (Index index = 0; index < scene.nodes.size() && !search.has_ended(); ++index) {
        const Node& node = scene.nodes[index];
        if (!visible[index] || node.mesh == no_index)
            continue;
        if (bends(scene, node)) {
            any_bends = true;
            continue;
        }
        std::optional<Bounds>& box = boxes[node.mesh];
        if (!box)
            box = bounds_at_rest(scene.meshes[node.mesh]);
        if (box->empty())
            continue;
        if (node.instances.empty())
            search.look_at_mesh(index, *box, pose.world_from_node[index]);
        for (size_t i = 0; i < node.instances.size() && !search.has_ended(); ++i)
            search.look_at_mesh(index, *box, pose.world_from_node[index] * glm::dmat4(node.instances[i]));
    }
    if (any_bends && !search.has_ended())
        visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
            if (bends(scene, scene.nodes[posed.node]))
                search.look_at_posed(posed);
        });
    return search.found();
}

} // namespace estampe
