// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <estampe/scene.hpp>

namespace estampe {

/// Light source of a scene when the style does not choose one.
enum class LightChoice : uint8_t {
    own,  ///< The lights of the file
    sun,  ///< The style's sun: the file has no lights
    lamp, ///< A lamp: the file has no lights and the scene is a closed room that the sun does not reach
    /// A lamp and daylight: the file has no lights and the scene is a room with an open side.
    lamp_and_daylight
};

/// Returns the light source for the view of framing_camera(). A renderer may choose another one for a camera
/// inside a room. Cost: as framing_camera().
[[nodiscard]] LightChoice default_light(const Scene& scene);

} // namespace estampe
