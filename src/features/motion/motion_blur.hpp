// SPDX-License-Identifier: MIT
#pragma once

// Motion blur and smear strokes from picture to picture: what they keep of the scene's meshes.

#include "features/common/feature.hpp"
#include "techniques/motion_blur/motion_blur.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

class MotionBlur final : public Feature {
public:
    /// All of it is numbered by vertices and triangles.
    void invalidate(Event event) override;

    /// Makes what the style asks for. Smear strokes begin on all that is solid, and neither blank ground nor
    /// terrain. Cost: nothing when it is there; else n log n in vertices, linear in triangles.
    void prepare(gpu::Device& device, const pose::MeshData& layout,
                 const motion_blur::MotionBlurStyle& style);

    [[nodiscard]] motion_blur::Memory& memory() { return memory_; }

    [[nodiscard]] motion_blur::SmearSeeds& smear_seeds() { return smear_seeds_; }

private:
    motion_blur::Memory memory_;
    motion_blur::SmearSeeds smear_seeds_;
};

} // namespace estampe::features
