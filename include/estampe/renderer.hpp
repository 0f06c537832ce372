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
#include <estampe/surface_buffers.hpp>
#include <estampe/vector_drawing.hpp>
#include <estampe/work_limits.hpp>

namespace estampe {

/// How triangles are rasterised. Both paths find the same visible triangle in 99.99 % of the pixels.
enum class RasterPath : uint8_t {
    automatic, ///< Selects the faster path: by a measurement on a GPU; always the same path on a CPU
    hardware,  ///< Triangles are rasterised by the device's own rasteriser
    compute,   ///< Triangles are rasterised by compute shaders with 64-bit atomics
};

/// The name of a raster path: "auto", "hardware" or "compute".
[[nodiscard]] const char* name_of(RasterPath path);

/// A Vulkan device of this machine.
struct DeviceInfo {
    uint32_t index = 0; ///< Number of the device for the option `--device`
    std::string name;   ///< Name of the device, such as "NVIDIA H200" or "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver; ///< Driver name and version
    bool software = false;      ///< The device is software that runs on the CPU
    bool compute_raster = true; ///< The device supports RasterPath::compute
    bool usable = true;
    std::string why_not; ///< Reason why the device is not usable; empty if it is usable
};

/// The Vulkan devices of this machine, in the loader's order. Empty if no Vulkan driver is installed.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

/// Options of the constructor of Renderer.
struct RendererOptions {
    /// Device to draw on: "auto" (a GPU if there is one, else the CPU), "cpu", or an index from
    /// list_devices().
    std::string device = "auto";
    RasterPath raster = RasterPath::automatic;
    /// Enables the Khronos validation layer with synchronization validation. The layer must be installed.
    bool validation = false;
    /// Receives each validation message, from any thread. Without this function, messages go to stderr.
    std::function<void(const std::string&)> on_validation_message;
};

/// Relation of a frame to the previous frame of the same renderer.
enum class Continuity : uint8_t {
    still,  ///< A single picture, which has no relation to a previous frame
    starts, ///< The first frame of a film
    /// The next frame of a film: lines continue from the previous frame, which must have the same page size,
    /// and do not jump in width or shape.
    follows
};

/// A camera and a time of the scene's animation.
struct Moment {
    Camera camera;
    double time_s = 0.0;
};

/// Settings of one picture, apart from camera and style.
struct RenderSettings {
    uint32_t width = 1280;
    uint32_t height = 720;
    uint32_t samples = 1; ///< Number of drawings with sub-pixel jitter that are averaged to one picture
    double time_s = 0.0;  ///< Time of the scene's animation that the picture shows
    Index animation = 0;
    Continuity continuity = Continuity::still;
    /// Camera and time at one end of the exposure interval for motion blur. The middle of the interval is
    /// `time_s`. Empty: the interval begins half of the style's exposure time before `time_s`, with the same
    /// camera.
    std::optional<Moment> exposure_end;
    /// If set, Renderer::motion() reports the motion from this moment to the picture.
    std::optional<Moment> motion_since;
    /// Longest side of a tile in pixels, if the page is drawn in overlapping tiles. 0: the page is drawn
    /// without tiles if the device allows it, otherwise in tiles of an automatic size. Only used by render()
    /// and render_bands().
    uint32_t tile_px = 0;
    bool measure_solvers = false; ///< Measures the pressure solvers of fluids for Renderer::solver_reports()
    /// Measures the GPU time of each pass; see Renderer::timings(). Passes that usually overlap then run one
    /// after another, so the frame takes about a tenth longer. Measuring does not change the picture.
    bool time_passes = false;
    /// Limits the memory and the time of drawing this picture. The limit on time applies between the passes
    /// of samples, tiles and simulation steps, so a picture can take one such step longer.
    WorkLimits limits = {};
};

/// Current brightness of one light of the scene.
struct LightBrightness {
    Index light = no_index;
    float intensity = 1.0F; ///< Brightness of the light, in the units of Light::intensity
};

/// Placement of a node in its parent's space.
struct NodePlace {
    Index node = no_index;
    Transform transform;
};

/// Receiver of a picture that is delivered in bands.
struct BandSink {
    /// Called with consecutive bands of pixel rows from top to bottom; each band is as wide as the picture.
    std::function<void(const Image& rows)> take;
    /// Called with the share of the picture's work that is done, 0 to 1; may be empty.
    std::function<void(double share)> progress = {};
};

/// Whether a vector drawing contains the lines that surfaces hide.
enum class HiddenLines : uint8_t { left_out, kept };

/// Name and GPU time of one pass of the last frame.
struct PassTiming {
    std::string name;
    double gpu_ms = 0.0; ///< GPU time of the pass; only measured if RenderSettings::time_passes is set
};

/// Statistics of the pressure solver of one fluid, over the time steps computed for one picture.
struct SolverReport {
    std::string fluid; ///< Name of the fluid: "smoke", "smoke 2" and so on, or "ink"
    /// Method of the fluid's pressure solver: "spectral", "multigrid", "jacobi" or "mass".
    std::string solver;
    uint32_t steps = 0;
    /// Divergence of the fluid's velocity after the last projection, relative to the divergence before that
    /// projection; a ratio of root mean squares. The solver "mass" has no projection, so its ratio is near 1.
    double divergence_left = 0.0;
    double gpu_ms = 0.0; ///< GPU time of the pressure projections of all time steps
};

struct VulkanHost;    // A Vulkan device of the host application; declared in estampe/vulkan.hpp
struct VulkanPicture; // An image of the host application; declared in estampe/vulkan.hpp

/// Draws scenes. A renderer owns a Vulkan device, or uses a device of the host application. It is not
/// thread-safe, but several renderers may exist side by side.
class Renderer {
public:
    /// Opens a device. Throws Error if no usable device matches, with a list of the devices and what each
    /// lacks, or if the device does not support the requested raster path.
    explicit Renderer(const RendererOptions& options = {});

    /// Draws on a device of the host application. Only `raster` of `options` is used; the host enables
    /// validation itself. If the device is not usable, throws an Error that says what the device lacks.
    explicit Renderer(const VulkanHost& host, const RendererOptions& options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// The device that this renderer draws on.
    [[nodiscard]] const DeviceInfo& device() const;

    /// Returns the raster path of the last picture, or before the first picture the path that the renderer
    /// intends to use. The result is never RasterPath::automatic.
    [[nodiscard]] RasterPath raster_path() const;

    /// Uploads `scene`, which replaces the previous scene. A `lightmap` adds its light to static objects.
    /// Throws Error with the first of the faults() of a scene that a program made wrongly, and keeps the
    /// previous scene. Throws Error if the scene exceeds the device's memory or limits, or if the lightmap
    /// belongs to another scene, and keeps no scene.
    void set_scene(const Scene& scene, const Lightmap* lightmap = nullptr);

    /// Replaces the terrain of the scene, including its graph, masks, mesh and colour; the rest of the scene
    /// stays. If `at_once` is true, the next pictures evaluate the terrain's height graph with an interpreter
    /// until its own shader is compiled in the background. Otherwise the next picture waits for the
    /// compilation. Throws Error if the scene has no terrain or the new one does not fit the device; the old
    /// terrain then stays. Cost: an upload of the terrain's textures. If the new terrain has another
    /// TerrainMesh, the triangles of the whole scene are rebuilt.
    void set_terrain(const Terrain& terrain, bool at_once = false);

    /// Presses footprints and drag marks into the terrain at the time of the next picture. Footprints and
    /// drag marks change the tone of the ground within a square in front of the camera. The wind fills the
    /// marks over time; see TerrainTrails. Stamps that are not finite or longer than 100 m are ignored. The
    /// last 4,096 stamps are kept; going back in time deletes them. Throws Error if the scene has no terrain.
    /// Cost: one workgroup per stamp on the device.
    void press(std::span<const TrailStamp> stamps);

    /// Sets the brightness of lights, from the next picture on. The style's settings for a light take
    /// precedence. Throws Error if there is no scene, a light does not exist, or a brightness is not valid.
    /// Cost: linear in lights; shadows are not drawn again.
    void set_brightness(std::span<const LightBrightness> lights);

    /// Places nodes, together with their descendants and the meshes that they skin. A node has its new place
    /// from `time_s` on. Between the time of the node's previous place() and `time_s` its place is
    /// interpolated. Placement overrides animation, and deletes placements of later times. The placements of
    /// the last 12 seconds are kept, for motion blur, flowing ink and trails of particles. Throws Error if
    /// there is no scene, a node does not exist, or a place is not finite. Cost: linear in nodes. The first
    /// placement of nodes that no animation moves rearranges the scene's buffers, at a fraction of the cost
    /// of set_scene().
    void place(std::span<const NodePlace> places, double time_s);

    /// Returns whether the shader of a terrain that was set with `at_once` is still being compiled. The first
    /// picture after the compilation uses the compiled shader.
    [[nodiscard]] bool is_terrain_compiling() const;

    /// Draws the scene. The picture is opaque, or has straight alpha if the style sets `paper.transparent`.
    /// If other programs composite the transparent picture onto the style's paper colour, in sRGB-encoded
    /// values, the result equals the opaque picture to within 1/255.
    ///
    /// Identical scenes, cameras, styles and settings give identical bytes on one device and raster path. A
    /// film gives the same bytes if its frames are drawn in order from the first. Pages that are too large
    /// for the device are drawn in tiles without seams: on pages of up to 16.7 megapixels, lines are linked
    /// across tiles. Each side may have up to 65535 pixels.
    ///
    /// Throws Error if the size is zero or too large, if no scene was set, if memory runs out, and if the
    /// page would need tiles but is part of a film or has `motion_since`.
    [[nodiscard]] Image render(const Camera& camera, const Style& style, const RenderSettings& settings);

    /// Draws the picture of render() in bands of rows, for pages larger than memory. Throws Error as render()
    /// does; passes on exceptions of the sink. Memory: one band of `tile_px` rows, and the device memory of
    /// one tile.
    void render_bands(const Camera& camera, const Style& style, const RenderSettings& settings,
                      const BandSink& sink);

    /// Draws the picture of render(), with its straight alpha, directly into an image of the borrowed
    /// device. Returns when the device has finished. Throws Error as render() does, and if the renderer owns
    /// its device. Cost: as render(), without the copy of the picture to the host.
    void render_to(const VulkanPicture& picture, const Camera& camera, const Style& style,
                   const RenderSettings& settings);

    /// Draws the picture of render() in linear light, without rounding the colours to bytes. Where ink is
    /// thin, the colours are precise to about 11 bits. If the style's paper is transparent, colours are
    /// premultiplied by alpha and LinearImage::paper is set. Throws Error as render() does, and if the device
    /// cannot store so many floats. Cost: as render(), and one more pass over the page.
    [[nodiscard]] LinearImage render_linear(const Camera& camera, const Style& style,
                                            const RenderSettings& settings);

    /// Draws the picture of render() with its layers and masks. The layers are paper, wash (multiplied),
    /// flowing ink if the style has any, hatch and lines; together they give the picture. In a transparent
    /// picture the paper layer is hidden, and the wash layer has alpha instead of being multiplied. The masks
    /// are "shadow", where an object blocks the sun, "clouds", where clouds cover the sky, and one mask per
    /// visible node, named after it. Several samples are averaged. Throws Error as render_linear() does.
    /// Cost: as render(), and four more passes over the page; 86 bytes per pixel are read back.
    [[nodiscard]] LayeredImage render_layers(const Camera& camera, const Style& style,
                                             const RenderSettings& settings);

    /// Returns what each pixel of render() shows of the scene: distance, normal, object, material, and the
    /// motion if `motion_since` is set. Pixels in the margin of the style's paper are blank. No picture is
    /// drawn; `samples` and `tile_px` are ignored. Otherwise the call counts as a picture: `continuity` says
    /// whether it is part of a film, and motion() is replaced. Throws Error as render() does, and if the page
    /// is too large to be drawn without tiles. Cost: rasterisation and one more pass over the page; 16 bytes
    /// per pixel are read back.
    [[nodiscard]] SurfaceBuffers render_buffers(const Camera& camera, const Style& style,
                                                const RenderSettings& settings);

    /// Returns the strokes of render() as paths: lines, and hatching that consists of lines. Paths deviate
    /// from the lines of a picture of the given size by about a third of a pixel, so a larger size gives
    /// finer paths. `samples` is ignored. No picture is drawn. Throws Error as render() does, and if the
    /// style draws strokes without paths: strokes of a tonal art map, or lines that are detected in the
    /// image.
    [[nodiscard]] VectorDrawing draw_strokes(const Camera& camera, const Style& style,
                                             const RenderSettings& settings,
                                             HiddenLines hidden = HiddenLines::left_out);

    /// Returns the state that the next frame of a film takes from earlier frames: lines, exposure, flowing
    /// ink, smoke and cloth. With this state and recall_film(), another process can continue the film, and
    /// draws the same bytes. Empty if the last frame was not part of a film; see RenderSettings::continuity.
    /// Cost: a copy from the device of 5 bytes per pixel if lines are contour chains (linked edges of the
    /// mesh), and 20 to 32 bytes per cell of smoke.
    [[nodiscard]] std::vector<std::byte> film_memory() const;

    /// Restores the state that film_memory() returned, so that the next frame can continue the film
    /// (Continuity::follows). The bytes must come from a renderer with the same scene on the same device.
    /// Throws Error if there is no scene, or if the bytes come from a renderer with another scene or on
    /// another device.
    void recall_film(std::span<const std::byte> memory);

    /// Returns the motion vectors of the last picture, measured from the moment in
    /// RenderSettings::motion_since. Empty after draw_strokes(), or if `motion_since` was not set. Computing
    /// the motion does not change the picture.
    [[nodiscard]] const Motion& motion() const;

    /// Automatic decisions of the renderer for the last frame, one line of text each, such as the addition of
    /// a lamp that the scene does not contain. Empty for most scenes.
    [[nodiscard]] const std::vector<std::string>& notes() const;

    /// GPU time of the last frame in milliseconds: all of its passes, without waits for the host. With
    /// several samples, only the GPU time of the last sample.
    [[nodiscard]] double gpu_ms() const;

    /// The passes of the last frame in order of execution, with the GPU time of each if
    /// RenderSettings::time_passes or RenderSettings::measure_solvers was set.
    [[nodiscard]] const std::vector<PassTiming>& timings() const;

    /// Statistics of the pressure solvers of smoke and flowing ink for the last picture, if its
    /// RenderSettings::measure_solvers was set. Empty if no fluid was simulated. Measuring does not change
    /// the picture.
    [[nodiscard]] std::vector<SolverReport> solver_reports() const;

    /// Returns the device memory in bytes that this renderer uses, including data that is kept for the next
    /// frame.
    [[nodiscard]] uint64_t device_memory_bytes() const;

    /// Returns the frame graph of the last frame (its passes and their resources) as Graphviz text.
    [[nodiscard]] std::string graph_dot() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe
