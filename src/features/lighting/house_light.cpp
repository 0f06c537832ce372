// SPDX-License-Identifier: MIT
#include "features/lighting/house_light.hpp"

#include <algorithm>

#include <estampe/terrain.hpp>

namespace estampe::features {

Outlook HouseLight::outlook(const Scene& scene, const light::LightStyle& style,
                            const std::optional<glm::dvec3>& eye)
{
    const bool has_lights =
        std::ranges::any_of(scene.nodes, [](const Node& node) { return node.light != no_index; });
    if (style.source == light::LightSource::scene ||
        (style.source == light::LightSource::automatic && has_lights)) {
        return {};
    }
    if (!outlook_) {
        cloud_ = surface_cloud(scene, pose_scene(scene, 0.0, no_index));
        outlook_ = find_outlook(*cloud_);
        if (scene.terrain && cloud_->points.empty()) { // its own mesh has no triangles yet
            outlook_->wind_deg = scene.terrain->description().wind.direction_deg;
        }
    }
    Outlook outlook = *outlook_;
    if (!outlook.shelter && eye) {
        outlook.shelter = shelter_around(*cloud_, *eye);
    }
    return outlook;
}

} // namespace estampe::features
