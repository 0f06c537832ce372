// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

/// Copies everything that belongs to vertex `from` but its position and normal, so that a body moves as its
/// vertex does.
class Copier {
public:
    Copier(const Primitive& source, Primitive& target) : source_(source), target_(target)
    {
        target.morph_targets.resize(source.morph_targets.size());
    }

    uint32_t add(uint32_t from, const glm::vec3& position, const glm::vec3& normal)
    {
        const auto copy = [from](const auto& values, auto& copies) {
            if (from < values.size()) {
                copies.push_back(values[from]);
            }
        };
        copy(source_.colors, target_.colors);
        copy(source_.joints_0, target_.joints_0);
        copy(source_.joints_1, target_.joints_1);
        copy(source_.weights_0, target_.weights_0);
        copy(source_.weights_1, target_.weights_1);
        for (size_t i = 0; i < source_.morph_targets.size(); ++i) {
            copy(source_.morph_targets[i].position_offsets, target_.morph_targets[i].position_offsets);
        }
        target_.positions.push_back(position);
        target_.normals.push_back(normal);
        return static_cast<uint32_t>(target_.positions.size() - 1);
    }

private:
    const Primitive& source_;
    Primitive& target_;
};

constexpr uint32_t sides = 5;

void add_wire(const Primitive& source, Copier& copier, Primitive& target, uint32_t from, uint32_t to,
              float radius)
{
    const glm::vec3 a = source.positions[from];
    const glm::vec3 b = source.positions[to];
    const glm::vec3 along = b - a;
    if (!(glm::length(along) > 0.0F)) {
        return;
    }
    const glm::vec3 helper =
        std::abs(along.y) < 0.9F * glm::length(along) ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(helper, along));
    const glm::vec3 y = glm::normalize(glm::cross(along, x));
    std::array<uint32_t, sides> ring_a{};
    std::array<uint32_t, sides> ring_b{};
    for (uint32_t i = 0; i < sides; ++i) {
        const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(sides);
        const glm::vec3 outward = std::cos(angle) * x + std::sin(angle) * y;
        ring_a[i] = copier.add(from, a + radius * outward, outward);
        ring_b[i] = copier.add(to, b + radius * outward, outward);
    }
    for (uint32_t i = 0; i < sides; ++i) {
        const uint32_t next = (i + 1) % sides;
        target.indices.insert(target.indices.end(),
                              {ring_a[i], ring_a[next], ring_b[next], ring_a[i], ring_b[next], ring_b[i]});
    }
}

void add_dot(const Primitive& source, Copier& copier, Primitive& target, uint32_t vertex, float radius)
{
    std::array<uint32_t, 6> corner{};
    for (uint32_t i = 0; i < 6; ++i) {
        glm::vec3 outward(0.0F);
        outward[static_cast<int>(i / 2)] = i % 2 == 0 ? 1.0F : -1.0F;
        corner[i] = copier.add(vertex, source.positions[vertex] + radius * outward, outward);
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
        const uint32_t x = corner[octant & 1U];
        const uint32_t y = corner[2 + ((octant >> 1U) & 1U)];
        const uint32_t z = corner[4 + ((octant >> 2U) & 1U)];
        const bool flipped = ((octant ^ (octant >> 1U) ^ (octant >> 2U)) & 1U) != 0;
        target.indices.insert(target.indices.end(), {x, flipped ? z : y, flipped ? y : z});
    }
}

} // namespace

Primitive drawn_body(const Primitive& primitive, float radius_m)
{
    Primitive body;
    body.material = primitive.material;
    Copier copier(primitive, body);
    if (primitive.topology == Topology::lines) {
        for (size_t i = 0; i + 1 < primitive.indices.size(); i += 2) {
            add_wire(primitive, copier, body, primitive.indices[i], primitive.indices[i + 1], radius_m);
        }
    } else {
        for (const uint32_t vertex : primitive.indices) {
            add_dot(primitive, copier, body, vertex, 2.0F * radius_m);
        }
    }
    return body;
}

} // namespace estampe::pose
