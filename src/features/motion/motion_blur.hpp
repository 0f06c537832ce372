// SPDX-License-Identifier: MIT
#pragma once

// Motion blur and smear strokes from picture to picture: what they keep of the scene's meshes.

#include "features/common/feature.hpp"
#include "techniques/motion_blur/motion_blur.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

class MotionBlur final : public Feature {
public:
    /// Forgets vertices and seeds when the scene or its layout is replaced, since both are numbers of
    /// vertices and triangles.
    void invalidate(Event event) override;

    /// Makes what the style asks for. Smear strokes begin on all that is solid, and neither blank ground nor
    /// terrain. Cost: nothing when it is there; else n log n in vertices, linear in triangles.
    void prepare(gpu::Device& device, const pose::MeshData& layout,
                 const motion_blur::MotionBlurStyle& style);

    /// The shape whose motion the style's mode blurs by, where that is not the scene's own. See
    /// motion_blur::add_velocity_shape().
    [[nodiscard]] std::optional<motion_blur::VelocityShape> record(gpu::Graph& graph,
                                                                   const motion_blur::VelocityShapeInputs& in,
                                                                   const motion_blur::MotionBlurStyle& style);

    [[nodiscard]] motion_blur::SmearSeeds& smear_seeds() { return smear_seeds_; }

private:
    motion_blur::Memory memory_;
    motion_blur::SmearSeeds smear_seeds_;
};

} // namespace estampe::features
