// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::app {

/// What `estampe info` counts.
struct SceneSummary {
    /// In the order they are shown.
    std::vector<std::pair<std::string, uint64_t>> counts;
    std::vector<std::string> camera_names;
    Bounds bounds; ///< of the rest pose
};

/// Cost: linear in vertices, for the bounds.
[[nodiscard]] SceneSummary summarize(const Scene& scene);

} // namespace estampe::app
