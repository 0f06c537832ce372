// SPDX-License-Identifier: MIT
#include "features/smoke/smoke_obstacles.hpp"

#include <algorithm>
#include <array>

namespace estampe::features {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

constexpr double half_cell = 0.5;

/// Whether an axis parts the triangle from the box of a cell about the origin.
bool parts(const glm::dvec3& axis, const Triangle& triangle)
{
    const double reach = half_cell * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    const auto [low, high] =
        std::minmax({glm::dot(axis, triangle[0]), glm::dot(axis, triangle[1]), glm::dot(axis, triangle[2])});
    return low > reach || high < -reach;
}

bool touches_cell(const Triangle& triangle, const glm::dvec3& middle)
{
    const Triangle at{triangle[0] - middle, triangle[1] - middle, triangle[2] - middle};
    const std::array<glm::dvec3, 3> sides{at[1] - at[0], at[2] - at[1], at[0] - at[2]};
    if (parts(glm::cross(sides[0], sides[1]), at)) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 axis(0.0);
        axis[i] = 1.0;
        if (parts(axis, at) || std::ranges::any_of(sides, [&](const glm::dvec3& side) {
                return parts(glm::cross(axis, side), at);
            })) {
            return false;
        }
    }
    return true;
}

/// Cells of a box, and those among them that have been touched.
class Cells {
public:
    explicit Cells(const glm::uvec3& size) : size_(size), flags_(size_t{size.x} * size.y * size.z) {}

    void touch(const Triangle& triangle)
    {
        const glm::dvec3 low = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
        const glm::dvec3 high = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
        const glm::dvec3 last = glm::dvec3(size_) - 1.0;
        if (!glm::all(glm::lessThanEqual(low, glm::dvec3(size_))) ||
            !glm::all(glm::greaterThanEqual(high, glm::dvec3(0.0)))) {
            return; // also what is no number
        }
        const glm::uvec3 from(glm::clamp(glm::floor(low), glm::dvec3(0.0), last));
        const glm::uvec3 to(glm::clamp(glm::floor(high), glm::dvec3(0.0), last));
        for (uint32_t z = from.z; z <= to.z; ++z) {
            for (uint32_t y = from.y; y <= to.y; ++y) {
                for (uint32_t x = from.x; x <= to.x; ++x) {
                    if (touches_cell(triangle, glm::dvec3(x, y, z) + half_cell)) {
                        flags_[(size_t{z} * size_.y + y) * size_.x + x] = 1;
                    }
                }
            }
        }
    }

    [[nodiscard]] std::vector<uint8_t> take() { return std::move(flags_); }

private:
    glm::uvec3 size_;
    std::vector<uint8_t> flags_;
};

void touch_all(Cells& cells, const Primitive& primitive, const glm::dmat4& grid_from_mesh)
{
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        Triangle triangle;
        for (size_t corner = 0; corner < 3; ++corner) {
            const glm::vec3& position = primitive.positions[primitive.indices[i + corner]];
            triangle.at(corner) = glm::dvec3(grid_from_mesh * glm::dvec4(position, 1.0));
        }
        cells.touch(triangle);
    }
}

} // namespace

std::vector<uint8_t> standing_cells(const Scene& scene, const ScenePose& pose, const glm::dvec3& anchor,
                                    const smoke::Box& box)
{
    Cells cells(box.cells);
    glm::dmat4 anchor_from_world(1.0);
    anchor_from_world[3] = glm::dvec4(-anchor, 1.0);
    const glm::dmat4 grid_from_world = glm::dmat4(box.grid_from_anchor) * anchor_from_world;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.mesh == no_index || node.skin != no_index) {
            continue;
        }
        const glm::dmat4 grid_from_node = grid_from_world * pose.world_from_node[i];
        const std::vector<glm::mat4> one{glm::mat4(1.0F)};
        for (const glm::mat4& instance : node.instances.empty() ? one : node.instances) {
            for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
                const bool is_rigid =
                    primitive.morph_targets.empty() && cloth_of(scene, node, primitive) == nullptr;
                if (primitive.topology == Topology::triangles && is_rigid) {
                    touch_all(cells, primitive, grid_from_node * glm::dmat4(instance));
                }
            }
        }
    }
    return cells.take();
}

} // namespace estampe::features
