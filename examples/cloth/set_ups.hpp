// SPDX-License-Identifier: MIT
#pragma once

// Cloth sheets in small scenes, made with only the public headers.

#include <string>
#include <vector>

#include <estampe/scene.hpp>

struct ClothScene {
    std::string name;
    estampe::Scene scene;
    estampe::Camera camera;
    std::vector<std::string> style; ///< assignments to style keys
};

/// "flag", "banner", "curtain" and more.
[[nodiscard]] std::vector<std::string> set_up_names();

/// Makes the scene of that name. Throws estampe::Error for an unknown name. `finer` multiplies the number of
/// particles per side.
[[nodiscard]] ClothScene make_set_up(const std::string& name, float finer = 1.0F);
