// SPDX-License-Identifier: MIT
#pragma once

// A scene on the shared device, for tests of the data that one technique passes to the next. The scene is
// drawn by the steps of a frame. Each function declares only the steps that it needs.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "frame/steps.hpp"
#include "gpu/graph/graph.hpp"
#include "shaders/frame.glsl.h"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/raster/views/views.hpp"
#include "techniques/shadow/sun/sun_map.hpp"

namespace estampe::test {

/// The output of the surface pass, row by row. In background pixels only draw and depth have a meaning.
struct SurfacePixels {
    std::vector<uint32_t> draw; ///< as described in shaders/surface_images.glsl
    std::vector<float> depth;
    std::vector<glm::vec3> shading_normal;
    std::vector<glm::vec3> smooth_normal;
    std::vector<glm::vec4> color; ///< linear
    std::vector<glm::vec3> coordinate;
    std::vector<glm::vec3> footprint_dx;
    std::vector<glm::vec3> footprint_dy;
};

/// The output of the screen pass, row by row.
struct ScreenPixels {
    std::vector<uint32_t> draw;   ///< draw + 1; 0 without a transparent surface
    std::vector<glm::vec4> color; ///< linear; coverage in w
};

/// Lights in the form that the light pass reads. A shadow size of 0 turns the shadows off.
struct LightSetup {
    std::vector<shared::LightRecord> records;
    uint32_t directional_count = 0;
    glm::vec3 ambient{0.0F};
    float falloff = 1.0F;
    uint32_t shadow_size = 0;       ///< texels per side of the sun's map
    uint32_t local_shadow_size = 0; ///< texels per side of each local light's map; 0: no local shadows
    bool counts_visits = false;
    bool looks_at_all = false;
    bool keeps_strongest = false;
    bool keeps_sun = false;
    bool has_links = false;                    ///< the groups of lights and draw calls are used
    shadow::ShadowStyle shadow;                ///< a millimetre of the style is a pixel
    std::optional<shadow::HatchedLines> lines; ///< hatching lines that the teeth follow
    std::optional<shadow::Clipmap> clipmap;    ///< clipmap around the eye, instead of a single map
    bool is_warped = false;                    ///< the single map is in perspective
    bool keeps_sun_map = false;                ///< reuses the sun's map in `Drawing::features`
};

/// Lines linked into chains, in the format of contour/chains/chains.glsl.h.
struct ChainLists {
    std::vector<uint32_t> marks;  ///< one bit per item
    std::vector<uint32_t> facing; ///< one bit per triangle
    std::vector<glm::vec2>
        view_bends; ///< radial curvature and strength per vertex; only for suggestive contours
    std::vector<shared::ListSize> sizes;
    std::vector<uint32_t> points_before; ///< per slot
    std::vector<uint32_t> flags_of_slot;
    std::vector<shared::ChainPoint> points;
    std::vector<uint32_t> lengths;        ///< length of the segment to the next point
    std::vector<uint32_t> lengths_before; ///< per point
    std::vector<shared::LineSample> samples;
    std::vector<uint32_t> strokes_before; ///< per sample
    std::vector<shared::Stroke> strokes;
};

class Drawing {
public:
    Drawing(const Scene& scene, const Camera& camera, glm::uvec2 size_px, double time_s = 0.0);

    [[nodiscard]] std::vector<shared::PosedVertex> posed();
    /// 64-bit words: reversed depth in the high half, triangle in the low half.
    [[nodiscard]] std::vector<uint64_t> visibility();

    void set_transparency(const transparency::TransparencyStyle& style) { style_.transparency = style; }

    /// Reversed depth, drawn without triangle numbers.
    [[nodiscard]] std::vector<float> depth_alone();
    /// Draws the views, or only the listed `tiles` of the views, into a buffer of `texel_count` words that
    /// are all `before`. Returns the buffer.
    [[nodiscard]] std::vector<uint32_t> depth_views(const std::vector<shared::RasterView>& views,
                                                    size_t texel_count, uint32_t before,
                                                    const std::vector<uint32_t>& tiles = {});
    /// The posed scene, for passes that a test adds.
    [[nodiscard]] raster::RasterInputs raster_inputs(gpu::Graph& graph);
    [[nodiscard]] SurfacePixels surface();
    [[nodiscard]] ScreenPixels screen();
    [[nodiscard]] std::vector<glm::vec4> light(const LightSetup& setup);
    /// Unit vectors towards the strongest light if this light is local, else zero.
    [[nodiscard]] std::vector<glm::vec3> strongest_light(LightSetup setup);
    /// Depths of a piece of the sun's clipmap, row by row.
    [[nodiscard]] std::vector<uint32_t> sun_piece(const shadow::Clipmap& clipmap, const shadow::Piece& piece);
    /// Coverage of the lines, in `line_light`. With `remembers`, the lines of a film's frame that `features`
    /// has begun continue those of the previous frame.
    [[nodiscard]] std::vector<float> lines(const contour::ContourStyle& style, float pixels_per_mm,
                                           bool remembers = false);
    /// Begins the next frame of a film. The frame continues the previous frame, or is the first frame.
    void begin_film_frame(bool continues, bool has_hidden = false);

    void end_film_frame() { features->lines.history().end_frame(globals.clip_from_anchor); }

    [[nodiscard]] ChainLists chains(const contour::ContourStyle& style,
                                    contour::LineClass wanted = contour::LineClass::seen);
    /// Lengths of the lists that make up chains. Skips the lists for drawing, and thus takes a quarter of the
    /// time.
    [[nodiscard]] std::vector<shared::ListSize> chain_sizes(const contour::ContourStyle& style);

    /// The point of anchor space that is visible at a page position.
    [[nodiscard]] glm::dvec3 point_at(glm::dvec2 position_px, double depth) const;
    /// The point of anchor space that is visible at the centre of a pixel, counted row by row; far away for
    /// the background.
    [[nodiscard]] glm::dvec3 point_seen(size_t pixel, float depth) const;
    [[nodiscard]] shadow::SunMapFit warped_sun(const glm::dvec3& towards_sun, uint32_t shadow_size) const;
    [[nodiscard]] shadow::SunView sun(const glm::dvec3& towards_sun, uint32_t shadow_size) const;

    std::unique_ptr<frame::LoadedScene> loaded;
    /// The data that drawings keep for the next drawing; a test may pass it on.
    std::shared_ptr<frame::Features> features = std::make_shared<frame::Features>();
    glm::uvec2 size_px;
    RasterPath path = RasterPath::compute;
    raster::Tuning tuning;
    bool with_ground = false;
    /// How the passes that draw lines work; if not set, as suits the shared device.
    std::optional<gpu::ExecutionProfile> line_execution;
    LightSetup line_light{.ambient = glm::vec3(1.0F)}; ///< the light that lines are drawn in
    pose::MeshData& layout;                            ///< belongs to `loaded`
    const pose::PoseData& pose;                        ///< belongs to `loaded`
    shared::FrameGlobals globals;

private:
    /// The passes of one graph up to the surface, with the data that later passes need.
    struct Stage {
        frame::FrameContext context;
        frame::PosedScene scene;
        gpu::BufferId visibility;
        surface::Surface surface;
    };

    /// The context refers to members of this object in their current state.
    frame::FrameContext context(gpu::Graph& graph);
    Stage add_surface(gpu::Graph& graph);
    features::SunMapPlan sun_plan(const LightSetup& setup) const;
    /// Plans the light and its shadows, and uploads their lookup data. Must be called before a graph is
    /// begun.
    void prepare_light(const LightSetup& setup);
    light::LitPixels add_light(const Stage& stage, const LightSetup& setup);
    void prepare_lines(const contour::ContourStyle& style, float pixels_per_mm);
    contour::ContourInputs add_lit_lines(const Stage& stage);

    frame::FrameBuffers buffers_;
    frame::FrameJob job_;
    frame::FramePlan plan_;
    frame::SamplePlan sample_;
    features::StyleTables style_;
    std::vector<wash::WashVariant> wash_variants_;
};

} // namespace estampe::test
