// SPDX-License-Identifier: MIT
#pragma once

// What is decided on the processor before a picture is declared, in parts; also where its lens is focused.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"
#include "features/hatching/hatching.hpp"
#include "features/ink/flowing_ink.hpp"
#include "features/motion/motion.hpp"
#include "features/shadows/shadows.hpp"
#include "features/shadows/sun.hpp"
#include "features/smoke/rising_smoke.hpp"
#include "frame/loaded_scene.hpp"
#include "gpu/device.hpp"
#include "techniques/lens/lens.glsl.h"
#include "techniques/lens/lens.hpp"
#include "techniques/light/daylight.hpp"
#include "techniques/motion_blur/motion_blur.glsl.h"
#include "techniques/particles/particles.hpp"
#include "techniques/raster/raster.hpp"
#include "techniques/sky/clouds/clouds.hpp"
#include "techniques/subsurface/subsurface.hpp"
#include "techniques/terrain/drift/drift.hpp"
#include "techniques/terrain/ripples/ripples.hpp"

namespace estampe::frame {

/// The page, and what stands on it besides the scene.
struct PagePlan {
    glm::uvec2 size_px{0};
    float pixels_per_mm = 1.0F;
    features::PixelSize pixel; ///< what one of them spans in the scene
    bool has_ground = false;
    bool has_sky = false;
    bool shows_sky = false; ///< it is painted behind the scene, and not only into its haze
    bool has_haze = false;
};

/// How triangles become pixels.
struct RasterPlan {
    raster::Paths paths;
    raster::Tuning tuning;
};

/// The first of the directional lights.
struct SunPlan {
    glm::vec3 towards{0.0F, 1.0F, 0.0F};
    bool shines = false;               ///< else there is none
    std::optional<float> daylight_rad; ///< height of a sun that stands by place and hour
    Groups casters = all_groups;       ///< whose shadows it throws
    features::SunMapPlan map;
    features::GroundShadowPlan ground;
};

/// The light but for the sun's place.
struct LightPlan {
    uint32_t local_count = 0;
    bool leads_strokes = false;  ///< some strokes run along the light, and there are local lights
    bool has_links = false;      ///< not every light lights and shadows everything
    float lightmap_scale = 1.0F; ///< from the lightmaps' exposure to the frame's
    float ambient = 0.0F;        ///< luminance, where there is smoke
    bool meters_page = false;
    float adapt_stops = -1.0F; ///< most that the exposure by the page changes; negative: any
};

/// Light that goes into things.
struct SubsurfacePlan {
    std::vector<shared::SubsurfaceLook> looks; ///< as many as StyleVariants has styles
    std::vector<raster::Batch> bodies;         ///< that light comes through
    std::vector<raster::Batch> clear;          ///< that what lies behind is seen through
    std::vector<raster::Batch> others;         ///< where there are such, all else that is solid
    std::vector<raster::Batch> line_hiders;    ///< where some clear bodies show lines behind them and some do
                                               ///< not, all that is solid but the former
    bool lines_show = false;                   ///< behind all clear bodies
    bool scatters = false;
};

/// How the edges of shadows look.
struct EdgePlan {
    shared::EdgeLook look; ///< their teeth
    uint32_t variant = 0;  ///< see shadow/shadow_style.hpp
};

struct LinePlan {
    float half_px = 1.0F;        ///< of the widest of the scene
    bool of_shadows = false;     ///< edges of the sun's shadow are lines
    bool are_remembered = false; ///< the picture goes on from one before, or another may from this
};

/// Lines that point at what matters.
struct FocusPlan {
    std::vector<shared::FocusLine> lines;
    glm::vec2 middle_px{0.0F};
};

/// What is exposed for a while.
struct MotionBlurPlan {
    features::MotionPlan motion;
    shared::MotionBlurConstants constants;
    shared::SmearConstants smear;
};

/// A picture, all of its samples alike.
struct FramePlan {
    glm::uvec2 page_px{0}; ///< of the whole page, also where `page` has it smaller
    PagePlan page;
    RasterPlan raster;
    surface::SceneNeeds needs;
    features::StyleVariants looks;
    features::StrokePlan strokes;
    SunPlan sun;
    LightPlan light;
    EdgePlan shadow_edges;
    features::LocalMapPlan local_shadows;
    float occlusion_radius_m = 1.0F;
    std::optional<uint32_t> occlusion_texels; ///< side of the map in which it is found
    std::optional<uint32_t> scatter_texels;   ///< of that in which light spreads
    std::optional<SubsurfacePlan> subsurface;
    LinePlan lines;
    FocusPlan focus;
    std::optional<shared::RippleConstants> ripples; ///< of a terrain's sand
    std::optional<terrain::DriftPlan> drift;        ///< of it in the air
    std::optional<sky::CloudPlan> clouds;
    std::vector<particles::ParticlePlan> particles; ///< one a look of particles, the farthest first
    std::optional<shared::LensConstants> lens;
    std::optional<features::MotionPlan> motion;
    std::optional<MotionBlurPlan> motion_blur;
    std::optional<features::InkPlan> ink;         ///< that flows
    std::optional<std::vector<smoke::Box>> risen; ///< where smoke rose already, for cloth
    std::vector<smoke::Lamp> lamps;               ///< that smoke stands in, where the style has any
    std::optional<features::SmokePlan> smoke;
};

/// What of a picture differs from sample to sample, and from tile to tile. The first one leaves on the device
/// what the others find there.
struct SamplePlan {
    paper::Accumulation accumulation;
    bool is_first = true;             ///< nothing of the picture has been drawn yet
    glm::uvec2 size_px{0};            ///< of what is drawn: the page, or a tile
    glm::vec2 from_px{0.0F};          ///< where on the page that begins
    glm::mat4 clip_from_anchor{1.0F}; ///< shifted within a pixel
    bool pose_moved = true;           ///< the posed vertices are not yet those of this moment
    bool terrain_moved = false;       ///< nor are the ground's
    features::SunMapWork sun_map;
    float line_step_px = 3.0F; ///< between samples of lines, about
};

/// Lists of a plan that is done with, for the next one to fill.
struct PlanLists {
    std::vector<features::StyleTables> styles;
    std::vector<uint32_t> kind_of_draw;
};

/// What a plan is made from.
struct PlanInputs {
    const LoadedScene& loaded; ///< posed
    const light::Lighting& lighting;
    const std::optional<light::Daylight>& daylight;
    const Camera& camera;
    const RenderSettings& settings;
    const features::StyleTables& style;
    const gpu::Device& device;
    RasterPath raster_path = RasterPath::compute;   ///< never automatic
    RasterPath wanted_path = RasterPath::automatic; ///< before it was chosen
    sky::CloudMemory& clouds;
};

/// The plan of the same page in pixels `shrink` times as large each way, of which `size_px` hold it: what its
/// shadows and lights are stays as it was.
[[nodiscard]] FramePlan shrunk_plan(const FramePlan& plan, uint32_t shrink, glm::uvec2 size_px,
                                    const features::StyleTables& style);

/// Between samples of lines, about, so that they bend as finely on a page that is `shrink` times as large.
[[nodiscard]] inline float line_step_px(uint32_t shrink)
{
    return std::max(3.0F / static_cast<float>(shrink), 1.0F);
}

/// Plans all that needs no room on the device: shadows of local lights, motion, what the eye is used to and
/// what lines remember are left as they are by default. Cost: linear in draws.
[[nodiscard]] FramePlan plan_frame(const PlanInputs& in, PlanLists room = {});

struct LensSetting {
    const LoadedScene& loaded;
    const ScenePose& pose;
    const Camera& camera;
    const features::StyleTables& style;
    const PagePlan& page;
    float line_half_px = 1.0F;
};

/// How far before the eye, along the view, the plane in focus stands: as far as the style says, or the middle
/// of the objects that it names, or the middle of the scene. Adds a note for a name of nothing.
[[nodiscard]] double focus_distance_m(const LensSetting& in, std::vector<std::string>& notes);

/// The lens of a picture; none where the style has none, and in parallel projection, which adds a note.
[[nodiscard]] std::optional<shared::LensConstants> plan_lens(const LensSetting& in,
                                                             std::vector<std::string>& notes);

} // namespace estampe::frame
