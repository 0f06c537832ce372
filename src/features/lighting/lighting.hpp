// SPDX-License-Identifier: MIT
#pragma once

// The lights of a picture on the device, and the exposure that goes on from picture to picture; the light
// that a scene without its own gets; and what a style says of single lights and objects, over what their
// file says.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>

#include "features/common/feature.hpp"
#include "scene/view_analysis/view_analysis.hpp"
#include "techniques/light/exposure/exposure.hpp"
#include "techniques/light/light.glsl.h"
#include "techniques/light/light.hpp"

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

class Lighting final : public Feature {
public:
    /// The eye gets used to another scene afresh.
    void invalidate(Event event) override;

    [[nodiscard]] std::optional<FilmSection> film_section() const override
    {
        return FilmSection{"exposure", 1};
    }

    void save(FilmWriter& writer) override;
    void load(FilmReader& reader) override;

    /// Uploads what the light's shaders read.
    void upload(gpu::Device& device, const shared::LightGlobals& globals,
                std::span<const shared::LightRecord> lights);

    [[nodiscard]] light::ExposureMemory& exposure() { return exposure_; }

    [[nodiscard]] gpu::Buffer& globals() { return globals_; }

    /// LightRecord, one per light.
    [[nodiscard]] gpu::Buffer& lights() { return lights_; }

private:
    light::ExposureMemory exposure_;
    gpu::Buffer globals_;
    gpu::Buffer lights_;
};

} // namespace estampe::features
