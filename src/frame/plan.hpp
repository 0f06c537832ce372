// SPDX-License-Identifier: MIT
#pragma once

// The plan of a picture: everything that the processor decides before passes are declared, in parts, and the
// focus distance of the lens.

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

/// The page, with its ground and sky.
struct PagePlan {
    glm::uvec2 size_px{0};
    float pixels_per_mm = 1.0F;
    features::PixelSize pixel; ///< size of a pixel in the scene
    bool has_ground = false;
    bool has_sky = false;
    bool shows_sky = false; ///< the sky is painted behind the scene; otherwise only haze takes its colour
    bool has_haze = false;
};

/// How triangles are rasterised.
struct RasterPlan {
    raster::Paths paths;
    raster::Tuning tuning;
};

/// The first directional light.
struct SunPlan {
    glm::vec3 towards{0.0F, 1.0F, 0.0F};
    bool shines = false;               ///< false without a directional light
    std::optional<float> daylight_rad; ///< elevation of a sun that is placed by location and time of day
    Groups casters = all_groups;       ///< groups of objects whose shadows this light casts
    features::SunMapPlan map;
    features::GroundShadowPlan ground;
};

/// All lights, except for the sun's position.
struct LightPlan {
    uint32_t local_count = 0;
    bool leads_strokes = false;  ///< some strokes follow the light, and there are local lights
    bool has_links = false;      ///< some objects are not lit or shadowed by all lights
    float lightmap_scale = 1.0F; ///< factor from the lightmap's exposure to the frame's
    float ambient = 0.0F;        ///< luminance of the ambient light; set only if there is smoke
    bool meters_page = false;
    float adapt_stops = -1.0F; ///< largest change of the automatic exposure; negative sets no limit
};

/// Subsurface scattering and transmission, and clear bodies.
struct SubsurfacePlan {
    std::vector<shared::SubsurfaceParameters> parameters; ///< one per style of StyleVariants
    std::vector<raster::Batch> bodies;                    ///< triangles that transmit light
    std::vector<raster::Batch> clear;                     ///< triangles that show what lies behind them
    std::vector<raster::Batch> others;      ///< solid triangles not in `clear`; empty if `clear` is empty
    std::vector<raster::Batch> line_hiders; ///< all solid triangles that hide lines; filled if only some of
                                            ///< the clear bodies show lines
    bool lines_show = false;                ///< all clear bodies show the lines behind them
    bool scatters = false;
};

/// How the edges of shadows are drawn.
struct EdgePlan {
    shared::EdgeProfile profile; ///< jagged edges
    uint32_t variant = 0;        ///< shader variant, see shadow/shadow_style.hpp
};

struct LinePlan {
    float half_px = 1.0F;        ///< half of the widest line of the scene
    bool of_shadows = false;     ///< the edges of the sun's shadow are drawn as lines
    bool are_remembered = false; ///< lines continue from picture to picture
};

/// Focus lines, which point at the centre of attention.
struct FocusPlan {
    std::vector<shared::FocusLine> lines;
    glm::vec2 middle_px{0.0F};
};

/// Motion during the exposure time.
struct MotionBlurPlan {
    features::MotionPlan motion;
    shared::MotionBlurConstants constants;
    shared::SmearConstants smear;
};

/// The plan of one picture, equal for all of its samples.
struct FramePlan {
    glm::uvec2 page_px{0}; ///< size of the whole page, even if `page` has a smaller one
    PagePlan page;
    RasterPlan raster;
    surface::SceneNeeds needs;
    features::StyleVariants variants;
    features::StrokePlan strokes;
    SunPlan sun;
    LightPlan light;
    EdgePlan shadow_edges;
    features::LocalMapPlan local_shadows;
    float occlusion_radius_m = 1.0F;
    std::optional<uint32_t> occlusion_texels; ///< side of the map for occlusion; none computes it per pixel
    std::optional<uint32_t> scatter_texels;   ///< side of the map for subsurface light; none uses the page
    std::optional<SubsurfacePlan> subsurface;
    LinePlan lines;
    FocusPlan focus;
    std::optional<shared::RippleConstants> ripples; ///< ripples in a terrain's sand
    std::optional<terrain::DriftPlan> drift;        ///< wind-blown sand in the air
    std::optional<sky::CloudPlan> clouds;
    std::vector<particles::ParticlePlan> particles; ///< one per style of particles, the farthest first
    std::optional<shared::LensConstants> lens;
    std::optional<features::MotionPlan> motion;
    std::optional<MotionBlurPlan> motion_blur;
    std::optional<features::InkPlan> ink;         ///< flowing ink
    std::optional<std::vector<smoke::Box>> risen; ///< boxes of smoke already simulated for cloth
    std::vector<smoke::Lamp> lamps;               ///< lamps that light smoke; empty without smoke
    std::optional<features::SmokePlan> smoke;
};

/// The part of a picture's plan that differs between samples and tiles. The first sample leaves results on
/// the device that the other samples reuse.
struct SamplePlan {
    paper::Accumulation accumulation;
    bool is_first = true;             ///< true before anything of the picture has been drawn
    glm::uvec2 size_px{0};            ///< size of the image that is drawn: page or tile
    glm::vec2 from_px{0.0F};          ///< position of the image's first pixel on the page
    glm::mat4 clip_from_anchor{1.0F}; ///< with subpixel jitter
    bool pose_moved = true;           ///< the posed vertices on the device are out of date
    bool terrain_moved = false;       ///< the terrain's vertices on the device are out of date
    features::SunMapWork sun_map;
    float line_step_px = 3.0F; ///< approximate distance between samples along a line
};

/// Lists of an old plan, whose capacity the next plan reuses.
struct PlanLists {
    std::vector<features::StyleTables> styles;
    std::vector<uint32_t> kind_of_draw;
};

/// The inputs of a plan.
struct PlanInputs {
    const LoadedScene& loaded; ///< already posed
    const light::Lighting& lighting;
    const std::optional<light::Daylight>& daylight;
    const Camera& camera;
    const RenderSettings& settings;
    const features::StyleTables& style;
    const gpu::Device& device;
    RasterPath raster_path = RasterPath::compute;   ///< never automatic
    RasterPath wanted_path = RasterPath::automatic; ///< as set in the options; may be automatic
    sky::CloudMemory& clouds;
};

/// Returns the plan of the same page with pixels `shrink` times as large in each direction, `size_px` in all.
/// Shadows and lights stay unchanged.
[[nodiscard]] FramePlan shrunk_plan(const FramePlan& plan, uint32_t shrink, glm::uvec2 size_px,
                                    const features::StyleTables& style);

/// Approximate distance between samples along a line. The distance is chosen so that lines bend as finely as
/// on a page that is `shrink` times as large.
[[nodiscard]] inline float line_step_px(uint32_t shrink)
{
    return std::max(3.0F / static_cast<float>(shrink), 1.0F);
}

/// Plans everything that allocates nothing on the device. Leaves the defaults for shadows of local lights,
/// motion, exposure adaptation and the history of lines. Cost: linear in draw calls.
[[nodiscard]] FramePlan plan_frame(const PlanInputs& in, PlanLists room = {});

struct LensSetting {
    const LoadedScene& loaded;
    const ScenePose& pose;
    const Camera& camera;
    const features::StyleTables& style;
    const PagePlan& page;
    float line_half_px = 1.0F;
};

/// Distance from the eye to the plane in focus, along the view direction. The distance is set by the style,
/// or else by the middle of the objects that the style names, or else by the middle of the scene. Adds a note
/// for a name that matches no object.
[[nodiscard]] double focus_distance_m(const LensSetting& in, std::vector<std::string>& notes);

/// Plans the lens of a picture. Returns none if the style has no lens, and in parallel projection, for which
/// it adds a note.
[[nodiscard]] std::optional<shared::LensConstants> plan_lens(const LensSetting& in,
                                                             std::vector<std::string>& notes);

} // namespace estampe::frame
