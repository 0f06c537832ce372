// SPDX-License-Identifier: MIT
#pragma once

// The lights of a picture on the device, and the style's changes of single lights and objects. Also the
// exposure, which adapts from picture to picture, and the default light of a scene without lights.

#include <optional>
#include <span>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "features/common/feature.hpp"
#include "features/common/style_tables.hpp"
#include "scene/view_analysis/view_analysis.hpp"
#include "techniques/light/exposure/exposure.hpp"
#include "techniques/light/light.glsl.h"
#include "techniques/light/light.hpp"

namespace estampe::features {

/// Finds the default light of a scene without lights. Use one DefaultLight per scene: the scene is analysed
/// once, at the first call.
class DefaultLight {
public:
    /// Returns the analysis of the view, by which the default light is placed. If an eye is given, the
    /// analysis is for this eye. Empty if the style uses the scene's own lights. Cost: the first call costs
    /// as much as analyze_view(), a later call a millisecond.
    [[nodiscard]] ViewAnalysis analysis(const Scene& scene, const light::LightStyle& style,
                                        const std::optional<glm::dvec3>& eye);

private:
    std::optional<SurfaceCloud> cloud_; ///< Points on the surfaces of the scene in its rest pose
    std::optional<ViewAnalysis> analysis_;
};

/// The lights of a scene, and the links between lights and objects. A style can change lights and links.
struct LightingOfScene {
    std::vector<Light> lights;
    std::vector<LightLinks> node_links;
    std::vector<LightLinks> material_links;

    bool operator==(const LightingOfScene& other) const = default;
};

/// The part of a style that changes lights, and links between lights and objects.
class LightingSettings {
public:
    explicit LightingSettings(const StyleTables& style);

    /// Returns whether the lighting settings of `style` are equal to the stored settings. Does not allocate
    /// memory. Cost: linear in the style's overrides.
    [[nodiscard]] bool are_of(const StyleTables& style) const;

private:
    light::LightChanges changes_;
    std::vector<style::Override> overrides_; ///< Overrides of the style's section `light`
};

[[nodiscard]] LightingOfScene lighting_of(const Scene& scene);

/// Returns whether the links between lights and objects are equal. If they differ, triangles and draw calls
/// must be built again.
[[nodiscard]] bool same_links(const LightingOfScene& a, const LightingOfScene& b);

/// Returns whether two lightings are equal, except for the intensities of lights that are on in both
/// lightings.
[[nodiscard]] bool same_but_for_brightness(const LightingOfScene& a, const LightingOfScene& b);

/// Sets light intensities. Throws Error if a light does not exist, or if an intensity is negative or not
/// finite.
void brighten(LightingOfScene& lighting, std::span<const LightBrightness> lights);

/// Applies the style's changes of lights, and those of its overrides, to the lighting `own`. An override by
/// object applies to the node of that name and its descendants, and to the lights that is_named_light()
/// finds; an override by material applies to the links of that material. Throws Error if light groups cannot
/// be parsed. Cost: linear in lights, nodes and materials, times overrides.
[[nodiscard]] LightingOfScene styled_lighting(const LightingOfScene& own, const Scene& scene,
                                              const StyleTables& style);

/// Returns the scene with the style's lighting. Throws Error as styled_lighting() does.
[[nodiscard]] Scene lit_by_style(Scene scene, const StyleTables& style);

/// Writes the lights and links of `lighting` into the scene.
void set_lighting(Scene& scene, const LightingOfScene& lighting);

class Lighting final : public Feature {
public:
    /// Makes the adaptation of the exposure start again when the scene is replaced, or when a film's saved
    /// state has no exposure.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override
    {
        return FilmSection{"exposure", 1};
    }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    void upload(gpu::Device& device, const shared::LightGlobals& globals,
                std::span<const shared::LightRecord> lights);

    [[nodiscard]] light::ExposureMemory& exposure() { return exposure_; }

    [[nodiscard]] gpu::Buffer& globals() { return globals_; }

    /// Returns the buffer with one LightRecord per light.
    [[nodiscard]] gpu::Buffer& lights() { return lights_; }

private:
    light::ExposureMemory exposure_;
    gpu::Buffer globals_;
    gpu::Buffer lights_;
};

} // namespace estampe::features
