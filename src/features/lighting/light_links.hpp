// SPDX-License-Identifier: MIT
#pragma once

// What a style says of single lights and objects, over what their file says.

#include <span>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "techniques/light/light_style.hpp"

namespace estampe::features {

/// What the style can change of a scene's lights and of how objects stand to them.
struct LightingOfScene {
    std::vector<Light> lights;
    std::vector<LightLinks> node_links;
    std::vector<LightLinks> material_links;

    bool operator==(const LightingOfScene& other) const = default;
};

/// What a style says of that.
struct LightingWords {
    std::string lights;
    std::string objects;

    bool operator==(const LightingWords& other) const = default;
};

[[nodiscard]] LightingOfScene lighting_of(const Scene& scene);

/// Whether triangles and draws differ, so that they have to be made again.
[[nodiscard]] bool same_links(const LightingOfScene& a, const LightingOfScene& b);

/// Whether nothing differs but how bright lights are that burn in both.
[[nodiscard]] bool same_but_for_brightness(const LightingOfScene& a, const LightingOfScene& b);

/// Sets how bright lights are. Throws Error for one that there is not, and for what is no brightness.
void brighten(LightingOfScene& lighting, std::span<const LightBrightness> lights);

/// `own` with `light.lights` and `light.objects` of the style applied. A light goes by its name or its
/// node's, an object by its node's name, which counts for the nodes below, or by its material's. Throws Error
/// when a text cannot be read, or names what is not there. Cost: linear in nodes and words.
[[nodiscard]] LightingOfScene styled_lighting(const LightingOfScene& own, const Scene& scene,
                                              const light::LightStyle& style);

/// `scene` lit as the style wants it; throws as styled_lighting().
[[nodiscard]] Scene lit_by_style(Scene scene, const light::LightStyle& style);

/// Writes it back.
void set_lighting(Scene& scene, const LightingOfScene& lighting);

} // namespace estampe::features
