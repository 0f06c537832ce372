// SPDX-License-Identifier: MIT
#pragma once

#include "features/common/style_tables.hpp"
#include "frame/features.hpp"
#include "frame/page.hpp"
#include "frame/plan.hpp"
#include "frame/vectors.hpp"
#include "gpu/graph/graph.hpp"

namespace estampe::frame {

/// What is uploaded for each frame, or read back from it, beside the features' own.
struct FrameBuffers {
    gpu::Buffer frame_globals;      ///< FrameGlobals
    gpu::Buffer map_frame_globals;  ///< FrameGlobals of a page as large as the map that light spreads in
    gpu::Buffer half_frame_globals; ///< FrameGlobals of every second pixel each way
    gpu::Buffer look_of_draw;       ///< one per draw, where the plan has several style variants
    gpu::Buffer subsurface_looks;   ///< SubsurfaceLook, where light goes into things
    gpu::Buffer motion_pixels;      ///< read back where the plan asks for motion
    Page page;
};

/// One frame of a picture: which sample, of which part of the page, and what is wanted of it.
struct FrameJob {
    paper::Accumulation accumulation;
    bool is_first = true;                            ///< of the picture's frames
    std::optional<features::PixelRect> tile;         ///< part of the page to draw; otherwise all of it
    std::optional<features::Survey> survey;          ///< the page in fewer pixels
    StrokeLists* lists = nullptr;                    ///< strokes as paths in place of pixels
    LinearPage* linear = nullptr;                    ///< floats beside bytes
    std::optional<features::LinkedPart> linked = {}; ///< lines that were found for the whole page
    contour::LinkedLines* linked_out = nullptr;      ///< what tiles share, in place of a picture
    const VulkanPicture* target = nullptr;           ///< the host's, in place of bytes
};

/// What the steps of a frame are declared from.
struct FrameContext {
    gpu::Graph& graph;
    gpu::Device& device;
    LoadedScene& loaded; ///< posed
    Features& features;
    FrameBuffers& buffers;
    const FrameJob& job;
    const FramePlan& plan;
    const SamplePlan& sample;
    const features::StyleTables& style;
    std::vector<wash::LookWash>& wash_looks; ///< filled anew, in the room that the frame before took
};

/// Declares one sample of a picture, top to bottom; or, where the job has lists, what fills those instead.
void declare_frame(const FrameContext& context);

} // namespace estampe::frame
