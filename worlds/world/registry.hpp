// SPDX-License-Identifier: MIT
#pragma once

// The worlds that the program knows by name.

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options.hpp"
#include "world.hpp"

namespace worlds {

/// What the program knows about a world before it makes it.
struct Description {
    std::string name;                  ///< What a user writes in place of a scene's file.
    std::string summary;               ///< One line, without a full stop.
    std::vector<std::string> styles;   ///< Presets that were made for it.
    std::vector<std::string> examples; ///< Commands for help, such as "estampe render NAME -o NAME.png".
    std::vector<Option> options;
    std::optional<double> film_s; ///< Length of the world's own film; nothing: it has none.
    /// Length of a film by any other camera, in which all that goes on is seen once; nothing: nothing moves
    /// but the scene's animations.
    std::optional<double> show_s;
    /// Makes the world with these values, which are of `options`.
    std::function<std::unique_ptr<World>(const Values& values)> make;
};

class Registry {
public:
    /// Throws Error if there is a world of that name, if the name is not made of lower-case letters, digits
    /// and hyphens, if two options have one key, if an option's initial value is not allowed, and if the
    /// world cannot be made.
    void add(Description description);

    /// The world of that name; null if there is none. The pointer stays valid.
    [[nodiscard]] const Description* find(std::string_view name) const;

    [[nodiscard]] const std::deque<Description>& all() const { return all_; }

private:
    std::deque<Description> all_; ///< never moves its elements
};

/// The program's worlds: those that worlds/CMakeLists.txt lists, and those that have been added. Worlds must
/// be added before other threads look for them.
///
/// The list is explicit. A static object that registered its world would be lost: a linker takes only those
/// files of a static library that something refers to. Here registry() refers to each world.
[[nodiscard]] Registry& registry();

} // namespace worlds
