// SPDX-License-Identifier: MIT
#pragma once

// What the program tells about worlds.

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "world/registry.hpp"

namespace estampe::app {

/// Labels and texts about a world, in the order in which they are shown.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> world_rows(const worlds::Description& world);

/// What world_rows() says about a world, as JSON for programs.
[[nodiscard]] nlohmann::ordered_json world_json(const worlds::Description& world);

/// All worlds with their rows, as text for people or as JSON for programs.
[[nodiscard]] std::string report_worlds(bool json);

/// The examples of all worlds, one per line, indented as examples are in help.
[[nodiscard]] std::string world_examples();

} // namespace estampe::app
