// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <estampe/scene.hpp>

namespace estampe {

/// What lights a scene where a style leaves it to the scene.
enum class LightChoice : uint8_t {
    own,              ///< the lights of the file
    sun,              ///< the style's sun, as there are none
    lamp,             ///< a lamp, as there are none and the sun reaches nothing: a closed room
    lamp_and_daylight ///< the same in a room with an open side
};

/// The choice for a view such as framing_camera() makes; an eye elsewhere may find itself in a room. Cost: as
/// framing_camera().
[[nodiscard]] LightChoice default_light(const Scene& scene);

} // namespace estampe
