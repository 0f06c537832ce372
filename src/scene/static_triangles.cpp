// SPDX-License-Identifier: MIT
#include "scene/static_triangles.hpp"

#include <fmt/format.h>

#include "core/hash.hpp"
#include "scene/pose.hpp"
#include "scene/scene_limits.hpp"
#include "scene/visibility.hpp"

namespace estampe {

std::vector<bool> moving_nodes(const Scene& scene)
{
    std::vector<bool> moving(scene.nodes.size(), false);
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) {
            if (channel.node < moving.size() && channel.path != AnimatedPath::weights) {
                moving[channel.node] = true;
            }
        }
    }
    std::vector<Index> open(scene.roots.begin(), scene.roots.end());
    while (!open.empty()) {
        const Index node = open.back();
        open.pop_back();
        for (const Index child : scene.nodes[node].children) {
            moving[child] = moving[child] || moving[node];
            open.push_back(child);
        }
    }
    return moving;
}

bool can_move(const Scene& scene, const std::vector<bool>& moving, Index node, const Primitive& primitive)
{
    return moving[node] || scene.nodes[node].skin != no_index || !primitive.morph_targets.empty() ||
           cloth_of(scene, scene.nodes[node], primitive) != nullptr;
}

namespace {

class Gatherer {
public:
    Gatherer(const Scene& scene, StaticTriangles& result)
        : scene_(scene), result_(result), pose_(pose_scene(scene, 0.0, no_index)),
          moving_(moving_nodes(scene))
    {
    }

    void run()
    {
        result_.anchor = scene_bounds(scene_, pose_).center();
        const std::vector<bool> visible = visible_nodes(scene_);
        for (Index node = 0; node < scene_.nodes.size(); ++node) {
            if (!visible[node] || scene_.nodes[node].mesh >= scene_.meshes.size()) {
                continue;
            }
            const std::vector<Primitive>& primitives = scene_.meshes[scene_.nodes[node].mesh].primitives;
            for (uint32_t primitive = 0; primitive < primitives.size(); ++primitive) {
                if (primitives[primitive].topology == Topology::triangles &&
                    !can_move(scene_, moving_, node, primitives[primitive])) {
                    add_primitive(node, primitive, primitives[primitive]);
                }
            }
        }
    }

private:
    void add_primitive(Index node, uint32_t number, const Primitive& primitive)
    {
        const std::vector<glm::mat4>& instances = scene_.nodes[node].instances;
        const size_t places = std::max<size_t>(instances.size(), 1);
        for (uint32_t instance = 0; instance < places; ++instance) {
            glm::dmat4 place = pose_.world_from_node[node];
            if (!instances.empty()) {
                place = place * glm::dmat4(instances[instance]);
            }
            result_.draws.push_back({.node = node,
                                     .primitive = number,
                                     .instance = instance,
                                     .material = primitive.material,
                                     .first_triangle = static_cast<uint32_t>(result_.count()),
                                     .triangle_count = static_cast<uint32_t>(primitive.indices.size() / 3)});
            result_.has_uv_1.push_back(primitive.uvs[1].size() == primitive.positions.size());
            add_corners(primitive, place);
        }
    }

    void add_corners(const Primitive& primitive, const glm::dmat4& place)
    {
        const glm::dmat3 linear(place);
        const bool singular = glm::determinant(linear) == 0.0;
        const glm::dmat3 for_normals = singular ? linear : glm::transpose(glm::inverse(linear));
        if (!primitive.colors.empty() && result_.colors.empty()) {
            result_.colors.assign(result_.positions.size(), glm::vec3(1.0F));
        }
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t vertex = primitive.indices[i + k];
                const glm::dvec4 position(primitive.positions[vertex], 1.0);
                result_.positions.emplace_back(glm::dvec3(place * position) - result_.anchor);
                const glm::dvec3 normal = vertex < primitive.normals.size()
                                              ? for_normals * glm::dvec3(primitive.normals[vertex])
                                              : glm::dvec3(0.0);
                const double length = glm::length(normal);
                result_.normals.emplace_back(length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0));
                for (size_t set = 0; set < 2; ++set) {
                    const std::vector<glm::vec2>& uvs = primitive.uvs[set];
                    result_.uvs[set].push_back(vertex < uvs.size() ? uvs[vertex] : glm::vec2(0.0F));
                }
                if (!result_.colors.empty() || !primitive.colors.empty()) {
                    result_.colors.push_back(vertex < primitive.colors.size()
                                                 ? glm::vec3(primitive.colors[vertex])
                                                 : glm::vec3(1.0F));
                }
            }
        }
    }

    const Scene& scene_;
    StaticTriangles& result_;
    ScenePose pose_;
    std::vector<bool> moving_;
};

} // namespace

StaticTriangles static_triangles(const Scene& scene)
{
    check_drawn_size(scene);
    StaticTriangles result;
    Gatherer(scene, result).run();
    return result;
}

bool has_moving_parts(const Scene& scene)
{
    const std::vector<bool> moving = moving_nodes(scene);
    const std::vector<bool> visible = visible_nodes(scene);
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        if (!visible[node] || scene.nodes[node].mesh >= scene.meshes.size()) {
            continue;
        }
        for (const Primitive& primitive : scene.meshes[scene.nodes[node].mesh].primitives) {
            if (can_move(scene, moving, node, primitive)) {
                return true;
            }
        }
    }
    return false;
}

std::string geometry_fingerprint(const StaticTriangles& triangles)
{
    Hash hash;
    for (const StaticDraw& draw : triangles.draws) {
        hash.add(draw.node);
        hash.add(draw.primitive);
        hash.add(draw.instance);
        hash.add(draw.triangle_count);
    }
    hash.add_all(triangles.positions);
    return fmt::format("{:016x}", hash.value());
}

} // namespace estampe
