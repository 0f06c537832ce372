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

/// Returns the kind of a material, or nothing if its kind is not known. The words of the name decide first,
/// in English, French or German, and the last word that names a kind wins: a "stone floor with sand" is sand,
/// and a "wooden chair" is wood. Words begin at capital letters and after anything that is no letter. Where
/// the name says nothing, foliage is leaves, and a smooth metallic material is metal. Cost: linear in the
/// name.
[[nodiscard]] std::optional<std::string_view> kind_of(const MaterialFacts& material);

/// Returns whether the pattern of an override means a material: by its name with wildcards, or, as
/// `kind:wood`, by its kind.
[[nodiscard]] bool means(const std::string& pattern, const MaterialFacts& material);

/// Returns the kind that a pattern such as `kind:wood` names; nothing for a pattern of names.
[[nodiscard]] std::optional<std::string_view> named_kind(std::string_view pattern);

} // namespace estampe::style
