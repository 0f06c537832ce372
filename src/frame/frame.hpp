// SPDX-License-Identifier: MIT
#pragma once

#include "features/common/style_tables.hpp"
#include "frame/features.hpp"
#include "frame/page.hpp"
#include "frame/plan.hpp"
#include "frame/surface_buffers.hpp"
#include "frame/vectors.hpp"
#include "gpu/graph/graph.hpp"

namespace estampe::frame {

/// Buffers that are uploaded for each frame, or read back after the frame. Features have further buffers of
/// their own.
struct FrameBuffers {
    gpu::Buffer frame_globals; ///< FrameGlobals (camera and page) of the picture
    /// FrameGlobals (camera and page) of a square page with the size of the texture atlas in which subsurface
    /// light spreads.
    gpu::Buffer map_frame_globals;
    gpu::Buffer half_frame_globals; ///< FrameGlobals of the page at half resolution
    /// Style variant of each draw call; only used if the picture's plan has several style variants.
    gpu::Buffer variant_of_draw;
    /// Subsurface parameters per style variant; only used if surfaces scatter light below them.
    gpu::Buffer subsurface_parameters;
    gpu::Buffer motion_pixels; ///< motion vector of each pixel, read back if the settings ask for motion
    Page page;
};

/// One frame of a picture: which sample it is, which part of the page it covers, and which outputs the caller
/// requests.
struct FrameJob {
    paper::Accumulation accumulation;
    bool is_first = true;                    ///< the frame is the first of its picture
    std::optional<features::PixelRect> tile; ///< part of the page to draw; none: the whole page
    /// The frame draws the whole page at reduced resolution; none: at full resolution.
    std::optional<features::Survey> survey;
    /// If not null, the frame outputs strokes as paths into this list instead of pixels.
    StrokeLists* lists = nullptr;
    /// If not null, the frame copies the visible surfaces there, and draws no picture.
    SurfaceReading* surface = nullptr;
    /// If not null, the frame outputs floats into this page in addition to bytes.
    LinearPage* linear = nullptr;
    std::optional<features::LinkedPart> linked = {}; ///< lines that were already linked for the whole page
    /// If not null, the frame outputs linked lines here, and no picture.
    contour::LinkedLines* linked_out = nullptr;
    /// If not null, this image of the host application receives the picture instead of bytes.
    const VulkanPicture* target = nullptr;
};

/// The inputs of all steps of a frame; each step declares its passes from them.
struct FrameContext {
    gpu::Graph& graph;
    gpu::Device& device;
    LoadedScene& loaded; ///< the scene on the device, already posed
    Features& features;
    FrameBuffers& buffers;
    const FrameJob& job;
    const FramePlan& plan;
    const SamplePlan& sample;
    const features::StyleTables& style;
    /// Temporary list, filled for each frame; its memory is kept for the next frame.
    std::vector<wash::WashVariant>& wash_variants;
};

/// Declares the passes of one sample of a picture, in order. If the job has stroke lists, declares the passes
/// that fill these lists, and no passes that draw a picture.
void declare_frame(const FrameContext& context);

} // namespace estampe::frame
