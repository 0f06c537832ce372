// SPDX-License-Identifier: MIT
#pragma once

// Strokes from picture to picture: the tonal art maps they come from, and what they follow on each surface.

#include <vector>

#include "features/common/feature.hpp"
#include "features/hatching/strokes.hpp"
#include "features/hatching/tonal_maps.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::features {

class Hatching final : public Feature {
public:
    /// What strokes follow is numbered by draws, and the coordinates along the form by triangles.
    void invalidate(Event event) override;

    /// Uploads what the strokes of each draw follow. Cost: nothing where that is as before; otherwise linear
    /// in triangles where strokes follow the form.
    void ensure_strokes(gpu::Device& device, const pose::MeshData& layout, const StrokePlan& strokes);

    /// One map per style variant.
    [[nodiscard]] TonalMaps& maps() { return maps_; }

    /// One kind per draw, as shaders/stroke_kind.glsl.h numbers them.
    [[nodiscard]] gpu::Buffer& kinds() { return kinds_; }

    /// Three per triangle, where strokes follow the form.
    [[nodiscard]] gpu::Buffer& form_coordinates() { return form_coordinates_; }

private:
    TonalMaps maps_;
    std::vector<uint32_t> kind_of_draw_; ///< what `kinds_` holds
    gpu::Buffer kinds_;
    gpu::Buffer form_coordinates_;
};

} // namespace estampe::features
