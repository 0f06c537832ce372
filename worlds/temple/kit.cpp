// SPDX-License-Identifier: MIT
#include "kit.hpp"

#include <array>

namespace temple {
namespace {

struct Look {
    const char* name;
    glm::vec3 color; ///< Linear base colour of the material
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

void Kit::add_face(Stuff stuff, std::span<const glm::vec3> corners, const glm::vec3& normal,
                   const Grain& grain, uint32_t drawn)
{
    estampe::Primitive& part = this->part(static_cast<estampe::Index>(stuff), true);
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

void add_block(Kit& kit, Stuff stuff, const glm::vec3& low, const glm::vec3& high)
{
    const glm::vec3 size = high - low;
    kit.add(stuff, estampe::shapes::box(size), at({0.5F * (low.x + high.x), low.y, 0.5F * (low.z + high.z)}));
}

} // namespace temple
