// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <estampe/scene.hpp>

#include "scene/view_analysis/view_analysis.hpp"
#include "techniques/light/light_style.hpp"

namespace estampe::features {

/// Where the light stands that a scene without its own gets. One for each scene: what it takes is looked for
/// once, when it is first needed.
class DefaultLight {
public:
    /// As it stands for an eye, if there is one; nothing worth knowing where the style has the scene's own
    /// lights. Cost: the first time that of analyze_view(), then a millisecond.
    [[nodiscard]] ViewAnalysis analysis(const Scene& scene, const light::LightStyle& style,
                                        const std::optional<glm::dvec3>& eye);

private:
    std::optional<SurfaceCloud> cloud_; ///< of the scene at rest
    std::optional<ViewAnalysis> analysis_;
};

} // namespace estampe::features
