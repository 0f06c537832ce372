// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <estampe/renderer.hpp>

#include "frame/deep_page.hpp"
#include "frame/local_maps.hpp"
#include "frame/motion.hpp"
#include "frame/strokes.hpp"
#include "frame/style_tables.hpp"
#include "frame/vectors.hpp"
#include "frame/view.hpp"
#include "gpu/graph/graph.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/contour/chains/brushes.hpp"
#include "techniques/contour/chains/line_history.hpp"
#include "techniques/contour/chains/line_mesh.hpp"
#include "techniques/light/light.hpp"
#include "techniques/lightmap/lightmap.hpp"
#include "techniques/pose/pose.hpp"
#include "techniques/raster/views.hpp"
#include "techniques/shadow/clipmap.hpp"
#include "techniques/shadow/edge_look.hpp"
#include "techniques/surface/materials.hpp"

namespace estampe::frame {

/// The buffers of the outside world that a frame reads and writes.
struct FrameResources {
    pose::MeshBuffers& meshes;
    surface::MaterialBuffers& materials;
    gpu::Buffer& frame_globals;
    gpu::Buffer& light_globals;
    gpu::Buffer& lights;
    gpu::Buffer& exposure; ///< light's ExposureState, kept from frame to frame
    gpu::Buffer& shadow_map;
    gpu::Buffer& edge_look;  ///< EdgeLook, see shadow/edge.glsl.h
    gpu::Buffer& sun_shadow; ///< SunShadow, see shadow/sun.glsl.h
    LocalShadowBuffers& local_shadows;
    gpu::Buffer& stroke_kinds;       ///< one a draw
    gpu::Buffer& form_coordinates;   ///< three a triangle, where strokes follow the form
    lightmap::MapBuffers* lightmaps; ///< where the scene has any
    hatch::MapImages* map;           ///< where strokes come from a map
    contour::LineMesh* line_mesh;    ///< where lines are chains
    contour::LineHistory& line_history;
    contour::BrushImages* brushes; ///< where lines have others than the pen
    gpu::Image& sums;              ///< of a picture of several samples
    gpu::Buffer& pixels;           ///< the picture, four bytes a pixel, for reading back
    gpu::Buffer& motion;           ///< read back where FramePlan::motion asks for it
    StrokeLists* lists = nullptr;  ///< where strokes are wanted in place of a picture
    DeepPage* deep = nullptr;      ///< where the picture is wanted in floats too
};

/// What is decided on the processor before a frame is declared.
struct FramePlan {
    glm::uvec2 size_px{0};
    glm::mat4 clip_from_anchor{1.0F};
    float pixels_per_mm = 1.0F;
    PixelSize pixel;
    RasterPath raster_path = RasterPath::compute;
    raster::Tuning raster;
    bool on_processor = false; ///< the device is no GPU
    surface::SceneNeeds needs;
    StrokePlan strokes;
    float lightmap_scale = 1.0F; ///< from the lightmaps' exposure to the frame's
    uint32_t local_light_count = 0;
    bool has_local_shadows = false;
    LocalMapViews local_views;        ///< maps of local lights to draw anew
    bool follows_local_light = false; ///< some strokes run along the light, and there are local lights
    bool lines_shadows = false;       ///< edges of the sun's shadow are lines
    bool meters_page = false;
    std::optional<MotionPlan> motion;
    float adapt_stops = -1.0F;       ///< most that the exposure by the page changes; negative: any
    bool has_light_links = false;    ///< not every light lights and shadows everything
    Groups sun_casters = all_groups; ///< whose shadows the sun throws
    bool ground_drawn = false;
    bool sky_drawn = false;
    uint32_t shadow_variant = 0;  ///< see shadow/edge_look.hpp
    shared::EdgeLook edge_look;   ///< teeth of shadows' edges
    uint32_t shadow_size = 0;     ///< texels a side; 0 for no shadow
    bool pose_moved = true;       ///< the posed vertices are not yet those of this moment
    bool redraw_shadow = true;    ///< the shadow map is not yet that of this moment
    bool remembers_lines = false; ///< the frame goes on from one before, or another may from this
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    shadow::SunView sun;
    std::optional<shadow::Clipmap> clipmap; ///< in place of a single map of the sun's view
    shadow::Windows sun_windows;
    std::vector<shadow::Piece> sun_pieces; ///< of the clipmap, not drawn yet
    std::optional<float> daylight_rad;     ///< height of a sun that stands by place and hour
    paper::Accumulation accumulation;

    /// Whether some strokes follow height, wind or light.
    [[nodiscard]] bool has_directions() const
    {
        return strokes.has(shared::strokes_height) || strokes.has(shared::strokes_wind) ||
               strokes.has(shared::strokes_light);
    }
};

/// Declares one frame, top to bottom.
void declare_frame(gpu::Graph& graph, const pose::MeshData& layout, FrameResources& resources,
                   const FramePlan& plan, const StyleTables& style);

} // namespace estampe::frame
