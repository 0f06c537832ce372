// SPDX-License-Identifier: MIT
#pragma once

// Particles: each particle leaves an emitter, drifts in wind and swirls, and is drawn as a soft sprite.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/particles/particle_style.hpp"
#include "techniques/particles/particles.glsl.h"

namespace estampe::particles {

/// A source of particles: its position, and how it throws particles.
struct Emitter {
    glm::dvec3 place{0.0};
    /// Direction in which particles leave, a unit vector; 0: the emitter gives no particles.
    glm::dvec3 direction{0.0, 1.0, 0.0};
    double size = 1.0; ///< factor on the style's particle size
    /// Earlier states of the emitter at equal time steps; empty: the emitter never changed.
    std::vector<Emitter> before;
    double step_s = 0.0; ///< time between two neighbouring states in `before`
};

struct Particle {
    glm::dvec3 place{0.0};
    glm::dvec3 velocity{0.0};
    float age = 0.0F; ///< elapsed share of the particle's life, 0 to 1
    float size = 1.0F;
    float trait = 0.0F;
    float trait_b = 0.0F;
};

/// Velocity of the swirls that move particles: the curl of three noises, which has no divergence, at about
/// unit speed. `place` is in units of the swirls' size. Source: Bridson, Houriham, Nordenstam, "Curl-Noise
/// for Procedural Fluid Flow", SIGGRAPH 2007.
[[nodiscard]] glm::dvec3 swirl(const glm::dvec3& place, uint32_t seed);

/// All particles alive at `time_s`. A particle depends only on its number, its age and the emitter's state at
/// its birth. So the result does not depend on earlier calls. Cost: 10 us per particle.
[[nodiscard]] std::vector<Particle> particles_at(const ParticleStyle& style,
                                                 std::span<const Emitter> emitters, double time_s);

/// The page and camera that show the particles.
struct ParticleView {
    glm::mat4 clip_from_anchor{1.0F};
    glm::dvec3 anchor{0.0};
    glm::uvec2 page_px{0};
    float pixels_per_mm = 1.0F;
    float pixel_m = 0.001F; ///< size of a pixel at distance 1 from the eye
    bool is_parallel = false;
    glm::uvec2 sheet_px{0};
    glm::uvec2 sheet_frames{0}; ///< columns and rows of the sprite sheet; 0 without a sheet
};

/// All sprites of a picture, from the farthest to the nearest, and for each tile the list of its sprites.
struct ParticlePlan {
    shared::ParticleConstants constants{};
    std::vector<shared::Sprite> sprites;
    std::vector<uint32_t> starts; ///< index in `listed` of each tile's first sprite, row by row, and the end
    std::vector<uint32_t> listed;
};

/// Projects particles to sprites on the page, without those behind the eye. The constants have no haze; the
/// caller may add it. Cost: linear in the number of sprites and of the tiles that the sprites touch.
[[nodiscard]] ParticlePlan plan_particles(const ParticleStyle& style, std::span<const Particle> particles,
                                          const ParticleView& view);

/// A sprite sheet as a brightness image, with frames side by side and row by row.
struct SheetImage {
    glm::uvec2 size_px{1};
    glm::uvec2 frames{0}; ///< columns and rows of frames; 0: there is no sprite sheet
    std::vector<float> brightness = {1.0F};
};

/// The style's sprite sheet on the device, loaded again when the style changes it.
class Sheet {
public:
    /// Loads the sprite sheet from a picture file, or from `simulate` for the built-in smoke. Throws Error
    /// that names the file if the file is no picture, or has fewer pixels than rows or columns.
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

/// The sprites of a ParticlePlan and their lists per tile, in device buffers.
struct SpriteLists {
    gpu::BufferId sprites;
    gpu::BufferId starts;
    gpu::BufferId listed;
    gpu::BufferId sheet; ///< brightness of the sprite sheet, row by row
};

/// Inputs of the pass that draws sprites.
struct ParticleInputs {
    gpu::BufferId frame; ///< buffer with a FrameGlobals record
    gpu::ImageId depth;  ///< r32f: reversed depth, 0 for the background
    gpu::ImageId sky;    ///< rgba16f, page-sized or one texel: the colour that haze fades into
    glm::uvec2 size_px{0};
    /// The 8 x 8 pixels of a workgroup read their sprite list together, which is faster on GPUs. A tile of
    /// the page must then begin at a multiple of 8.
    bool by_groups = false;
};

/// The layers of the drawing over which particles are drawn.
struct ParticleLayers {
    gpu::ImageId wash;
    gpu::ImageId hatch;
    gpu::ImageId lines;
};

/// Draws particles over the layers: colour into the wash, ink into the lines; colour hides the strokes and
/// lines below.
///
/// Cost    linear in overlapping sprites per pixel, only in tiles with sprites; a dispatch that lists these
///         tiles
[[nodiscard]] ParticleLayers add_particles(gpu::Graph& graph, const ParticleInputs& in,
                                           const SpriteLists& lists,
                                           const shared::ParticleConstants& constants,
                                           const ParticleLayers& layers);

} // namespace estampe::particles
