// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "frame/flowing_ink.hpp"
#include "frame/frame.hpp"
#include "frame/line_brushes.hpp"
#include "frame/loaded_scene.hpp"
#include "frame/local_shadows.hpp"
#include "frame/page.hpp"
#include "frame/rising_smoke.hpp"
#include "frame/sun.hpp"
#include "frame/tonal_maps.hpp"
#include "frame/vectors.hpp"
#include "gpu/graph/compile_ahead.hpp"
#include "gpu/graph/execute.hpp"
#include "techniques/light/exposure/exposure.hpp"
#include "techniques/raster/choose_path.hpp"

namespace estampe {

/// One frame of a picture: which sample, of which part of the page, and what is wanted of it.
struct FrameJob {
    paper::Accumulation accumulation;
    bool is_first = true;                 ///< of the picture's frames
    std::optional<frame::PixelRect> tile; ///< of the page; else all of it
    std::optional<frame::Survey> survey;  ///< the page in fewer pixels
    frame::StrokeLists* lists = nullptr;  ///< strokes as paths in place of pixels
    frame::DeepPage* deep = nullptr;      ///< floats beside bytes
    std::optional<frame::StrungPart> strung = {};
    contour::StrungLines* strung_into = nullptr; ///< what tiles share in place of pixels
    const VulkanPicture* target = nullptr;       ///< of the host's, in place of bytes
};

/// The scene as it stood when it was asked for last.
struct PosedScene {
    ScenePose pose;
    double time_s = 0.0;
    Index animation = 0;
    bool is_known = false;
    bool is_on_device = false; ///< as far as the processor has a part in that
};

struct Renderer::Impl {
    explicit Impl(RendererOptions renderer_options)
        : options(std::move(renderer_options)), device(options), executor(device),
          raster_path(raster::choose_path(device, executor, options.raster))
    {
        // Under validation names are given to objects by functions that a second instance would take away.
        if (device.info().software && !options.validation) {
            ahead = std::make_unique<gpu::CompileAhead>(options);
        }
    }

    Impl(const VulkanHost& host, RendererOptions renderer_options)
        : options(std::move(renderer_options)), device(host), executor(device),
          raster_path(raster::choose_path(device, executor, options.raster))
    {
    }

    void update_pose(const ScenePose& scene_pose);

    /// Poses what does not stand as it does now; pose::keep_posed() is to be called when the graph has run.
    [[nodiscard]] gpu::BufferId add_moved(gpu::Graph& graph);
    [[nodiscard]] frame::SunCasters sun_casters(const frame::FramePlan& plan) const;
    /// The device has posed the vertices.
    void posed();
    /// Poses the scene, unless that is how it stands; valid until another moment is asked for.
    const ScenePose& pose_at(const RenderSettings& settings);
    /// Takes the anchor along with an eye that has gone far over the ground, so that floats stay fine there.
    void follow_eye(const Camera& camera);
    [[nodiscard]] light::Lighting gather_lights(const Camera& camera, const ScenePose& scene_pose,
                                                const frame::StyleTables& tables);
    /// Brings the ground to where the eye is.
    void update_terrain(const Camera& camera, const RenderSettings& settings,
                        const frame::StyleTables& style);
    /// Tells cloth how the air of smoke moves, where the style has it blow; which lets that rise.
    [[nodiscard]] std::optional<std::vector<smoke::Box>>
    blow_cloth(const ScenePose& pose, const frame::StyleTables& style, const RenderSettings& settings);
    /// Brings cloth to where the picture wants it, but for `last_of_cloth`. Returns whether the scene was
    /// posed on the way, as it was somewhere there.
    [[nodiscard]] bool update_cloth(const RenderSettings& settings, const frame::StyleTables& style);
    /// Tells cloth that moves where solids are, and maps of shadows where it is; when the scene has been
    /// posed as it is now.
    void place_cloth(const ScenePose& pose, const RenderSettings& settings, const frame::StyleTables& style);
    void start_cloth(const frame::ClothRun& run, const RenderSettings& settings,
                     const frame::StyleTables& style);
    void step_cloth(const frame::ClothSteps& steps, const RenderSettings& settings,
                    const frame::StyleTables& style);
    /// Leaves out what is torn of sheets, and draws again what is whole. Cost: where any may tear, their torn
    /// links are read back, and where others are torn than before, triangles are uploaded and lines found
    /// anew.
    void tear_cloth();
    /// Poses what moved, and tells cloth where solids are.
    [[nodiscard]] gpu::BufferId pose_for_cloth(gpu::Graph& graph, double time_s, Index animation,
                                               const frame::StyleTables& style);
    /// What the ink of a picture that has been prepared is planned from.
    [[nodiscard]] frame::FlowingInkInputs ink_inputs(const Camera& camera, const frame::StyleTables& tables,
                                                     const RenderSettings& settings);
    /// The smoke of a picture that has been prepared; risen and lit on the device.
    [[nodiscard]] std::optional<frame::SmokePlan> plan_smoke(const frame::FramePlan& plan,
                                                             const frame::StyleTables& tables,
                                                             const RenderSettings& settings);
    /// The moment before that a picture looks back to, where it does: of its motion, of the ink that flows,
    /// of its exposure.
    [[nodiscard]] std::optional<double> moment_before(const RenderSettings& settings,
                                                      const frame::StyleTables& style) const;
    [[nodiscard]] std::optional<frame::MotionBlurPlan>
    plan_motion_blur(const Camera& camera, const frame::PagePlan& page_plan, float line_half_px,
                     const frame::StyleTables& style, const RenderSettings& settings);
    /// Poses the scene on the device as it was at another moment, so that the next update_pose() keeps that
    /// beside it.
    void pose_before(const ScenePose& scene_pose);
    /// To be called when the scene has been posed as it is now.
    [[nodiscard]] frame::MotionPlan motion_between(const Camera& before, const Camera& now,
                                                   const RenderSettings& settings) const;
    [[nodiscard]] frame::MotionPlan plan_motion(const Camera& camera, const RenderSettings& settings);
    /// Plans the maps of local lights, makes room for them, and says who goes without. Fills in the records'
    /// `shadow`.
    [[nodiscard]] frame::LocalMapPlan provide_local_shadows(const frame::PagePlan& page_plan,
                                                            light::Lighting& lighting, const Camera& camera,
                                                            const frame::StyleTables& tables);
    /// Hands the device what the light's shaders read.
    void provide_lighting(const frame::FramePlan& plan, const light::Lighting& lighting,
                          const frame::StyleTables& tables);
    /// What of that, and of lines, hangs on how large a pixel is.
    void provide_pixel_sizes(const frame::FramePlan& plan, const frame::StyleTables& tables);
    void provide_strokes(const frame::StrokePlan& strokes);
    void provide_looks(const frame::FramePlan& plan);
    /// Maps that lie on all surfaces, where the style wants any.
    void provide_surface_maps(const frame::FramePlan& plan);
    /// All that comes before the first sample. Throws Error as Renderer::render() does.
    [[nodiscard]] frame::FramePlan prepare(const Camera& camera, const frame::StyleTables& tables,
                                           const RenderSettings& settings);
    /// Draws into the page, and what else the job asks for.
    void draw_frame(const Camera& camera, const frame::StyleTables& style, const frame::FramePlan& plan,
                    const FrameJob& job);
    /// Whether a picture is to be drawn in tiles: it is wanted so, or too large for the device.
    [[nodiscard]] bool is_tiled(const RenderSettings& settings) const;
    /// The same picture as draw_picture() makes, tile by tile.
    void draw_tiles(const Camera& camera, const Style& style, const RenderSettings& settings,
                    const BandSink& sink);
    /// Has ink flow over a page that is drawn in one go, for one in tiles.
    [[nodiscard]] frame::InkPlan let_ink_flow(const Camera& camera, const frame::StyleTables& tables,
                                              const RenderSettings& settings);
    /// What tiles share: the lines of each sample, and how bright the page is.
    [[nodiscard]] std::vector<contour::StrungLines>
    survey_page(const Camera& camera, const frame::StyleTables& style, const frame::FramePlan& plan,
                const frame::Survey& survey, uint32_t samples);
    /// All samples of a picture, which is empty where it goes into a `target`. `after_sample` is called after
    /// each.
    [[nodiscard]] Image draw_picture(const Camera& camera, const Style& style, const RenderSettings& settings,
                                     frame::DeepPage* deep = nullptr,
                                     const std::function<void()>& after_sample = {},
                                     const VulkanPicture* target = nullptr);

    RendererOptions options;
    gpu::Device device;
    gpu::Executor executor;
    std::unique_ptr<gpu::CompileAhead> ahead; ///< until the first frame is drawn
    RasterPath raster_path;                   ///< chosen as the device was opened
    std::optional<RasterPath> page_path;      ///< of the last page
    std::optional<frame::LoadedScene> loaded;
    PosedScene posed_scene;
    std::optional<frame::ClothSteps> last_of_cloth; ///< which the picture's first graph takes
    gpu::Buffer frame_globals;
    gpu::Buffer light_globals;
    gpu::Buffer lights;
    light::ExposureMemory exposure;
    frame::SunMap sun_map;
    frame::GroundShadow ground_shadow;
    gpu::Buffer edge_look;
    gpu::Buffer sun_shadow;
    frame::LocalShadows local_shadows;
    frame::LocalShadowBuffers local_shadow_buffers;
    bool poses_anyway = false; ///< where nothing has moved, too
    std::vector<Bounds> moved; ///< since the local shadows were planned last
    gpu::Buffer stroke_kinds;
    gpu::Buffer form_coordinates;
    frame::TonalMaps tonal_maps;
    gpu::Buffer look_of_draw;
    gpu::Buffer line_looks;
    gpu::Buffer subsurface_looks;
    gpu::Buffer map_frame_globals;
    gpu::Buffer half_frame_globals;
    gpu::Buffer focus_lines;
    frame::CloudBuffers clouds;
    std::vector<frame::ParticleBuffers> particles;
    contour::LineHistory line_history;
    bool is_of_film = false; ///< the last frame
    frame::LineBrushes line_brushes;
    frame::FlowingInk flowing_ink;
    frame::RisingSmoke rising_smoke;
    frame::Page page;
    gpu::Buffer motion_pixels;
    Motion motion;
    sky::CloudMemory cloud_memory;
    frame::PlanLists plan_lists; ///< of the picture before
    frame::FrameLists frame_lists;
    gpu::Graph declared; ///< room for the next frame's
    gpu::Graph drawn;    ///< the last frame, to look at; its resources may be gone
    std::vector<std::string> notes;
};

/// The camera of the whole page, whose window shows what `camera` does. Throws Error for one that nothing can
/// be seen by.
[[nodiscard]] Camera page_camera(const Camera& camera, const paper::PaperStyle& style,
                                 const RenderSettings& settings);

} // namespace estampe
