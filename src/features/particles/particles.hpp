// SPDX-License-Identifier: MIT
#pragma once

// Finds the nodes that emit particles and plans their sprites on the page. The smoke puff of a sprite is
// simulated once and stored as frames. Section 6.5 of the thesis (Zanuttini, 2008) calls this a mixed
// technique, because one small simulation is shown on dozens of sprites.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "features/common/blast.hpp"
#include "features/common/feature.hpp"
#include "features/common/style_tables.hpp"
#include "gpu/graph/execute.hpp"
#include "techniques/particles/particles.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// Simulates a puff of smoke for sprites: 6 x 6 frames of 64 x 64 pixels over four seconds. The warm puff
/// rises, rolls up and thins. The same device gives the same frames. Cost: 240 steps of the solver.
[[nodiscard]] particles::SheetImage smoke_sheet(gpu::Device& device, gpu::Executor& executor);

/// Moves particles of the style `style` at `time_s` as blasts have moved them since their birth.
void push_away(std::span<particles::Particle> alive, const particles::ParticleStyle& style,
               std::span<const Blast> blasts, double time_s);

/// Returns the nodes without a mesh whose names match one of the comma-separated patterns, in scene order.
[[nodiscard]] std::vector<size_t> emitting_nodes(const Scene& scene, const std::string& patterns);

/// The buffers of one particle plan.
struct ParticleBuffers {
    gpu::Buffer sprites;
    gpu::Buffer starts;
    gpu::Buffer listed;
    particles::Sheet sheet;
};

struct ParticlePlanInputs {
    const Scene& scene;
    const pose::MeshData& layout;
    bool are_nodes_placed = false; ///< The calling program moves some nodes
    const ScenePose& pose;
    std::function<ScenePose(double time_s)> pose_at; ///< Returns the scene's pose at another time
    const Camera& camera;
    const RenderSettings& settings;
    const StyleTables& style;
    bool has_haze = false;
    std::vector<Blast> blasts = {}; ///< Blasts that push the particles away
};

class Particles final : public Feature {
public:
    void invalidate(Event event) override;

    /// Plans the particles of a picture, one plan per style variant, and uploads their buffers; empty if no
    /// node emits particles. Throws Error if a sprite sheet cannot be read.
    [[nodiscard]] std::vector<particles::ParticlePlan> plan(gpu::Device& device, gpu::Executor& executor,
                                                            const ParticlePlanInputs& in);

    /// Draws the particles of all plans over the colour and ink layers, one plan after the other. `in` holds
    /// the page's inputs, which all plans share.
    [[nodiscard]] particles::ParticleLayers record(gpu::Graph& graph,
                                                   std::span<const particles::ParticlePlan> plans,
                                                   const particles::ParticleInputs& in,
                                                   particles::ParticleLayers layers);

private:
    std::vector<ParticleBuffers> buffers_; ///< Buffers of the particle plans, in the same order
    std::string patterns_; ///< The style's patterns with which the nodes in `emitting_` were found
    std::vector<size_t> emitting_;
};

} // namespace estampe::features
