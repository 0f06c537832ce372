// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace estampe::gltf {

/// The extensions that the importer understands.
[[nodiscard]] bool knows_extension(std::string_view name);

/// Whether a scene can be drawn without an extension that is not understood, even if the file requires it:
/// it changes materials, pictures or lights, or adds what is not drawn (sound, physics, facts). Every other
/// extension may change the geometry, and drawing without it would be wrong.
[[nodiscard]] bool can_do_without(std::string_view name);

/// The picture format that an extension of textures brings and that is not read, such as "AVIF"; nothing for
/// all other extensions.
[[nodiscard]] std::optional<std::string_view> unread_picture_format(std::string_view extension);

} // namespace estampe::gltf
