// SPDX-License-Identifier: MIT
#pragma once

// Which nodes of a scene give particles, and where those are on the page; and the puff of smoke that they
// may show, worked out once by the solver and kept as frames: what section 6.5 of the thesis calls a mixed
// technique, one small simulation shown on dozens of sprites.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "features/common/feature.hpp"
#include "features/common/style_tables.hpp"
#include "gpu/graph/execute.hpp"
#include "techniques/particles/particles.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

/// 6 x 6 frames of 64 x 64 pixels over four seconds: a warm puff that rises, rolls up and thins. The same on
/// the same device. Cost: 240 steps of the solver.
[[nodiscard]] particles::SheetImage smoke_sheet(gpu::Device& device, gpu::Executor& executor);

/// The nodes that the patterns between commas name, in their order; those with a mesh give no particles.
[[nodiscard]] std::vector<size_t> emitting_nodes(const Scene& scene, const std::string& patterns);

/// What particles are drawn from.
struct ParticleBuffers {
    gpu::Buffer sprites;
    gpu::Buffer starts;
    gpu::Buffer listed;
    particles::Sheet sheet;
};

struct ParticlePlanInputs {
    const Scene& scene;
    const pose::MeshData& layout;
    bool are_nodes_placed = false; ///< a program moves some
    const ScenePose& pose;
    std::function<ScenePose(double time_s)> pose_at; ///< at other moments
    const Camera& camera;
    const RenderSettings& settings;
    const StyleTables& style;
    bool has_haze = false;
};

class Particles final : public Feature {
public:
    void invalidate(Event event) override;

    /// Plans the particles of a picture, for each look of theirs by itself, and makes room for them; none
    /// where no node gives any. Throws Error for a sheet that cannot be read.
    [[nodiscard]] std::vector<particles::ParticlePlan> plan(gpu::Device& device, gpu::Executor& executor,
                                                            const ParticlePlanInputs& in);

    /// Draws what was planned over the layers, one look after another. `in` is the page that all share.
    [[nodiscard]] particles::ParticleLayers record(gpu::Graph& graph,
                                                   std::span<const particles::ParticlePlan> plans,
                                                   const particles::ParticleInputs& in,
                                                   particles::ParticleLayers layers);

private:
    std::vector<ParticleBuffers> buffers_; ///< of the plans, in their order
    std::string patterns_;                 ///< of the style, that `emitting_` was found by
    std::vector<size_t> emitting_;
};

} // namespace estampe::features
