// SPDX-License-Identifier: MIT
#pragma once

// Worlds by their names, and their options on the command line.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "world/registry.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

struct DrawOptions;

/// The names of all worlds.
[[nodiscard]] std::vector<std::string> world_names();

/// The world that `scene` names; null if it names none, or if a file has this name, which has precedence.
[[nodiscard]] const worlds::Description* world_of(const std::string& scene);

/// The world that `draw` names, with the options that it has; null if it names a file. Throws Error for a
/// mistake in the options.
[[nodiscard]] std::unique_ptr<worlds::World> make_world(const DrawOptions& draw);

/// The options of a command that are those of a world.
class WorldOptions {
public:
    enum class Seed : uint8_t { is_an_option, is_left_out };

    /// Adds --world to the command and, unless it is left out, --seed; this object must outlive the parsing.
    void add_to(CLI::App& command, Seed seed = Seed::is_an_option);

    /// The assignments that were typed, --seed among them. Throws UsageError for options with a scene that is
    /// not a world, and for assignments that the world does not take.
    [[nodiscard]] std::vector<std::string> read(const std::string& scene) const;

private:
    std::vector<std::string> assignments_;
    std::optional<uint64_t> seed_;
};

/// Throws UsageError unless `scene` is a world that has a film of its own.
void check_has_film(const std::string& scene);

/// How to write an option of a world, if `key` is one: `--world hour=18`. Else empty. An empty value stands
/// for one that is not known.
[[nodiscard]] std::string world_option_as_typed(const std::string& key, const std::string& value);

/// "the worlds: NAME, NAME".
[[nodiscard]] std::string known_worlds();

} // namespace estampe::app
