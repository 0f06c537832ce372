// SPDX-License-Identifier: MIT
#include "kit.hpp"

#include <array>

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

} // namespace square
