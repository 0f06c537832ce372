// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <estampe/default_light.hpp>
#include <estampe/scene.hpp>

namespace estampe::app {

/// What `estampe info` counts.
struct SceneSummary {
    /// In the order they are shown.
    std::vector<std::pair<std::string, uint64_t>> counts;
    std::vector<std::string> camera_names;
    Bounds bounds; ///< of the rest pose
    LightChoice light = LightChoice::own;
};

/// Cost: linear in vertices and triangles, for the bounds and the light.
[[nodiscard]] SceneSummary summarize(const Scene& scene);

} // namespace estampe::app
