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

    /// What the style says, with its section [drawing] carried out; valid until the next call.
    [[nodiscard]] const features::StyleTables& tables_of(const Style& style)
    {
        return features::with_drawing(style.tables(), drawn_style);
    }

    void update_pose(const ScenePose& scene_pose);

    /// Poses what does not stand as it does now; pose::keep_posed() is to be called when the graph has run.
    [[nodiscard]] gpu::BufferId add_moved(gpu::Graph& graph);
    /// The device has posed the vertices.
    void posed();
    /// Poses the scene, unless that is how it stands; valid until another moment is asked for.
    const ScenePose& pose_at(const RenderSettings& settings);
    /// Takes the anchor along with an eye that has gone far over the ground, so that floats stay fine there.
    void follow_eye(const Camera& camera);
    [[nodiscard]] light::Lighting gather_lights(const Camera& camera, const ScenePose& scene_pose,
                                                const features::StyleTables& tables);
    /// Brings the ground to where the eye is.
    void update_terrain(const Camera& camera, const RenderSettings& settings,
                        const features::StyleTables& style);
    /// To be called when the scene may have been laid out afresh: tells the features, and cuts its cloth.
    void note_layout();
    /// Passes the velocity of smoke to cloth as wind, if the style asks for it: simulates that smoke first,
    /// and returns its boxes.
    [[nodiscard]] std::optional<std::vector<smoke::Box>>
    blow_cloth(const ScenePose& pose, const features::StyleTables& style, const RenderSettings& settings);
    [[nodiscard]] features::ClothInputs cloth_inputs(const RenderSettings& settings,
                                                     const features::StyleTables& style);
    /// What the ink of a picture that has been prepared is planned from.
    [[nodiscard]] features::FlowingInkInputs
    ink_inputs(const Camera& camera, const features::StyleTables& tables, const RenderSettings& settings);
    /// The smoke of a picture that has been prepared; risen and lit on the device.
    [[nodiscard]] std::optional<features::SmokePlan> plan_smoke(const frame::FramePlan& plan,
                                                                const features::StyleTables& tables,
                                                                const RenderSettings& settings);
    /// The moment before that a picture looks back to, where it does: of its motion, of the ink that flows,
    /// of its exposure.
    [[nodiscard]] std::optional<double> moment_before(const RenderSettings& settings,
                                                      const features::StyleTables& style) const;
    [[nodiscard]] std::optional<frame::MotionBlurPlan>
    plan_motion_blur(const Camera& camera, const frame::PagePlan& page_plan, float line_half_px,
                     const features::StyleTables& style, const RenderSettings& settings);
    /// Poses the scene on the device as it was at another moment, so that the next update_pose() keeps that
    /// beside it.
    void pose_before(const ScenePose& scene_pose);
    /// To be called when the scene has been posed as it is now.
    [[nodiscard]] features::MotionPlan motion_between(const Camera& before, const Camera& now,
                                                      const RenderSettings& settings) const;
    [[nodiscard]] features::MotionPlan plan_motion(const Camera& camera, const RenderSettings& settings);
    [[nodiscard]] features::LocalMapScene local_map_scene(const frame::PagePlan& page_plan,
                                                          const Camera& camera,
                                                          const features::StyleTables& tables) const;
    /// Hands the device what the light's shaders read.
    void upload_lighting(const frame::FramePlan& plan, const light::Lighting& lighting,
                         const features::StyleTables& tables);
    /// What of that, and of lines, hangs on how large a pixel is.
    void upload_pixel_sizes(const frame::FramePlan& plan, const features::StyleTables& tables);
    void ensure_looks(const frame::FramePlan& plan);
    /// Maps that lie on all surfaces, where the style wants any.
    void ensure_surface_maps(const frame::FramePlan& plan);
    /// All that comes before the first sample. Throws Error as Renderer::render() does.
    [[nodiscard]] frame::FramePlan prepare(const Camera& camera, const features::StyleTables& tables,
                                           const RenderSettings& settings);
    /// Draws into the page, and what else the job asks for.
    void draw_frame(const Camera& camera, const features::StyleTables& style, const frame::FramePlan& plan,
                    const FrameJob& job);
    /// Whether a picture is to be drawn in tiles: it is wanted so, or too large for the device.
    [[nodiscard]] bool is_tiled(const RenderSettings& settings) const;
    /// The same picture as draw_picture() makes, tile by tile.
    void draw_tiles(const Camera& camera, const Style& style, const RenderSettings& settings,
                    const BandSink& sink);
    /// Has ink flow over a page that is drawn in one go, for one in tiles.
    [[nodiscard]] features::InkPlan let_ink_flow(const Camera& camera, const features::StyleTables& tables,
                                                 const RenderSettings& settings);
    /// What tiles share: the lines of each sample, and how bright the page is.
    [[nodiscard]] std::vector<contour::LinkedLines>
    survey_page(const Camera& camera, const features::StyleTables& style, const frame::FramePlan& plan,
                const features::Survey& survey, uint32_t samples);
    /// All samples of a picture, which is empty where it goes into a `target`. `after_sample` is called after
    /// each.
    [[nodiscard]] Image draw_picture(const Camera& camera, const Style& style, const RenderSettings& settings,
                                     frame::LinearPage* linear = nullptr,
                                     const std::function<void()>& after_sample = {},
                                     const VulkanPicture* target = nullptr);

    RendererOptions options;
    gpu::Device device;
    gpu::Executor executor;
    std::unique_ptr<gpu::CompileAhead> ahead; ///< until the first frame is drawn
    RasterPath raster_path;                   ///< chosen as the device was opened
    std::optional<RasterPath> page_path;      ///< of the last page
    std::optional<frame::LoadedScene> loaded;
    uint32_t known_layout = 0; ///< LoadedScene::layout_number that note_layout() has told of
    PosedScene posed_scene;
    bool force_repose = false; ///< the scene is posed again even if no node moved
    bool is_of_film = false;   ///< the last frame
    features::StyleTables drawn_style; ///< room for tables_of()
    frame::Features features;
    frame::FrameBuffers buffers;
    Motion motion;
    frame::PlanLists plan_lists;            ///< of the picture before
    std::vector<wash::LookWash> wash_looks; ///< room for the next frame's
    gpu::Graph declared;                    ///< room for the next frame's
    gpu::Graph drawn;                       ///< the last frame, to look at; its resources may be gone
    std::vector<std::string> notes;
};

/// The camera of the whole page, whose window shows what `camera` does. Throws Error for one that nothing can
/// be seen by.
[[nodiscard]] Camera page_camera(const Camera& camera, const paper::PaperStyle& style,
                                 const RenderSettings& settings);

} // namespace estampe
