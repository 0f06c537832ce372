// SPDX-License-Identifier: MIT
#pragma once

#include "features/common/style_tables.hpp"
#include "frame/features.hpp"
#include "frame/page.hpp"
#include "frame/plan.hpp"
#include "frame/vectors.hpp"
#include "gpu/graph/graph.hpp"

namespace estampe::frame {

/// Buffers that are uploaded for each frame or read back from it, in addition to those of the features.
struct FrameBuffers {
    gpu::Buffer frame_globals;      ///< FrameGlobals of the page
    gpu::Buffer map_frame_globals;  ///< FrameGlobals of a page with the size of the map in which subsurface
                                    ///< light spreads
    gpu::Buffer half_frame_globals; ///< FrameGlobals of the page at half resolution
    gpu::Buffer variant_of_draw;    ///< style variant of each draw call, if the plan has several variants
    gpu::Buffer subsurface_parameters; ///< per style variant, if surfaces scatter light below them
    gpu::Buffer motion_pixels;         ///< read back if the settings ask for motion
    Page page;
};

/// One frame of a picture: which sample it is, which part of the page it covers, and which outputs the caller
/// requests.
struct FrameJob {
    paper::Accumulation accumulation;
    bool is_first = true;                            ///< the first frame of this picture
    std::optional<features::PixelRect> tile;         ///< part of the page to draw; none draws the whole page
    std::optional<features::Survey> survey;          ///< set when the whole page is drawn in fewer pixels
    StrokeLists* lists = nullptr;                    ///< not null: output strokes as paths instead of pixels
    LinearPage* linear = nullptr;                    ///< not null: output floats in addition to bytes
    std::optional<features::LinkedPart> linked = {}; ///< lines that were already linked for the whole page
    contour::LinkedLines* linked_out = nullptr;      ///< not null: output linked lines, and no picture
    const VulkanPicture* target = nullptr;           ///< not null: the host's image, output instead of bytes
};

/// The inputs that every step of a frame is declared from.
struct FrameContext {
    gpu::Graph& graph;
    gpu::Device& device;
    LoadedScene& loaded; ///< already posed
    Features& features;
    FrameBuffers& buffers;
    const FrameJob& job;
    const FramePlan& plan;
    const SamplePlan& sample;
    const features::StyleTables& style;
    std::vector<wash::WashVariant>& wash_variants; ///< cleared for each frame; keeps its capacity
};

/// Declares the passes of one sample of a picture, in order. If the job has stroke lists, declares the passes
/// that fill those instead.
void declare_frame(const FrameContext& context);

} // namespace estampe::frame
