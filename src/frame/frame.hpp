// SPDX-License-Identifier: MIT
#pragma once

#include "features/common/style_tables.hpp"
#include "frame/features.hpp"
#include "frame/page.hpp"
#include "frame/plan.hpp"
#include "frame/vectors.hpp"
#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/stroke/linked_lines.hpp"

namespace estampe::frame {

/// Lines that were linked for the whole page, and the part of it that is inked.
struct LinkedPart {
    LinkedPart(contour::LinkedLines& linked_lines, const contour::PartOfPage& part_of_page)
        : lines(linked_lines), part(part_of_page)
    {
    }

    contour::LinkedLines& lines;
    contour::PartOfPage part;
};

/// Lists that each frame fills anew, in the room that the one before took.
struct FrameLists {
    std::vector<raster::Batch> casters; ///< that the sun's shadow map is drawn from
    std::vector<hatch::LookHatch> hatch_looks;
    std::vector<wash::LookWash> wash_looks;
};

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
    bool is_first = true;                       ///< of the picture's frames
    std::optional<features::PixelRect> tile;    ///< part of the page to draw; otherwise all of it
    std::optional<features::Survey> survey;     ///< the page in fewer pixels
    StrokeLists* lists = nullptr;               ///< strokes as paths in place of pixels
    LinearPage* linear = nullptr;               ///< floats beside bytes
    std::optional<LinkedPart> linked = {};      ///< lines that were found for the whole page
    contour::LinkedLines* linked_out = nullptr; ///< what tiles share, in place of a picture
    const VulkanPicture* target = nullptr;      ///< the host's, in place of bytes
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
    FrameLists& lists;
};

/// Declares one sample of a picture, top to bottom; or, where the job has lists, what fills those instead.
void declare_frame(const FrameContext& context);

} // namespace estampe::frame
