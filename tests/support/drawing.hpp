// SPDX-License-Identifier: MIT
#pragma once

// A scene on the shared device, for tests that look at what one technique hands to the next: drawn by the
// steps of a frame, of which each function declares as many as it needs.

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

/// What the surface pass writes, row by row; meaningless but for draw and depth where nothing is seen.
struct SurfacePixels {
    std::vector<uint32_t> draw; ///< as in shaders/surface_images.glsl
    std::vector<float> depth;
    std::vector<glm::vec3> shading_normal;
    std::vector<glm::vec3> smooth_normal;
    std::vector<glm::vec4> color; ///< linear
    std::vector<glm::vec3> coordinate;
    std::vector<glm::vec3> footprint_dx;
    std::vector<glm::vec3> footprint_dy;
};

/// What the screen pass writes, row by row.
struct ScreenPixels {
    std::vector<uint32_t> draw;   ///< draw + 1, 0 for none
    std::vector<glm::vec4> color; ///< linear; cover in w
};

/// Lights as the light pass takes them. A shadow size of 0 makes no shadow.
struct LightSetup {
    std::vector<shared::LightRecord> records;
    uint32_t directional_count = 0;
    glm::vec3 ambient{0.0F};
    float falloff = 1.0F;
    uint32_t shadow_size = 0;       ///< texels a side of the sun's map
    uint32_t local_shadow_size = 0; ///< of each map of a local light; 0: no such shadows
    bool counts_visits = false;
    bool looks_at_all = false;
    bool keeps_strongest = false;
    bool keeps_sun = false;
    bool has_links = false;                    ///< groups of lights and draws count
    shadow::ShadowStyle shadow;                ///< millimetres are pixels
    std::optional<shadow::HatchedLines> lines; ///< what teeth follow
    std::optional<shadow::Clipmap> clipmap;    ///< about the eye, in place of a single map
    bool is_warped = false;                    ///< a single map in perspective
    bool keeps_sun_map = false;                ///< goes on from the map that `Drawing::features` hold
};

/// Lines strung as chains, as contour/chains/chains.glsl.h has them.
struct ChainLists {
    std::vector<uint32_t> marks;  ///< a bit an item
    std::vector<uint32_t> facing; ///< a bit a triangle
    std::vector<glm::vec2>
        view_bends; ///< radial curvature and strength a vertex; only of suggestive contours
    std::vector<shared::ListSize> sizes;
    std::vector<uint32_t> points_before; ///< each slot
    std::vector<uint32_t> flags_of_slot;
    std::vector<shared::ChainPoint> points;
    std::vector<uint32_t> lengths;        ///< of the piece to the next point
    std::vector<uint32_t> lengths_before; ///< each point
    std::vector<shared::LineSample> samples;
    std::vector<uint32_t> strokes_before; ///< each sample
    std::vector<shared::Stroke> strokes;
};

class Drawing {
public:
    Drawing(const Scene& scene, const Camera& camera, glm::uvec2 size_px, double time_s = 0.0);

    [[nodiscard]] std::vector<shared::PosedVertex> posed();
    /// 64-bit words: reversed depth above, triangle below.
    [[nodiscard]] std::vector<uint64_t> visibility();
    /// Reversed depth, drawn without the triangles' identities.
    [[nodiscard]] std::vector<float> depth_alone();
    /// A buffer of `texel_count` words that held `before` and into which the views were drawn, or these tiles
    /// of them.
    [[nodiscard]] std::vector<uint32_t> depth_views(const std::vector<shared::RasterView>& views,
                                                    size_t texel_count, uint32_t before,
                                                    const std::vector<uint32_t>& tiles = {});
    /// The posed scene for passes of a test's own.
    [[nodiscard]] raster::RasterInputs raster_inputs(gpu::Graph& graph);
    [[nodiscard]] SurfacePixels surface();
    [[nodiscard]] ScreenPixels screen();
    [[nodiscard]] std::vector<glm::vec4> light(const LightSetup& setup);
    /// Unit vectors towards the strongest light where it is a local one, else zero.
    [[nodiscard]] std::vector<glm::vec3> strongest_light(LightSetup setup);
    /// Depths of a piece of the sun's clipmap, row by row.
    [[nodiscard]] std::vector<uint32_t> sun_piece(const shadow::Clipmap& clipmap, const shadow::Piece& piece);
    /// Coverage of the lines, in `line_light`; those of a film's frame that `features` have begun go on from
    /// the frame before where it `remembers`.
    [[nodiscard]] std::vector<float> lines(const contour::ContourStyle& style, float pixels_per_mm,
                                           bool remembers = false);
    /// Begins the next frame of a film, which goes on from the one before or is the first.
    void begin_film_frame(bool continues, bool has_hidden = false);

    void end_film_frame() { features->lines.history().end_frame(globals.clip_from_anchor); }

    [[nodiscard]] ChainLists chains(const contour::ContourStyle& style,
                                    contour::LineClass wanted = contour::LineClass::seen);
    /// How long the lists are that make up chains, without what those are drawn from: a quarter of the time.
    [[nodiscard]] std::vector<shared::ListSize> chain_sizes(const contour::ContourStyle& style);

    /// The point of anchor space seen at a place of the page.
    [[nodiscard]] glm::dvec3 point_at(glm::dvec2 position_px, double depth) const;
    /// The same at the centre of a pixel, counted row by row; far away where nothing is seen.
    [[nodiscard]] glm::dvec3 point_seen(size_t pixel, float depth) const;
    [[nodiscard]] shadow::SunMapFit warped_sun(const glm::dvec3& towards_sun, uint32_t shadow_size) const;
    [[nodiscard]] shadow::SunView sun(const glm::dvec3& towards_sun, uint32_t shadow_size) const;

    std::unique_ptr<frame::LoadedScene> loaded;
    /// What goes on from drawing to drawing, where a test hands it on.
    std::shared_ptr<frame::Features> features = std::make_shared<frame::Features>();
    glm::uvec2 size_px;
    RasterPath path = RasterPath::compute;
    raster::Tuning tuning;
    bool with_ground = false;
    LightSetup line_light{.ambient = glm::vec3(1.0F)}; ///< that lines are drawn in
    pose::MeshData& layout;                            ///< of `loaded`
    const pose::PoseData& pose;                        ///< of `loaded`
    shared::FrameGlobals globals;

private:
    /// The passes of one graph up to the surface, with all that the later ones need.
    struct Stage {
        frame::FrameContext context;
        frame::PosedScene scene;
        gpu::BufferId visibility;
        surface::Surface surface;
    };

    /// All in it are members, as they are now.
    frame::FrameContext context(gpu::Graph& graph);
    Stage add_surface(gpu::Graph& graph);
    features::SunMapPlan sun_plan(const LightSetup& setup) const;
    /// Plans the light and its shadows, and uploads what they are looked up by. To be called before a graph
    /// is begun.
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
