// SPDX-License-Identifier: MIT
#include "scene/scene_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/job_limits.hpp"
#include "scene/visibility.hpp"

namespace estampe {
namespace {

bool is_near(const glm::dvec3& point)
{
    // The comparison is written with `<=`, so that the result is false for NaN.
    return std::abs(point.x) <= farthest_m && std::abs(point.y) <= farthest_m &&
           std::abs(point.z) <= farthest_m;
}

std::string in_words(const glm::dvec3& point)
{
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", point.x, point.y, point.z);
}

[[noreturn]] void refuse_camera(const std::string& what, const std::string& remedy)
{
    throw Error(what, "camera", remedy);
}

} // namespace

void check_extent(const Bounds& bounds, const std::string& scene)
{
    if (bounds.min.x > bounds.max.x) {
        return;
    }
    if (!is_near(bounds.min) || !is_near(bounds.max)) {
        throw Error(fmt::format("the scene reaches from {} to {} m, farther from the origin than {:g} m",
                                in_words(bounds.min), in_words(bounds.max), farthest_m),
                    scene, "scale it down or move it");
    }
    const double radius_m = bounds.radius();
    if (radius_m > 0.0 && radius_m < least_radius_m) {
        throw Error(fmt::format("the scene has a radius of {:.4g} m, less than {:g} m can be drawn with",
                                radius_m, least_radius_m),
                    scene, "scale it up");
    }
}

void check_places(const Scene& scene, const ScenePose& pose)
{
    const auto check = [&](Index index) {
        const glm::dmat4& place = pose.world_from_node[index];
        for (int column = 0; column < 4; ++column) {
            const glm::dvec4 size = glm::abs(place[column]);
            if (!glm::all(glm::lessThanEqual(size, glm::dvec4(std::numeric_limits<float>::max())))) {
                throw Error(
                    fmt::format("node {} \"{}\" has no finite place or size", index, scene.nodes[index].name),
                    scene.name, "look at the translations and scales of it and of those above it");
            }
        }
    };
    for (Index index = 0; index < scene.nodes.size(); ++index) {
        const Node& node = scene.nodes[index];
        if (node.mesh == no_index) {
            continue;
        }
        check(index);
        if (node.skin != no_index) {
            std::ranges::for_each(scene.skins[node.skin].joints, check);
        }
    }
}

void check_camera(const Camera& camera)
{
    for (const auto& [name, point] : {std::pair("eye", camera.eye), std::pair("target", camera.target)}) {
        if (!is_near(point)) {
            refuse_camera(fmt::format("its {} is at {} m, farther from the origin than {:g} m", name,
                                      in_words(point), farthest_m),
                          "place it nearer");
        }
    }
    const glm::dvec3 view = camera.target - camera.eye;
    const double length_m = glm::length(view);
    constexpr double least_length_m = 1e-12;
    if (length_m < least_length_m) {
        refuse_camera("eye and target are the same point", "move one of them");
    }
    constexpr double least_sine = 1e-9;
    const double up_length = glm::length(camera.up);
    if (!std::isfinite(up_length) ||
        !(glm::length(glm::cross(camera.up, view / length_m)) > least_sine * up_length)) {
        refuse_camera(fmt::format("its up, {}, is no direction across its view", in_words(camera.up)),
                      "choose another up");
    }
    if (!(std::abs(camera.shift.x) <= farthest_shift && std::abs(camera.shift.y) <= farthest_shift)) {
        refuse_camera(
            fmt::format("its shift is {:.4g}, {:.4g}", camera.shift.x, camera.shift.y),
            fmt::format("allowed: -{0:g} to {0:g} of the picture's width and height", farthest_shift));
    }
    if (camera.orthographic_half_height_m) {
        const double half_height_m = *camera.orthographic_half_height_m;
        if (!(half_height_m >= least_radius_m && half_height_m <= farthest_m)) {
            refuse_camera(fmt::format("half of its height is {:.4g} m", half_height_m),
                          fmt::format("allowed: {:g} to {:g} m", least_radius_m, farthest_m));
        }
        return;
    }
    if (!(camera.vertical_fov_rad > 0.0 && camera.vertical_fov_rad < std::numbers::pi)) {
        refuse_camera(
            fmt::format("its angle of view is {:.4g} degrees", glm::degrees(camera.vertical_fov_rad)),
            "allowed: more than 0 and less than 180 degrees");
    }
    if (!(camera.near_m > 0.0 && camera.near_m <= farthest_m)) {
        refuse_camera(fmt::format("its near plane is {:.4g} m away", camera.near_m),
                      fmt::format("allowed: more than 0, up to {:g} m", farthest_m));
    }
}

namespace {

constexpr uint64_t most_vertices = uint64_t{1} << 31U;
constexpr const char* lighten_it = "use a lighter scene, or show fewer copies";

// Estimated memory on CPU and GPU together. A vertex needs memory for positions, drawing and shadows; a
// triangle for corners and edges.
constexpr uint64_t bytes_a_vertex = 96;
constexpr uint64_t bytes_a_triangle = 96;

DrawnSize size_of(const Primitive& primitive)
{
    constexpr uint64_t corners_of_line = 10;
    constexpr uint64_t triangles_of_line = 10;
    constexpr uint64_t corners_of_point = 6;
    constexpr uint64_t triangles_of_point = 8;
    const uint64_t indices = primitive.indices.size();
    switch (primitive.topology) {
    case Topology::triangles:
        return {primitive.positions.size(), indices / 3};
    case Topology::lines:
        return {indices / 2 * corners_of_line, indices / 2 * triangles_of_line};
    case Topology::points:
        return {indices * corners_of_point, indices * triangles_of_point};
    }
    return {};
}

} // namespace

DrawnSize drawn_size(const Scene& scene)
{
    DrawnSize all;
    const std::vector<bool> visible = visible_nodes(scene);
    for (size_t index = 0; index < scene.nodes.size(); ++index) {
        const Node& node = scene.nodes[index];
        if (!visible[index] || node.mesh >= scene.meshes.size()) {
            continue;
        }
        const uint64_t copies = std::max<uint64_t>(node.instances.size(), 1);
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            const DrawnSize one = size_of(primitive);
            all.vertices += copies * one.vertices;
            all.triangles += copies * one.triangles;
        }
    }
    return all;
}

void check_drawn_size(const Scene& scene, const std::string& where)
{
    const std::string& place = where.empty() ? scene.name : where;
    const DrawnSize size = drawn_size(scene);
    if (size.vertices > most_vertices || size.triangles > most_vertices) {
        throw Error(fmt::format("the scene shows {} vertices and {} triangles in all, more than {} of either",
                                size.vertices, size.triangles, most_vertices),
                    place, lighten_it);
    }
    uint64_t bytes = size.vertices * bytes_a_vertex + size.triangles * bytes_a_triangle;
    // Textures lie on the device, whose memory need not be the machine's; a limit of the user counts both.
    for (const Texture& texture : scene.textures) {
        constexpr uint64_t bytes_a_texel = 6; // with smaller copies for the distance
        bytes += is_memory_limited() ? bytes_a_texel * texture.image.width * texture.image.height : 0;
    }
    require_memory(bytes, fmt::format("drawing {} vertices and {} triangles", size.vertices, size.triangles),
                   place, lighten_it);
}

} // namespace estampe
