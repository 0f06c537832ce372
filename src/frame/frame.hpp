// SPDX-License-Identifier: MIT
#pragma once

#include "frame/clouds.hpp"
#include "frame/deep_page.hpp"
#include "frame/local_maps.hpp"
#include "frame/moving_cloth.hpp"
#include "frame/particles.hpp"
#include "frame/plan.hpp"
#include "frame/style_tables.hpp"
#include "frame/sun_casters.hpp"
#include "frame/surface_map.hpp"
#include "frame/tonal_maps.hpp"
#include "frame/vectors.hpp"
#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/history/line_history.hpp"
#include "techniques/contour/chains/ink/brushes.hpp"
#include "techniques/contour/chains/mesh/line_mesh.hpp"
#include "techniques/contour/chains/stroke/strung_lines.hpp"
#include "techniques/ink/ink.hpp"
#include "techniques/lightmap/lightmap.hpp"
#include "techniques/motion_blur/smear.hpp"
#include "techniques/motion_blur/stretch.hpp"
#include "techniques/occlusion/discs/disc_map.hpp"
#include "techniques/pose/pose.hpp"
#include "techniques/raster/clusters/clusters.hpp"
#include "techniques/surface/materials.hpp"
#include "techniques/terrain/terrain_buffers.hpp"
#include "techniques/terrain/trails/trodden.hpp"

namespace estampe::frame {

/// Lines that were strung for the whole page, and the part of it that is inked.
struct StrungPart {
    StrungPart(contour::StrungLines& strung_lines, const contour::PartOfPage& part_of_page)
        : lines(strung_lines), part(part_of_page)
    {
    }

    contour::StrungLines& lines;
    contour::PartOfPage part;
};

/// Lists that each frame fills anew, in the room that the one before took.
struct FrameLists {
    std::vector<raster::Batch> casters; ///< that the sun's shadow map is drawn from
    std::vector<hatch::LookHatch> hatch_looks;
    std::vector<wash::LookWash> wash_looks;
};

/// The buffers of the outside world that a frame reads and writes.
struct FrameResources {
    gpu::Device& device;
    FrameLists& frame_lists;
    pose::MeshBuffers& meshes;
    raster::ClusterBoxes& cluster_boxes;
    const pose::PoseData& pose; ///< of this moment
    surface::MaterialBuffers& materials;
    gpu::Buffer& frame_globals;
    gpu::Buffer& light_globals;
    gpu::Buffer& lights;
    gpu::Buffer& exposure; ///< light's ExposureState, kept from frame to frame
    gpu::Buffer& shadow_map;
    gpu::Buffer& still_shadow_map; ///< see SunMap
    gpu::Buffer& sun_views;
    gpu::Buffer& sun_pictures;
    gpu::Buffer& sun_tiles;
    gpu::Buffer& edge_look;  ///< EdgeLook, see shadow/edge.glsl.h
    gpu::Buffer& sun_shadow; ///< SunShadow, see shadow/sun.glsl.h
    LocalShadowBuffers& local_shadows;
    gpu::Buffer& stroke_kinds;              ///< one a draw
    gpu::Buffer& form_coordinates;          ///< three a triangle, where strokes follow the form
    lightmap::MapBuffers* lightmaps;        ///< where the scene has any
    TonalMaps& maps;                        ///< one a look
    gpu::Buffer& look_of_draw;              ///< where surfaces differ, as LookPlan has it
    gpu::Buffer& line_looks;                ///< then, contour's LineLook of each look
    gpu::Buffer& subsurface_looks;          ///< where light goes into things
    occlusion::DiscBuffers& discs;          ///< where occlusion is found between them
    occlusion::DiscMapBuffers& disc_map;    ///< then, in a map
    SurfaceMap* occlusion_map = nullptr;    ///< then
    SurfaceMap* scatter_map = nullptr;      ///< that light spreads in
    gpu::Buffer& map_frame;                 ///< then: FrameGlobals, of a page as large as the map
    gpu::Buffer& half_frame;                ///< FrameGlobals of every second pixel each way
    motion_blur::TogetherBuffers& together; ///< where meshes are drawn out
    motion_blur::SmearSeeds& smear_seeds;   ///< where strokes begin
    std::span<const StillCaster> still_casters;
    GroundShadow& ground_shadow;
    MovingCloth* cloth;               ///< where the scene has any
    const ClothSteps* cloth_steps;    ///< that it has yet to take
    terrain::TerrainBuffers* terrain; ///< where the scene has one
    terrain::TroddenSand* trodden;    ///< then
    contour::LineMesh* line_mesh;     ///< where lines are chains
    contour::LineHistory& line_history;
    gpu::Buffer& focus_lines;                ///< of the plan
    CloudBuffers& clouds;                    ///< where the plan has any
    std::vector<ParticleBuffers>& particles; ///< as many as the plan has looks of them
    contour::BrushImages* brushes;           ///< where lines have others than the pen
    gpu::Image& sums;                        ///< of a picture of several samples
    gpu::Buffer& pixels;                     ///< the picture, four bytes a pixel, for reading back
    gpu::Buffer& motion;                     ///< read back where the plan asks for it
    ink::Memory& ink;                        ///< that flows, where the plan has any
    RisingSmoke& smoke;                      ///< risen, where the plan has any
    StrokeLists* lists = nullptr;            ///< where strokes are wanted in place of a picture
    DeepPage* deep = nullptr;                ///< where the picture is wanted in floats too
    std::optional<StrungPart> strung = {};   ///< where lines are strung already
    /// Where what tiles share is wanted in place of a picture: lines, and how bright the page is.
    contour::StrungLines* strung_into = nullptr;
    const VulkanPicture* target = nullptr; ///< of the host's, where the picture goes in place of `pixels`
};

/// Declares one sample of a picture, top to bottom; or where there are lists, what fills those in its place.
void declare_frame(gpu::Graph& graph, const pose::MeshData& layout, FrameResources& resources,
                   const FramePlan& plan, const SamplePlan& sample, const StyleTables& style);

} // namespace estampe::frame
