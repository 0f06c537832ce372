// SPDX-License-Identifier: MIT
#pragma once

// Ambient occlusion from picture to picture: what its method keeps of the scene's surfaces.

#include <optional>

#include "features/common/feature.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/surface/materials.hpp"

namespace estampe::features {

class Occlusion final : public Feature {
public:
    /// What was found of other surfaces, or of another pose, is lost, whether the next picture looks at it or
    /// not.
    void invalidate(Event event) override;

    /// Makes what the style's method keeps of all surfaces but blank ground and terrain. Cost: nothing when
    /// it is there; else n log n in vertices.
    void prepare(gpu::Device& device, const pose::MeshData& layout, const surface::MaterialBuffers& materials,
                 const occlusion::OcclusionStyle& style);

    /// Declares the passes of the style's method; none where the scene has no surface that occludes.
    [[nodiscard]] std::optional<occlusion::AmbientOcclusion>
    record(gpu::Graph& graph, const occlusion::OcclusionInputs& in, const occlusion::OcclusionStyle& style);

private:
    occlusion::Memory memory_;
};

} // namespace estampe::features
