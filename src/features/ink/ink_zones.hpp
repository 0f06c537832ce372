// SPDX-License-Identifier: MIT
#pragma once

// What single objects have to do with the ink that flows: which give it, and which drive it.

#include <string>
#include <string_view>
#include <vector>

#include <estampe/scene.hpp>

#include "shaders/frame.glsl.h"
#include "techniques/ink/ink.glsl.h"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// One word a draw, 1 where the patterns between commas name its object or one that it hangs on; the blank
/// ground is named by none. Empty where the patterns name all there is, "*". Patterns that name nothing go
/// into `notes`.
[[nodiscard]] std::vector<uint32_t> ink_mask(const pose::MeshData& meshes, const Scene& scene,
                                             std::string_view patterns, std::vector<std::string>& notes);

/// Where objects stand on the page.
struct ZoneView {
    const Scene& scene;
    const ScenePose& pose;
    glm::dvec3 anchor{0.0};
    const shared::FrameGlobals& page;
};

/// Zones as `text` has them: "Fan*=blow:20, Well=give:1 turn:90 amount:0". A zone is as large as a ball of
/// one metre in the space of its node. What is behind the eye has none, nor have more than `most_ink_zones`.
/// Throws Error for words that mean nothing; patterns that name nothing go into `notes`.
[[nodiscard]] std::vector<shared::InkZone> ink_zones(const ZoneView& view, std::string_view text,
                                                     std::vector<std::string>& notes);

} // namespace estampe::features
