// SPDX-License-Identifier: MIT
#include "kit.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

namespace square {
namespace {

struct Look {
    const char* name;
    glm::vec3 color; ///< linear
    bool double_sided;
};

constexpr std::array<Look, 9> looks{{
    {"sand", {0.78F, 0.56F, 0.26F}, false},
    {"stone", {0.74F, 0.57F, 0.37F}, false},
    {"plaster", {0.82F, 0.66F, 0.44F}, false},
    {"marble", {0.86F, 0.82F, 0.72F}, false},
    {"shutter", {0.10F, 0.15F, 0.12F}, false},
    {"red", {0.60F, 0.06F, 0.03F}, true},
    {"iron", {0.06F, 0.06F, 0.065F}, false},
    {"brick", {0.50F, 0.20F, 0.11F}, false},
    {"steam", {0.90F, 0.88F, 0.82F}, false},
}};

} // namespace

std::vector<estampe::Material> materials()
{
    std::vector<estampe::Material> all;
    for (const Look& look : looks) {
        estampe::Material& material = all.emplace_back();
        material.name = look.name;
        material.base_color = glm::vec4(look.color, 1.0F);
        material.metallic = 0.0F;
        material.double_sided = look.double_sided;
    }
    return all;
}

void Kit::add(Stuff stuff, const estampe::Primitive& shape, const glm::mat4& placed)
{
    estampe::Primitive& part = parts_[stuff];
    part.material = static_cast<estampe::Index>(stuff);
    estampe::shapes::append(part, shape, placed);
}

void Kit::add(const Kit& other, const glm::mat4& placed)
{
    for (const auto& [stuff, part] : other.parts_)
        add(stuff, part, placed);
}

estampe::Mesh Kit::mesh(const std::string& name) const
{
    estampe::Mesh mesh;
    mesh.name = name;
    for (const auto& [stuff, part] : parts_)
        mesh.primitives.push_back(part);
    return mesh;
}

glm::mat4 at(const glm::vec3& place, float turn_degrees)
{
    return glm::rotate(glm::translate(glm::mat4(1.0F), place), glm::radians(turn_degrees),
                       {0.0F, 1.0F, 0.0F});
}

estampe::Primitive rod(const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b,
                       uint32_t segments)
{
    constexpr int steps = 4;
    const float length = glm::distance(a, b);
    std::vector<glm::vec2> profile;
    for (int end = 0; end < 2; ++end)
        for (int i = 0; i <= steps; ++i) {
            const float part = static_cast<float>(end == 0 ? i : steps - i) / static_cast<float>(steps);
            const float angle = 0.5F * std::numbers::pi_v<float> * part;
            const float radius = end == 0 ? radius_a : radius_b;
            const float out = radius * (part == 0.0F ? 0.0F : std::sin(angle));
            profile.emplace_back(out,
                                 end == 0 ? -radius * std::cos(angle) : length + radius * std::cos(angle));
        }
    const glm::vec3 y = (b - a) / length;
    const glm::vec3 x =
        glm::normalize(glm::cross(std::abs(y.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1), y));
    const glm::mat4 placed(glm::vec4(x, 0.0F), glm::vec4(y, 0.0F), glm::vec4(glm::cross(x, y), 0.0F),
                           glm::vec4(a, 1.0F));
    estampe::Primitive mesh;
    estampe::shapes::append(mesh, estampe::shapes::lathe(profile, segments), placed);
    return mesh;
}

} // namespace square
