// SPDX-License-Identifier: MIT
#include "kit.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

namespace temple {
namespace {

struct Look {
    const char* name;
    glm::vec3 color; ///< linear
    bool double_sided;
    glm::vec3 emissive;
};

constexpr std::array<Look, 7> looks{{
    {"stone", {0.70F, 0.53F, 0.35F}, false, {}},
    {"paving", {0.66F, 0.50F, 0.33F}, false, {}},
    {"marble", {0.84F, 0.79F, 0.68F}, false, {}},
    {"dark", {0.16F, 0.15F, 0.14F}, false, {}},
    {"iron", {0.06F, 0.06F, 0.065F}, false, {}},
    {"flame", {0.95F, 0.62F, 0.22F}, false, {6.0F, 3.6F, 1.2F}},
    {"red", {0.56F, 0.05F, 0.03F}, true, {}},
}};

} // namespace

std::vector<estampe::Material> materials()
{
    std::vector<estampe::Material> all;
    for (const Look& look : looks) {
        estampe::Material& material = all.emplace_back();
        material.name = look.name;
        material.base_color = glm::vec4(look.color, 1.0F);
        material.emissive = look.emissive;
        material.metallic = 0.0F;
        material.double_sided = look.double_sided;
    }
    return all;
}

void Kit::add(Stuff stuff, const estampe::Primitive& shape, const glm::mat4& placed)
{
    const bool is_marked = !shape.edge_marks.empty();
    estampe::Primitive& part = parts_[{stuff, is_marked}];
    part.material = static_cast<estampe::Index>(stuff);
    estampe::shapes::append(part, shape, placed);
    part.edge_marks.insert(part.edge_marks.end(), shape.edge_marks.begin(), shape.edge_marks.end());
}

void Kit::add(const Kit& other, const glm::mat4& placed)
{
    for (const auto& [key, part] : other.parts_) {
        add(key.first, part, placed);
    }
}

void Kit::add_face(Stuff stuff, std::span<const glm::vec3> corners, const glm::vec3& normal,
                   const Grain& grain, uint32_t drawn)
{
    estampe::Primitive& part = parts_[{stuff, true}];
    part.material = static_cast<estampe::Index>(stuff);
    const auto first = static_cast<uint32_t>(part.positions.size());
    for (const glm::vec3& corner : corners) {
        part.positions.push_back(corner);
        part.normals.push_back(normal);
        part.uvs[0].push_back(grain.offset_m +
                              glm::vec2(glm::dot(corner, grain.along), glm::dot(corner, grain.up)));
    }
    const auto count = static_cast<uint32_t>(corners.size());
    for (uint32_t k = 1; k + 1 < count; ++k) {
        part.indices.insert(part.indices.end(), {first, first + k, first + k + 1});
        const uint32_t from_first = k == 1 ? drawn & 1U : 0U;
        const uint32_t middle = drawn >> k & 1U;
        const uint32_t to_first = k + 2 == count ? drawn >> (k + 1) & 1U : 0U;
        part.edge_marks.push_back(static_cast<uint8_t>(from_first | middle << 1U | to_first << 2U));
    }
}

estampe::Mesh Kit::mesh(const std::string& name) const
{
    estampe::Mesh mesh;
    mesh.name = name;
    for (const auto& [key, part] : parts_) {
        mesh.primitives.push_back(part);
    }
    return mesh;
}

size_t Kit::triangles() const
{
    size_t indices = 0;
    for (const auto& [key, part] : parts_) {
        indices += part.indices.size();
    }
    return indices / 3;
}

glm::mat4 at(const glm::vec3& place, float turn_deg)
{
    return glm::rotate(glm::translate(glm::mat4(1.0F), place), glm::radians(turn_deg), {0.0F, 1.0F, 0.0F});
}

estampe::Primitive rod(const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b,
                       uint32_t segments)
{
    constexpr int steps = 3;
    const float length = glm::distance(a, b);
    std::vector<glm::vec2> profile;
    for (int end = 0; end < 2; ++end) {
        for (int i = 0; i <= steps; ++i) {
            const int step = end == 0 ? i : steps - i;
            const float angle =
                0.5F * std::numbers::pi_v<float> * static_cast<float>(step) / static_cast<float>(steps);
            const float radius = end == 0 ? radius_a : radius_b;
            const float out = step == 0 ? 0.0F : radius * std::sin(angle);
            const float along = radius * std::cos(angle);
            profile.emplace_back(out, end == 0 ? -along : length + along);
        }
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

void add_block(Kit& kit, Stuff stuff, const glm::vec3& low, const glm::vec3& high)
{
    const glm::vec3 size = high - low;
    kit.add(stuff, estampe::shapes::box(size), at({0.5F * (low.x + high.x), low.y, 0.5F * (low.z + high.z)}));
}

} // namespace temple
