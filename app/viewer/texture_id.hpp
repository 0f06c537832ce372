// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include <imgui.h>

#include "viewer/texture.hpp"

namespace estampe::viewer {

// What ImGui calls a texture is a pointer in its versions up to 1.91, and a number later.

[[nodiscard]] inline ImTextureID id_of(const Texture& texture)
{
    static_assert(sizeof(ImTextureID) == sizeof(VkDescriptorSet));
    return std::bit_cast<ImTextureID>(texture.descriptor());
}

[[nodiscard]] inline VkDescriptorSet descriptor_of(ImTextureID id)
{
    return std::bit_cast<VkDescriptorSet>(id);
}

} // namespace estampe::viewer
