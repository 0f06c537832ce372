// SPDX-License-Identifier: MIT
#pragma once

// The worlds that the program knows by name, and their options, which a user writes as KEY=VALUE.

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "world.hpp"

namespace worlds {

struct WholeRange {
    uint64_t least = 0;
    uint64_t most = std::numeric_limits<uint64_t>::max();
};

struct NumberRange {
    double least = 0.0;
    double most = 1.0;
};

using Words = std::vector<std::string>;

struct Option {
    std::string key;
    std::string meaning; ///< Meaning of the option in one full clause for help, without a full stop.
    std::variant<WholeRange, NumberRange, Words> allowed; ///< Values that a user may write.
    /// Value of the option if the user writes none; empty: the option then has no value.
    std::string initial;
    std::string without; ///< Text for help: what happens if the option has no value.
    /// The option can change the scene. False if World::scene() is the same for all values.
    bool changes_scene = true;

    /// Returns the syntax of the option for help: "seed=N", "hour=0..24" or "weather=calm|storm".
    [[nodiscard]] std::string syntax() const;
};

/// Lists the keys of options: "seed, weather, hour".
[[nodiscard]] std::string keys_of(std::span<const Option> options);

/// The values of a world's options.
class Values {
public:
    /// Reads assignments of options such as "seed=7"; if a key occurs twice, the last assignment counts.
    /// Throws Error for an assignment without a key and a value, for a key that is not among `options`, and
    /// for a value that is not allowed.
    Values(std::span<const Option> options, std::span<const std::string> assignments);

    // Functions that return the value of an option; nothing if the option has no value. `key` must be an
    // option of this world, and of this type.
    [[nodiscard]] std::optional<uint64_t> whole(std::string_view key) const;
    [[nodiscard]] std::optional<double> number(std::string_view key) const;
    [[nodiscard]] std::optional<std::string> word(std::string_view key) const;

    /// Returns whether a world makes the same scene from both sets of values, which must belong to the same
    /// options.
    [[nodiscard]] bool make_same_scene(const Values& other) const;

private:
    using Value = std::variant<std::monostate, uint64_t, double, std::string>;

    struct Entry {
        std::string key;
        Value value;
        bool changes_scene = true;
    };

    [[nodiscard]] const Value& at(std::string_view key) const;
    [[nodiscard]] static Value parse(const Option& option, const std::string& text);

    std::vector<Entry> entries_; ///< Value of each option, in the order of the options
};

/// Description of a world: the facts that the program knows before it makes the world.
struct Description {
    std::string name;                  ///< Name of the world, which a user writes in place of a scene's file.
    std::string summary;               ///< Summary of the world in one line, without a full stop.
    std::vector<std::string> styles;   ///< Names of the presets that were made for the world.
    std::vector<std::string> examples; ///< Commands for help, such as "estampe render NAME -o NAME.png".
    std::vector<Option> options;
    std::optional<double> film_s; ///< Length of the world's own film; nothing: the world has no film
    /// Length of a film that shows all events of the world once, for cameras other than the world's own.
    /// Nothing: only the scene's animations move.
    std::optional<double> show_s;
    /// Makes the world with `values`, which must be values of `options`.
    std::function<std::unique_ptr<World>(const Values& values)> make;
};

class Registry {
public:
    /// Adds a world to the registry. Throws Error if there is a world of that name, if the name is not made
    /// of lower-case letters, digits and hyphens, if two options have the same key, if an option's initial
    /// value is not allowed, and if the world cannot be made.
    void add(Description description);

    /// Finds the world with the given name; null if no world has the name. The pointer stays valid when
    /// worlds are added.
    [[nodiscard]] const Description* find(std::string_view name) const;

    [[nodiscard]] const std::deque<Description>& all() const { return all_; }

private:
    std::deque<Description> all_; ///< A deque, because a deque never moves its elements
};

/// Returns the program's worlds: the worlds that worlds/CMakeLists.txt lists, and the worlds that have been
/// added. Worlds must be added before other threads look for them.
///
/// Each world is listed in registry() by name. A static object that registers its own world would not work,
/// because a linker drops files of a static library to which no other file refers.
[[nodiscard]] Registry& registry();

} // namespace worlds
