// SPDX-License-Identifier: MIT
#pragma once

// Ambient occlusion over several pictures: data about the scene's surfaces that the occlusion method keeps
// from one picture to the next.

#include <optional>

#include "features/common/feature.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/surface/materials.hpp"

namespace estampe::features {

class Occlusion final : public Feature {
public:
    /// Forgets data that was computed for other surfaces or another pose, even if the next picture does not
    /// use occlusion.
    void invalidate(Event event) override;

    /// Makes the data about surfaces that the style's occlusion method keeps. Leaves out blank ground and
    /// terrain. Cost: none if the data exists, otherwise n log n in vertices.
    void prepare(gpu::Device& device, const pose::MeshData& layout, const surface::MaterialBuffers& materials,
                 const occlusion::OcclusionStyle& style);

    /// Declares the passes of the style's occlusion method; none if the scene has no surface that occludes.
    [[nodiscard]] std::optional<occlusion::AmbientOcclusion>
    record(gpu::Graph& graph, const occlusion::OcclusionInputs& in, const occlusion::OcclusionStyle& style);

private:
    occlusion::Memory memory_;
};

} // namespace estampe::features
