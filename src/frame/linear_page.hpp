// SPDX-License-Identifier: MIT
#pragma once

// A picture in floats, whole or layer by layer.

#include <optional>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/resources.hpp"
#include "techniques/paper/paper.hpp"

namespace estampe::frame {

/// Where one picture ends in floats, beside its bytes.
struct LinearPage {
    struct Stage {
        paper::Stage stage = paper::Stage::lines;
        gpu::Image sums;    ///< of a picture of several samples; one texel for others
        gpu::Buffer pixels; ///< four floats a pixel, for reading back
    };

    std::vector<Stage> stages;
    gpu::Buffer draws; ///< of the last sample, see shaders/draw_word.glsl; empty where no layers are wanted
    gpu::Buffer sun;   ///< of the last sample, see light::LitPixels; empty where no layers are wanted
    gpu::Buffer open;  ///< of the last sample, halves; empty where no layers are wanted, or no occlusion
    gpu::Buffer cloud_cover; ///< the same of what clouds cover; empty where no layers are wanted
    bool has_clouds = false; ///< else that holds nothing

    [[nodiscard]] bool has_layers() const { return !draws.empty(); }
};

/// What a linear page holds.
struct LinearPageKind {
    bool has_layers = false; ///< each of them; else the picture alone
    bool has_ink = false;    ///< one of ink that flows besides
    bool has_smoke = false;  ///< and one of smoke
    bool has_occlusion = false;
    bool is_transparent = false; ///< the picture has alpha
};

/// A page for the whole picture, or for each of its layers. Throws Error naming the device's limit when there
/// is no room for its floats.
[[nodiscard]] LinearPage make_linear_page(gpu::Device& device, const RenderSettings& settings,
                                          LinearPageKind kind);

/// What a linear page is made from.
struct LinearPageInputs {
    paper::ComposeInputs layers;
    gpu::ImageId draw;
    gpu::ImageId sun;
    std::optional<gpu::ImageId> open;
    std::optional<gpu::ImageId> cloud_cover;
};

/// Declares what fills `page`, which must outlive the graph.
void declare_linear_page(gpu::Graph& graph, const LinearPageInputs& in, const paper::PaperStyle& style,
                         const paper::Accumulation& accumulation, LinearPage& page);

} // namespace estampe::frame
