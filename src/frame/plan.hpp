// SPDX-License-Identifier: MIT
#pragma once

// The plan of a picture: everything that the CPU decides before passes are declared, divided into parts, and
// the focus distance of the lens.

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
#include "features/toon/toon.hpp"
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

/// Plan of the page, with its ground and sky.
struct PagePlan {
    glm::uvec2 size_px{0};
    float pixels_per_mm = 1.0F;
    features::PixelSize pixel; ///< size of a pixel in the scene
    bool has_ground = false;
    bool has_sky = false;
    /// The sky is painted behind the scene; otherwise the sky's colour only appears in haze.
    bool shows_sky = false;
    bool has_haze = false;
};

/// Plan of how triangles are rasterised.
struct RasterPlan {
    raster::Paths paths;
    raster::Tuning tuning;
};

/// Plan of the sun, which is the first directional light.
struct SunPlan {
    glm::vec3 towards{0.0F, 1.0F, 0.0F};
    bool shines = false;               ///< the scene has a directional light
    std::optional<float> daylight_rad; ///< elevation of the sun, if location and time of day determine it
    Groups casters = all_groups;       ///< groups of objects that cast shadows in this light
    features::SunMapPlan map;
    features::GroundShadowPlan ground;
};

/// Plan of all lights, except for the position of the sun.
struct LightPlan {
    uint32_t local_count = 0;
    /// Some strokes follow the light's direction, and there are local lights (lamps).
    bool leads_strokes = false;
    bool has_links = false;      ///< some objects are not lit or shadowed by all lights
    float lightmap_scale = 1.0F; ///< factor that converts the lightmap's exposure to the frame's exposure
    float ambient = 0.0F;        ///< luminance of the ambient light; only set if there is smoke
    bool meters_page = false;
    float adapt_stops = -1.0F; ///< largest change of the automatic exposure, in stops; negative: no limit
};

/// Plan of subsurface scattering, transmission, and clear bodies (objects that show what lies behind them,
/// such as glass).
struct SubsurfacePlan {
    /// Parameters of subsurface scattering, one entry per style of StyleVariants.
    std::vector<shared::SubsurfaceParameters> parameters;
    std::vector<raster::Batch> bodies; ///< runs of triangles that transmit light
    std::vector<raster::Batch> clear;  ///< runs of triangles that show what lies behind them, as glass does
    /// Runs of solid triangles that are not in `clear`; empty if `clear` is empty.
    std::vector<raster::Batch> others;
    /// Runs of all solid triangles that hide lines; filled if only some clear bodies (such as glass) show the
    /// lines behind them.
    std::vector<raster::Batch> line_hiders;
    bool refracts = false;   ///< some clear bodies bend what is seen through them
    bool lines_show = false; ///< all clear bodies (such as glass) show the lines behind them
    bool scatters = false;
};

/// Plan of the edges of shadows.
struct EdgePlan {
    shared::EdgeProfile profile; ///< shape of jagged shadow edges
    uint32_t variant = 0;        ///< variant of the shadow shader, see shadow/shadow_style.hpp
};

struct LinePlan {
    float half_px = 1.0F;        ///< half the width of the scene's widest line, in pixels
    bool of_shadows = false;     ///< the edges of the sun's shadow are drawn as ink lines
    bool are_remembered = false; ///< lines continue from one picture of a film to the next
};

/// Plan of focus lines, which point at the centre of attention.
struct FocusPlan {
    std::vector<shared::FocusLine> lines;
    glm::vec2 middle_px{0.0F};
};

/// Plan of the motion blur during the exposure time.
struct MotionBlurPlan {
    features::MotionPlan motion;
    shared::MotionBlurConstants constants;
    shared::SmearConstants smear;
};

/// The plan of one picture, the same for all of its samples.
struct FramePlan {
    glm::uvec2 page_px{0}; ///< size of the whole page, even while `page` describes a tile or a survey
    PagePlan page;
    RasterPlan raster;
    /// Rooms that are not seen through portals are not drawn on the page.
    bool culls_cells = false;
    surface::SceneNeeds needs;
    features::StyleVariants variants;
    features::StrokePlan strokes;
    SunPlan sun;
    LightPlan light;
    EdgePlan shadow_edges;
    features::LocalMapPlan local_shadows;
    float occlusion_radius_m = 1.0F;
    /// Side of the texture atlas for ambient occlusion; none: occlusion is computed per pixel.
    std::optional<uint32_t> occlusion_texels;
    /// Side of the texture atlas for subsurface light; none: light spreads on the page.
    std::optional<uint32_t> scatter_texels;
    std::optional<SubsurfacePlan> subsurface;
    features::ToonPlan toon; ///< plan of the colours that surfaces have in the shade
    LinePlan lines;
    FocusPlan focus;
    std::optional<shared::RippleConstants> ripples; ///< wind ripples in a terrain's sand
    std::optional<terrain::DriftPlan> drift;        ///< wind-blown sand in the air
    std::optional<sky::CloudPlan> clouds;
    /// Plans of the particles, one per style variant, the farthest first.
    std::vector<particles::ParticlePlan> particles;
    std::optional<shared::LensConstants> lens;
    std::optional<features::MotionPlan> motion;
    std::optional<MotionBlurPlan> motion_blur;
    std::optional<features::InkPlan> ink; ///< plan of the flowing ink
    /// Boxes of smoke, if the smoke was already simulated because its velocity is the wind on cloth.
    std::optional<std::vector<smoke::Box>> risen;
    std::vector<smoke::Lamp> lamps; ///< lamps that light smoke; empty without smoke
    std::optional<features::SmokePlan> smoke;
};

/// The part of a picture's plan that differs between samples and tiles. Results of the picture's first sample
/// stay on the device, and later samples reuse the results.
struct SamplePlan {
    paper::Accumulation accumulation;
    bool is_first = true;             ///< no sample or tile of the picture has been drawn yet
    glm::uvec2 size_px{0};            ///< size of the image that is drawn: the page or a tile
    glm::vec2 from_px{0.0F};          ///< position of the image's first pixel on the page
    glm::mat4 clip_from_anchor{1.0F}; ///< camera matrix of the sample, with its subpixel jitter
    bool pose_moved = true;           ///< the posed vertices on the device are out of date
    bool terrain_moved = false;       ///< the terrain's vertices on the device are out of date
    features::SunMapWork sun_map;
    float line_step_px = 3.0F; ///< approximate distance between sample points along a line
};

/// Lists of an earlier plan. The next plan reuses their memory.
struct PlanLists {
    std::vector<features::StyleTables> styles;
    std::vector<uint32_t> kind_of_draw;
};

/// The inputs for planning a picture.
struct PlanInputs {
    const LoadedScene& loaded; ///< the scene on the device, already posed
    const light::Lighting& lighting;
    const std::optional<light::Daylight>& daylight;
    const Camera& camera;
    const RenderSettings& settings;
    const features::StyleTables& style;
    const gpu::Device& device;
    /// Path with which triangles are rasterised; never RasterPath::automatic.
    RasterPath raster_path = RasterPath::compute;
    /// Raster path that the options request; may be RasterPath::automatic.
    RasterPath wanted_path = RasterPath::automatic;
    sky::CloudMemory& clouds;
};

/// Returns the picture's plan for the page at lower resolution. Pixels are `shrink` times as large in each
/// direction, and the page has `size_px` pixels. Shadows and lights stay unchanged.
[[nodiscard]] FramePlan shrunk_plan(const FramePlan& plan, uint32_t shrink, glm::uvec2 size_px,
                                    const features::StyleTables& style);

/// Approximate distance between sample points along a line. On a page that is `shrink` times smaller, the
/// distance is shorter, so that lines have the shape that they have on the full page.
[[nodiscard]] inline float line_step_px(uint32_t shrink)
{
    return std::max(3.0F / static_cast<float>(shrink), 1.0F);
}

/// Plans the parts of a picture that allocate nothing on the device. Shadows of lamps, motion, exposure
/// adaptation and the history of lines keep their default values. Cost: linear in draw calls.
[[nodiscard]] FramePlan plan_frame(const PlanInputs& in, PlanLists room = {});

struct LensSetting {
    const LoadedScene& loaded;
    const ScenePose& pose;
    const Camera& camera;
    const features::StyleTables& style;
    const PagePlan& page;
    float line_half_px = 1.0F;
};

/// Distance from the eye to the plane in focus, along the view direction. The style sets the distance, or
/// names objects whose middle is in focus; otherwise the middle of the scene is in focus. Adds a note for a
/// name that matches no object.
[[nodiscard]] double focus_distance_m(const LensSetting& in, std::vector<std::string>& notes);

/// Plans the lens of a picture. Returns nothing if the style has no lens. For a parallel projection also
/// returns nothing, and adds a note.
[[nodiscard]] std::optional<shared::LensConstants> plan_lens(const LensSetting& in,
                                                             std::vector<std::string>& notes);

} // namespace estampe::frame
