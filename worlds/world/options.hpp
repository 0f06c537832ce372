// SPDX-License-Identifier: MIT
#pragma once

// The options of a world, which a user writes as KEY=VALUE.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

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
    std::string meaning;                                  ///< One full clause for help, without a full stop.
    std::variant<WholeRange, NumberRange, Words> allowed; ///< The values that a user may write.
    std::string initial;       ///< Value if the user writes none; empty: the option then has no value.
    std::string without;       ///< For help: what happens if the option has no value.
    bool changes_scene = true; ///< False if World::scene() is the same for all values.

    /// "seed=N", "hour=0..24" or "weather=calm|storm".
    [[nodiscard]] std::string syntax() const;
};

/// "seed, weather, hour".
[[nodiscard]] std::string keys_of(std::span<const Option> options);

/// The values of a world's options.
class Values {
public:
    /// Reads assignments such as "seed=7"; the last one of a key counts. Throws Error for an assignment
    /// without a key and a value, for a key that is not among `options`, listing those that are, and for a
    /// value that is not allowed.
    Values(std::span<const Option> options, std::span<const std::string> assignments);

    // Nothing if the option has no value. To be called for keys and types that the options have.
    [[nodiscard]] std::optional<uint64_t> whole(std::string_view key) const;
    [[nodiscard]] std::optional<double> number(std::string_view key) const;
    [[nodiscard]] std::optional<std::string> word(std::string_view key) const;

    /// Whether a world makes the same scene of both, which are values of the same options.
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

    std::vector<Entry> entries_; ///< one per option, in their order
};

} // namespace worlds
