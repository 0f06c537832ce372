// SPDX-License-Identifier: MIT
#pragma once

// Kinds of material, such as stone or wood, for styles that draw each kind in its own way.

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace estampe::style {

/// The kinds of material that a style can name, as in `[material."kind:stone".hatch]`.
inline constexpr std::array<std::string_view, 8> material_kinds{"stone", "wood", "cloth", "metal",
                                                                "skin",  "sand", "water", "leaves"};

/// What a scene file says of a material.
struct MaterialFacts {
    std::string_view name;
    float metallic = 0.0F;  ///< 0 to 1
    float roughness = 1.0F; ///< 0 to 1
    bool is_foliage = false;
};

/// Returns the kind of a material, or nothing if its kind is not known. Words of the name that name a kind in
/// English, French or German decide first; of several such words, the last one decides. For example, "stone
/// floor with sand" is sand. In a name, a word begins at a capital letter, and at a letter after any other
/// character. If no word names a kind, foliage is of the kind leaves, and a smooth metallic material is of
/// the kind metal. Cost: linear in the name.
[[nodiscard]] std::optional<std::string_view> kind_of(const MaterialFacts& material);

/// Returns whether the pattern of an override means a material with the given name and kind: by the name with
/// wildcards, or, as `kind:wood`, by the kind.
[[nodiscard]] bool means(const std::string& pattern, const std::string& name,
                         std::optional<std::string_view> kind);

/// Returns the kind that a pattern such as `kind:wood` names; nothing for a pattern of names.
[[nodiscard]] std::optional<std::string_view> named_kind(std::string_view pattern);

} // namespace estampe::style
