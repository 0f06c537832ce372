// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "style/parameter.hpp"

namespace estampe::style {

/// What a part of a style speaks of.
struct Surfaces {
    enum class By : uint8_t {
        all,      ///< the whole picture
        material, ///< surfaces of the materials that `pattern` names
        object,   ///< those of the nodes that it names, and of what hangs on them
    };

    By by = By::all;
    std::string pattern; ///< as file names in a shell: `brick*`, `pane_?`, `[AB]_wall`

    bool operator==(const Surfaces&) const = default;
};

/// Whether `name` is one of those that `pattern` names.
[[nodiscard]] bool matches(const std::string& pattern, const std::string& name);

/// A value that a parameter has on some surfaces, in place of that of the whole picture. Of several for one
/// surface the last holds.
struct Override {
    Surfaces surfaces;
    std::string section;
    std::string key;
    Value value;

    bool operator==(const Override&) const = default;
};

} // namespace estampe::style
