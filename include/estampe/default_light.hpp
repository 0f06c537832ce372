// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <estampe/scene.hpp>

namespace estampe {

/// Light source of a scene when the style does not choose one.
enum class LightChoice : uint8_t {
    own, ///< The lights in the scene's file
    sun, ///< The style's sun, because the scene's file has no lights
    /// A lamp, because the scene's file has no lights and shows a closed room that the sun does not reach.
    lamp,
    /// A lamp and daylight, because the scene's file has no lights and shows a room with an open side.
    lamp_and_daylight
};

/// Returns the light source for the view that framing_camera() chooses. For other views, such as from inside
/// a room, a renderer may choose another light source. Cost: that of framing_camera().
[[nodiscard]] LightChoice default_light(const Scene& scene);

} // namespace estampe
