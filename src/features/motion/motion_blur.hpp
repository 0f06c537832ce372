// SPDX-License-Identifier: MIT
#pragma once

// Motion blur and smear strokes (strokes along a motion) over several pictures: data about the scene's meshes
// that is kept from one picture to the next.

#include "features/common/feature.hpp"
#include "techniques/motion_blur/motion_blur.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

class MotionBlur final : public Feature {
public:
    /// Forgets the vertices and the starting points of smear strokes when the scene or its layout is
    /// replaced, because both contain vertex and triangle numbers.
    void invalidate(Event event) override;

    /// Computes the data that the style's motion blur needs. Smear strokes start on solid surfaces, but not
    /// on blank ground or terrain. Cost: none if the data exists, otherwise n log n in vertices and linear in
    /// triangles.
    void prepare(gpu::Device& device, const pose::MeshData& layout,
                 const motion_blur::MotionBlurStyle& style);

    /// Returns the shape whose motion blurs the picture, if the style's mode of motion blur uses a shape
    /// other than the scene. See motion_blur::add_velocity_shape().
    [[nodiscard]] std::optional<motion_blur::VelocityShape> record(gpu::Graph& graph,
                                                                   const motion_blur::VelocityShapeInputs& in,
                                                                   const motion_blur::MotionBlurStyle& style);

    [[nodiscard]] motion_blur::SmearSeeds& smear_seeds() { return smear_seeds_; }

private:
    motion_blur::Memory memory_;
    motion_blur::SmearSeeds smear_seeds_;
};

} // namespace estampe::features
