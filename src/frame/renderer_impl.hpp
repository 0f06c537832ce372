// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "frame/frame.hpp"
#include "frame/loaded_scene.hpp"
#include "gpu/graph/compile_ahead.hpp"
#include "gpu/graph/execute.hpp"
#include "techniques/raster/paths.hpp"

namespace estampe {

using frame::FrameJob;

/// The pose of the scene that the last picture requested.
struct PosedScene {
    ScenePose pose;
    double time_s = 0.0;
    Index animation = 0;
    bool is_known = false;
    bool is_on_device = false; ///< the CPU has finished its part of the upload
};

struct Renderer::Impl {
    explicit Impl(RendererOptions renderer_options)
        : options(std::move(renderer_options)), device(options), executor(device),
          raster_path(raster::choose_path(device, executor, options.raster))
    {
        // With validation, Vulkan objects get names through global function pointers. The pointers of a
        // second Vulkan instance must not replace the global ones.
        if (device.info().software && !options.validation) {
            ahead = std::make_unique<gpu::CompileAhead>(options);
        }
    }

    Impl(const VulkanHost& host, RendererOptions renderer_options)
        : options(std::move(renderer_options)), device(host), executor(device),
          raster_path(raster::choose_path(device, executor, options.raster))
    {
    }

    /// Returns the style's tables with the factors of its section [drawing] applied, and with the wind over
    /// the loaded scene; valid until the next call.
    [[nodiscard]] const features::StyleTables& tables_of(const Style& style)
    {
        const Terrain* const terrain = loaded && loaded->scene.terrain ? &*loaded->scene.terrain : nullptr;
        return features::with_shared_sections(features::with_drawing(style.tables(), drawn_style), terrain,
                                              drawn_style);
    }

    void update_pose(const ScenePose& scene_pose);

    /// Adds passes that compute the posed positions of all vertices that have moved. After the graph has run,
    /// call pose::keep_posed().
    [[nodiscard]] gpu::BufferId add_moved(gpu::Graph& graph);
    /// Records that the posed vertices on the device are up to date.
    void posed();
    /// Poses the scene at the settings' time, unless the scene already has this pose. The result is valid
    /// until the next call.
    const ScenePose& pose_at(const RenderSettings& settings);
    /// Moves the anchor (the origin of positions on the device) towards the eye when the eye has travelled
    /// far over the ground. Floats then stay precise near the eye.
    void follow_eye(const Camera& camera);
    [[nodiscard]] light::Lighting gather_lights(const Camera& camera, const ScenePose& scene_pose,
                                                const features::StyleTables& tables);
    /// Updates the terrain's mesh for the position of the eye.
    void update_terrain(const Camera& camera, const RenderSettings& settings,
                        const features::StyleTables& style);
    /// Informs the features of new meshes, and rebuilds the cloth. Call this function whenever the meshes may
    /// have been rebuilt.
    void note_layout();
    /// Passes the velocity of smoke to cloth as wind, if the style asks for it. Simulates the smoke first,
    /// and returns its boxes.
    [[nodiscard]] std::optional<std::vector<smoke::Box>>
    blow_cloth(const ScenePose& pose, const features::StyleTables& style, const RenderSettings& settings);
    [[nodiscard]] features::ClothInputs cloth_inputs(const RenderSettings& settings,
                                                     const features::StyleTables& style);
    /// The inputs for planning the flowing ink of a prepared picture.
    [[nodiscard]] features::FlowingInkInputs
    ink_inputs(const Camera& camera, const features::StyleTables& tables, const RenderSettings& settings);
    /// Returns the blasts of the smoke, for particles and ink.
    [[nodiscard]] std::vector<features::Blast> blasts_at(const ScenePose& pose,
                                                         const features::StyleTables& tables) const;
    /// Plans the smoke of a prepared picture, and simulates and lights the smoke on the device.
    [[nodiscard]] std::optional<features::SmokePlan> plan_smoke(const frame::FramePlan& plan,
                                                                const features::StyleTables& tables,
                                                                const RenderSettings& settings);
    /// Returns the earlier time at which the scene must also be known, for motion, flowing ink or exposure.
    /// Returns none if the picture needs no earlier time.
    [[nodiscard]] std::optional<double> moment_before(const RenderSettings& settings,
                                                      const features::StyleTables& style) const;
    [[nodiscard]] std::optional<frame::MotionBlurPlan>
    plan_motion_blur(const Camera& camera, const frame::PagePlan& page_plan, float line_half_px,
                     const features::StyleTables& style, const RenderSettings& settings);
    /// Poses the scene on the device at another time, so that the next update_pose() keeps that pose as the
    /// previous one.
    void pose_before(const ScenePose& scene_pose);
    /// Returns the motion between the cameras of two moments. Call this function after the scene has been
    /// posed at the time of the picture.
    [[nodiscard]] features::MotionPlan motion_between(const Camera& before, const Camera& now,
                                                      const RenderSettings& settings) const;
    [[nodiscard]] features::MotionPlan plan_motion(const Camera& camera, const RenderSettings& settings);
    [[nodiscard]] features::LocalMapScene local_map_scene(const frame::PagePlan& page_plan,
                                                          const Camera& camera,
                                                          const features::StyleTables& tables) const;
    /// Uploads the data that the lighting shaders read.
    void upload_lighting(const frame::FramePlan& plan, const light::Lighting& lighting,
                         const features::StyleTables& tables);
    /// Uploads the data of lighting and lines that depend on the size of a pixel.
    void upload_pixel_sizes(const frame::FramePlan& plan, const features::StyleTables& tables);
    void ensure_variants(const frame::FramePlan& plan);
    /// Creates the texture atlases over all surfaces that the style requires.
    void ensure_surface_maps(const frame::FramePlan& plan);
    /// Prepares everything that the first sample of a picture needs. Throws Error as Renderer::render() does.
    [[nodiscard]] frame::FramePlan prepare(const Camera& camera, const features::StyleTables& tables,
                                           const RenderSettings& settings);
    /// Draws one frame into the page, and fills the other outputs of the job.
    void draw_frame(const Camera& camera, const features::StyleTables& style, const frame::FramePlan& plan,
                    const FrameJob& job);
    /// Returns whether a picture is drawn in tiles: because the settings ask for it, or because it is too
    /// large for the device.
    [[nodiscard]] bool is_tiled(const RenderSettings& settings) const;
    /// Draws the picture of draw_picture() tile by tile, and passes the tiles to the sink.
    void draw_tiles(const Camera& camera, const Style& style, const RenderSettings& settings,
                    const BandSink& sink);
    /// Simulates the flowing ink on the whole page in one pass. Returns the ink's plan for a page that is
    /// then drawn in tiles.
    [[nodiscard]] features::InkPlan let_ink_flow(const Camera& camera, const features::StyleTables& tables,
                                                 const RenderSettings& settings);
    /// Computes the data that tiles share: the lines of each sample, and the brightness of the page.
    [[nodiscard]] std::vector<contour::LinkedLines>
    survey_page(const Camera& camera, const features::StyleTables& style, const frame::FramePlan& plan,
                const features::Survey& survey, uint32_t samples);
    /// Draws all samples of a picture. The returned image is empty if a `target` is given. Calls
    /// `after_sample` after each sample.
    [[nodiscard]] Image draw_picture(const Camera& camera, const Style& style, const RenderSettings& settings,
                                     frame::LinearPage* linear = nullptr,
                                     const std::function<void()>& after_sample = {},
                                     const VulkanPicture* target = nullptr);

    RendererOptions options;
    gpu::Device device;
    gpu::Executor executor;
    std::unique_ptr<gpu::CompileAhead> ahead; ///< passes that are being compiled; null after the first frame
    RasterPath raster_path;                   ///< raster path that was chosen when the device was opened
    std::optional<RasterPath> page_path;      ///< raster path of the last page
    std::optional<frame::LoadedScene> loaded;
    uint32_t known_layout = 0; ///< LoadedScene::layout_number at the last call of note_layout()
    PosedScene posed_scene;
    bool force_repose = false;         ///< the scene is posed again even if no node moved
    bool is_of_film = false;           ///< the last frame was part of a film
    features::StyleTables drawn_style; ///< result of tables_of(), kept here so that its memory is reused
    frame::Features features;
    frame::FrameBuffers buffers;
    Motion motion;
    frame::PlanLists plan_lists; ///< lists of the last picture's plan, whose memory is reused
    std::vector<wash::WashVariant> wash_variants; ///< memory that the next frame reuses
    gpu::Graph declared;                          ///< memory of the frame graph that the next frame reuses
    gpu::Graph drawn; ///< graph of the last frame, for inspection; its resources may no longer exist
    std::vector<std::string> notes;
    bool has_told_of_pipelines = false; ///< the notes have said why the cache of pipelines was ignored
};

/// The camera of the whole page. Inside the paper's margin this camera shows the view of `camera`. Throws
/// Error for an invalid camera.
[[nodiscard]] Camera page_camera(const Camera& camera, const paper::PaperStyle& style,
                                 const RenderSettings& settings);

} // namespace estampe
