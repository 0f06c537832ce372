// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/input/input.hpp"

namespace estampe::stl {

/// Facets with a name; three positions each.
struct Solid {
    std::string name;
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec4> colors; ///< empty, or one for each facet; linear
};

struct Data {
    std::vector<Solid> solids; ///< each with at least one facet
    std::vector<std::string> warnings;
};

/// Reads a file of either kind. What is cut off or is no facet is counted in the warnings. Throws Error when
/// it is neither kind. Cost: about 0.1 s for a million triangles in binary, 0.4 s as text.
[[nodiscard]] Data parse(Input& input);

/// Reads a text.
[[nodiscard]] Data parse_text(Input& input);

/// Reads a file of 84 bytes and 50 for each facet.
[[nodiscard]] Data parse_binary(Input& input);

} // namespace estampe::stl
