// SPDX-License-Identifier: MIT
#pragma once

// Common functions of the lightmap tests.

#include <string>
#include <vector>

#include <estampe/lightmap.hpp>
#include <estampe/style.hpp>

namespace estampe::features {

/// A map with the same light everywhere.
inline LightImage even(float level)
{
    return {.width = 4, .height = 4, .texels = std::vector<glm::vec3>(16, glm::vec3(level))};
}

/// Draws the light as grey: no strokes, lines, shadows or paper, and a linear tone.
inline Style bare(float ambient)
{
    Style style;
    for (const char* const assignment :
         {"light.source=scene", "picture.ground=false", "light.falloff=1", "lightmap.balance=false"}) {
        style.set(assignment);
    }
    style.set("light.ambient=" + std::to_string(ambient));
    return style;
}

} // namespace estampe::features
