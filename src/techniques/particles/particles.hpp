// SPDX-License-Identifier: MIT
#pragma once

// Particles: each leaves an emitter, is carried by wind and swirls while it ages, and is drawn as a soft
// sprite.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/particles/particle_style.hpp"
#include "techniques/particles/particles.glsl.h"

namespace estampe::particles {

/// Where particles come from.
struct Emitter {
    glm::dvec3 place{0.0};
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit; 0: it gives none
    double size = 1.0;                   ///< of its particles, beside the style's
    std::vector<Emitter> before;         ///< how it stood at equal steps back from now; empty: as it stands
    double step_s = 0.0;                 ///< from one of them to the next
};

struct Particle {
    glm::dvec3 place{0.0};
    glm::dvec3 velocity{0.0};
    float age = 0.0F; ///< 0 to 1, of its life
    float size = 1.0F;
    float trait = 0.0F;
    float trait_b = 0.0F;
};

/// The velocity of swirls: the curl of three noises, so that it has no divergence (Bridson, Houriham,
/// Nordenstam, "Curl-Noise for Procedural Fluid Flow", SIGGRAPH 2007), of about unit speed; in features.
[[nodiscard]] glm::dvec3 swirl(const glm::dvec3& place, uint32_t seed);

/// All particles alive at a moment. Each is a function of its number, its age and how its emitter stood when
/// it was born: the same whatever was asked for before. Cost: 10 us a particle.
[[nodiscard]] std::vector<Particle> particles_at(const ParticleStyle& style,
                                                 std::span<const Emitter> emitters, double time_s);

/// The page that they are seen on.
struct ParticleView {
    glm::mat4 clip_from_anchor{1.0F};
    glm::dvec3 anchor{0.0};
    glm::uvec2 page_px{0};
    float pixels_per_mm = 1.0F;
    float pixel_m = 0.001F; ///< what a pixel spans at a distance of one
    bool is_parallel = false;
    glm::uvec2 sheet_px{0};
    glm::uvec2 sheet_frames{0}; ///< columns and rows; none without a sheet
};

/// Sprites from the farthest to the nearest, and which of them each tile of the page has.
struct ParticlePlan {
    shared::ParticleConstants constants{};
    std::vector<shared::Sprite> sprites;
    std::vector<uint32_t> starts; ///< one a tile, row by row, and the end
    std::vector<uint32_t> listed;
};

/// Nothing is drawn of what is behind the eye. Without haze, which the constants may be given after. Cost:
/// linear in sprites and the tiles they touch.
[[nodiscard]] ParticlePlan plan_particles(const ParticleStyle& style, std::span<const Particle> particles,
                                          const ParticleView& view);

/// Frames of brightness, beside and below each other.
struct SheetImage {
    glm::uvec2 size_px{1};
    glm::uvec2 frames{0}; ///< columns and rows; none: there is no sheet
    std::vector<float> brightness = {1.0F};
};

/// The frames of a style's sheet, made when that changes.
class Sheet {
public:
    /// Reads a picture, or takes what `simulate` works out. Throws Error naming the file when it is no
    /// picture, or smaller than its rows and columns.
    void ensure(gpu::Device& device, const ParticleStyle& style, const std::function<SheetImage()>& simulate);

    [[nodiscard]] glm::uvec2 size_px() const { return size_px_; }

    [[nodiscard]] glm::uvec2 frames() const { return frames_; }

    [[nodiscard]] gpu::Buffer& texels() { return texels_; }

private:
    std::string name_;
    glm::uvec2 asked_frames_{0};
    glm::uvec2 size_px_{0};
    glm::uvec2 frames_{0};
    gpu::Buffer texels_;
};

/// The lists of a plan on the device.
struct SpriteLists {
    gpu::BufferId sprites;
    gpu::BufferId starts;
    gpu::BufferId listed;
    gpu::BufferId sheet; ///< brightness, row by row
};

/// The page that sprites are drawn over.
struct ParticleInputs {
    gpu::BufferId frame; ///< FrameGlobals
    gpu::ImageId depth;  ///< r32f: reversed, 0 where nothing is
    gpu::ImageId sky;    ///< rgba16f, as large as the page or of one texel: what haze fades into
    glm::uvec2 size_px{0};
    /// The pixels of 8 x 8 read their list together, as suits a GPU: where a tile of the page is drawn, it
    /// has to begin at a multiple of 8.
    bool by_groups = false;
};

/// What lies under particles, and then has them too.
struct ParticleLayers {
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
};

/// Draws sprites over the layers: colour into the wash, and strokes and lines away under it; ink into lines.
///
/// Cost    linear in the sprites over each other, where the page has any; a list of the tiles that do
[[nodiscard]] ParticleLayers add_particles(gpu::Graph& graph, const ParticleInputs& in,
                                           const SpriteLists& lists,
                                           const shared::ParticleConstants& constants,
                                           const ParticleLayers& layers);

} // namespace estampe::particles
