// SPDX-License-Identifier: MIT
#include "features/lighting/default_light.hpp"

#include <algorithm>

#include <estampe/terrain.hpp>

namespace estampe::features {

ViewAnalysis DefaultLight::analysis(const Scene& scene, const light::LightStyle& style,
                                    const std::optional<glm::dvec3>& eye)
{
    const bool has_lights =
        std::ranges::any_of(scene.nodes, [](const Node& node) { return node.light != no_index; });
    if (style.source == light::LightSource::scene ||
        (style.source == light::LightSource::automatic && has_lights)) {
        return {};
    }
    if (!analysis_) {
        cloud_ = surface_cloud(scene, pose_scene(scene, 0.0, no_index));
        analysis_ = analyze_view(*cloud_);
        if (scene.terrain && cloud_->points.empty()) { // its own mesh has no triangles yet
            analysis_->wind_deg = scene.terrain->description().wind.direction_deg;
        }
    }
    ViewAnalysis analysis = *analysis_;
    if (!analysis.shelter && eye) {
        analysis.shelter = shelter_around(*cloud_, *eye);
    }
    return analysis;
}

} // namespace estampe::features
