// SPDX-License-Identifier: MIT
#pragma once

// Sheets of cloth in small scenes, made by the public headers alone.

#include <string>
#include <vector>

#include <estampe/scene.hpp>

struct ClothScene {
    std::string name;
    estampe::Scene scene;
    estampe::Camera camera;
    std::vector<std::string> style; ///< assignments
};

/// "flag", "banner", "curtain" and more.
[[nodiscard]] std::vector<std::string> set_up_names();

/// Throws estampe::Error for a name that is none of those. `finer` has so many times the particles a side.
[[nodiscard]] ClothScene make_set_up(const std::string& name, float finer = 1.0F);
