// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <estampe/image.hpp>
#include <estampe/layers.hpp>
#include <estampe/lightmap.hpp>
#include <estampe/linear_image.hpp>
#include <estampe/motion.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>
#include <estampe/vector_drawing.hpp>

namespace estampe {

/// How triangles become pixels. Both ways give the same identities in 99.99 % of pixels.
enum class RasterPath : uint8_t {
    automatic, ///< the quicker: measured when a GPU is opened, fixed on a processor
    hardware,  ///< the device's own rasteriser
    compute,   ///< compute shaders with 64-bit atomics
};

/// "auto", "hardware" or "compute".
[[nodiscard]] const char* name_of(RasterPath path);

/// A Vulkan device of this machine.
struct DeviceInfo {
    uint32_t index = 0;         ///< what `--device N` takes
    std::string name;           ///< "NVIDIA H200", "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;         ///< driver name and version
    bool software = false;      ///< runs on the processor
    bool compute_raster = true; ///< can draw by RasterPath::compute
    bool usable = true;
    std::string why_not; ///< what it lacks, when it is not usable
};

/// The Vulkan devices of this machine, in the loader's order. Empty when there is no driver at all.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

/// How a renderer is opened.
struct RendererOptions {
    /// Which device draws: "auto" (a GPU if there is one, else the processor), "cpu", or an index of
    /// list_devices().
    std::string device = "auto";
    RasterPath raster = RasterPath::automatic;
    bool validation =
        false; ///< Khronos validation with synchronization validation; needs the layer installed
    /// Receives each validation message, from any thread; without it they go to stderr.
    std::function<void(const std::string&)> on_validation_message;
};

/// What a frame has to do with the one drawn before it by the same renderer.
enum class Continuity : uint8_t {
    still,  ///< nothing: the picture stands for itself
    starts, ///< it is the first of a film
    follows ///< it comes right after it in a film: lines go on from those drawn there, of the same size of
            ///< page, and do not jump in width or shape
};

/// A moment of the scene's animation, and where it is seen from.
struct Moment {
    Camera camera;
    double time_s = 0.0;
};

/// What is wanted of one picture, besides where from and in which style.
struct RenderSettings {
    uint32_t width = 1280;
    uint32_t height = 720;
    uint32_t samples = 1; ///< sub-pixel jittered frames to accumulate
    double time_s = 0.0;  ///< moment of the scene's animation
    Index animation = 0;
    Continuity continuity = Continuity::still;
    /// One end of the exposure of a style with motion blur, whose middle is `time_s`. Not given: half of what
    /// the style says before that, seen by the same camera.
    std::optional<Moment> exposure_end;
    std::optional<Moment> motion_since; ///< also work out Renderer::motion(), from there to this picture
    /// Longest side of the parts that a page is drawn in, which overlap; 0: in one go where the device can,
    /// or else in parts of its choosing. Of render() and render_bands() alone.
    uint32_t tile_px = 0;
    bool measure_solvers = false; ///< also work out Renderer::solver_reports()
    /// Also time each pass, see Renderer::timings(). A GPU then runs one after another what it would run side
    /// by side, which takes a tenth longer or so. The picture is the same.
    bool time_passes = false;
};

/// How bright one of the scene's lights is now.
struct LightBrightness {
    Index light = no_index;
    float intensity = 1.0F; ///< as Light::intensity is
};

/// Where a node stands in its parent's space.
struct NodePlace {
    Index node = no_index;
    Transform transform;
};

/// Who takes a picture that is handed over in parts.
struct BandSink {
    /// Is given all rows from the top down, some at a time, as wide as the picture.
    std::function<void(const Image& rows)> take;
    /// Is told how much has been drawn, 0 to 1; may be empty.
    std::function<void(double share)> progress = {};
};

/// Whether lines behind something come along.
enum class HiddenLines : uint8_t { left_out, kept };

/// One pass of the last frame.
struct PassTiming {
    std::string name;
    double gpu_ms = 0.0; ///< GPU time, if RenderSettings::time_passes asked for it
};

/// What a pressure solver did in the steps that a fluid took for a picture.
struct SolverReport {
    std::string fluid;  ///< "smoke", "smoke 2" and so on, "ink"
    std::string solver; ///< "spectral", "multigrid" or "jacobi"
    uint32_t steps = 0;
    double divergence_left = 0.0; ///< by the last projection, beside what that was given: root mean squares
    double gpu_ms = 0.0;          ///< of the projections of all steps
};

struct VulkanHost;    // see estampe/vulkan.hpp
struct VulkanPicture; // see estampe/vulkan.hpp

/// Draws scenes. One renderer owns one device, or borrows one; it is not thread-safe, but several may live
/// side by side.
class Renderer {
public:
    /// Throws Error when no usable device matches, naming what there is and what it lacks, and when the
    /// device cannot draw by the raster path asked for.
    explicit Renderer(const RendererOptions& options = {});

    /// Draws on a device of the host application's. Of `options` the raster path counts; validation is the
    /// host's affair. Throws Error when the device cannot be drawn on, saying what it lacks.
    explicit Renderer(const VulkanHost& host, const RendererOptions& options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    [[nodiscard]] const DeviceInfo& device() const;

    /// How triangles of the last picture were drawn, and before there is one, how they are meant to be; never
    /// RasterPath::automatic.
    [[nodiscard]] RasterPath raster_path() const;

    /// Uploads `scene`; it replaces the one before. With a `lightmap`, what stands still is lit by that too.
    /// Throws Error when it does not fit the device's memory or limits, or when the lightmap is another
    /// scene's.
    void set_scene(const Scene& scene, const Lightmap* lightmap = nullptr);

    /// Gives the scene another terrain while it is drawn: its graph, numbers, painted masks, mesh, colour and
    /// the rest; what else the scene has stays. With `at_once` the next pictures are drawn by a graph that is
    /// interpreted, until its own shader has been compiled beside them; without, the next picture waits for
    /// that. Throws Error when the scene has no terrain, or the new one does not fit the device, and the one
    /// before stays. Cost: an upload of its textures; with another way of cutting it into triangles those of
    /// the whole scene are made anew.
    void set_terrain(const Terrain& terrain, bool at_once = false);

    /// Presses things into the scene's terrain, at the next picture's moment: footprints, and what is
    /// dragged. They are seen as tone in a square before the eye, and the wind fills them, as TerrainTrails
    /// says. Those that are not finite or longer than 100 m are left out; the last 4,096 are remembered;
    /// going back in time forgets them. Throws Error when the scene has no terrain. Cost: a workgroup each on
    /// the device.
    void press(std::span<const TrailStamp> stamps);

    /// Lets lights of the scene burn brighter or lower from the next picture on; what the style says of them
    /// goes over it. Throws Error when there is no scene or no such light, and for what is no brightness.
    /// Cost: linear in lights; no shadow is drawn anew.
    void set_brightness(std::span<const LightBrightness> lights);

    /// Moves nodes of the scene, and what hangs on them or is bent by them, while it is drawn: they stand so
    /// at that moment of the pictures and after it, and in between on the way from where they were put
    /// before. It takes the place of what an animation says of them. What was said of a later moment is
    /// forgotten; 12 seconds are remembered, by which motion is blurred, ink is carried along and plumes of
    /// particles stay behind. Throws Error when there is no scene or no such node, and for a place that is
    /// not finite. Cost: linear in the nodes; the first time for nodes that no animation moves, those of a
    /// call are laid out anew, at the cost of a fraction of set_scene().
    void place(std::span<const NodePlace> places, double time_s);

    /// Whether a terrain that was set `at_once` is still interpreted because its shader is being compiled.
    /// When it is not any more, the next picture is drawn by that.
    [[nodiscard]] bool is_terrain_compiling() const;

    /// Draws the scene: opaque, or with straight alpha where the style's `paper.transparent` says so, such
    /// that on paper of the style's colour it is the opaque picture to 1/255 when it is laid there in
    /// sRGB-encoded values, as programs do. The same scene, camera, style and settings give the same bytes on
    /// the same device by the same raster path. A film gives the same bytes when its frames are drawn in the
    /// same order from its first frame on. Pages that are too large for the device are drawn in tiles, which
    /// leave no seams: lines are linked for the whole page, in up to 16.7 megapixels. Each side may have
    /// 65535 pixels. Throws Error when the size is zero or too large, or larger than the device's limits
    /// where tiles will not do: with motion_since, and in films; when no scene was set, and when memory runs
    /// out.
    [[nodiscard]] Image render(const Camera& camera, const Style& style, const RenderSettings& settings);

    /// The picture of render() in bands of rows, for pages that memory does not hold. Throws Error as
    /// render() does, and what the sink throws. Memory: one band of `tile_px`, and what the device takes for
    /// a tile.
    void render_bands(const Camera& camera, const Style& style, const RenderSettings& settings,
                      const BandSink& sink);

    /// The picture of render(), its straight alpha included, in an image of the device that this renderer
    /// borrows, without a way over the host's memory. Returns when the device is done. Throws Error as
    /// render() does, and when the device is the renderer's own. Cost: as render(), less one copy of the
    /// picture to the host and one there.
    void render_to(const VulkanPicture& picture, const Camera& camera, const Style& style,
                   const RenderSettings& settings);

    /// The picture of render() before it is rounded to bytes, as fine as it was composed, some 11 bits where
    /// ink is thin: opaque, or where the style's paper is transparent with colours multiplied by alpha, and
    /// LinearImage::paper set.
    /// Throws Error as render() does, and when the device cannot hold so many floats. Cost: as render(), and
    /// one more pass over the page.
    [[nodiscard]] LinearImage render_linear(const Camera& camera, const Style& style,
                                            const RenderSettings& settings);

    /// The picture of render(), and what it is made of: the layers paper, wash (multiplied), ink
    /// that flows where the style has any, hatch and lines,
    /// which laid on each other are the picture again (of a transparent picture the paper is hidden, and the
    /// wash has alpha in place of multiplying); and masks: "shadow", where the sun's light is kept off
    /// by something, where there is such a shadow, "clouds", where they cover the sky, and one for each node
    /// of the scene that is seen, named after it. With several samples all are means of theirs. Throws Error
    /// as render_linear() does. Cost: as render(), and four more passes over the page; 86 bytes a pixel are
    /// read back.
    [[nodiscard]] LayeredImage render_layers(const Camera& camera, const Style& style,
                                             const RenderSettings& settings);

    /// The strokes that render() would draw, as paths: lines, and hatching where it is of lines. Paths follow
    /// what the picture of that size shows, to about a third of a pixel; a larger one gives finer paths.
    /// Samples do not matter. No picture is drawn.
    /// Throws Error as render() does, and when the style draws strokes that have no paths: those of a tonal
    /// art map, and lines that are found between pixels.
    [[nodiscard]] VectorDrawing draw_strokes(const Camera& camera, const Style& style,
                                             const RenderSettings& settings,
                                             HiddenLines hidden = HiddenLines::left_out);

    /// What the next frame of a film takes from those before it: where lines were, how bright it was, ink
    /// that flows, smoke and cloth. With it another run draws on as this one would, to the byte. Empty when
    /// the last frame was of no film, see RenderSettings::continuity. Cost: a copy from the device: 5 bytes a
    /// pixel where lines are chains, 20 to 32 a cell of smoke.
    [[nodiscard]] std::vector<std::byte> film_memory() const;

    /// Makes the next frame, if it Continuity::follows, follow on those of the film_memory() of a renderer on
    /// the same device with the same scene. Throws Error when there is no scene, and for bytes of another
    /// origin.
    void recall_film(std::span<const std::byte> memory);

    /// How far what the last picture shows had moved since its RenderSettings::motion_since; empty where that
    /// named no moment, and after draw_strokes(). The picture is the same with it and without.
    [[nodiscard]] const Motion& motion() const;

    /// What was decided for the last frame that is not plain to see, one line each: a lamp that the scene
    /// does not have. Empty for most scenes.
    [[nodiscard]] const std::vector<std::string>& notes() const;

    /// GPU time of the last frame drawn: of all that was run for it, without its waiting for the host; of a
    /// picture with several samples that of the last.
    [[nodiscard]] double gpu_ms() const;

    /// The passes of the last frame drawn in the order of execution, and what each took if
    /// RenderSettings::time_passes asked for that, or RenderSettings::measure_solvers.
    [[nodiscard]] const std::vector<PassTiming>& timings() const;

    /// What the pressure solvers of smoke and of ink's water did for the last picture, where its
    /// RenderSettings::measure_solvers asks for that; empty where no fluid took a step. The picture is the
    /// same with it and without.
    [[nodiscard]] std::vector<SolverReport> solver_reports() const;

    /// What this renderer has in use of its device's memory, and keeps for the next frame.
    [[nodiscard]] uint64_t device_memory_bytes() const;

    /// The frame graph of the last frame drawn, as Graphviz text, which is made when it is asked for.
    [[nodiscard]] std::string graph_dot() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe
