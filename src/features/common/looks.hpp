// SPDX-License-Identifier: MIT
#pragma once

// Where single materials and objects are drawn otherwise than the rest.

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "features/common/style_tables.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// The styles that occur in a picture, and which surface has which.
struct LookPlan {
    std::vector<StyleTables> styles;    ///< the first is that of the picture
    std::vector<uint32_t> look_of_draw; ///< numbers of `styles`; empty where there is but one
    /// What is to be found of lines, for whichever look: kinds have the width of their widest.
    contour::ContourStyle lines;

    [[nodiscard]] bool has_several() const { return styles.size() > 1; }
};

/// Draws of which the same overrides speak share a look. The list of styles takes `room`. Cost: linear in
/// draws times overrides.
[[nodiscard]] LookPlan plan_looks(const pose::MeshData& meshes, const Scene& scene, const StyleTables& style,
                                  std::vector<StyleTables> room = {});

/// The look of each node by itself, as `styles` of them: what hangs on a node is meant with it. Cost: linear
/// in nodes times overrides.
[[nodiscard]] LookPlan looks_of_nodes(const Scene& scene, const StyleTables& style);

/// Of the patterns of the style's overrides those that name nothing in the scene, a line each.
[[nodiscard]] std::vector<std::string> idle_overrides(const Scene& scene, const StyleTables& style);

} // namespace estampe::features
