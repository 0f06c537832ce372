// SPDX-License-Identifier: MIT
#pragma once

// The shadows of a scene over several pictures: the shadow of the terrain, and the shadow maps of local
// lights (which lights get maps, how large, drawn by which passes). The sun's shadow map is in sun.hpp.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "features/common/feature.hpp"
#include "features/common/view.hpp"
#include "features/shadows/sun.hpp"
#include "gpu/device.hpp"
#include "gpu/execution_profile.hpp"
#include "gpu/resources.hpp"
#include "techniques/light/light.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/raster/raster.glsl.h"
#include "techniques/raster/views/views.hpp"
#include "techniques/shadow/atlas.hpp"
#include "techniques/shadow/ground/ground_shadow.hpp"
#include "techniques/shadow/shadow.glsl.h"
#include "techniques/shadow/shadow_style.hpp"
#include "techniques/terrain/terrain_buffers.hpp"

namespace estampe::features {

struct GroundShadowPlan {
    bool is_thrown = false;
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    float sun_radius_rad = 0.0F;
    uint32_t size = 0; ///< Texels per side of each height field
    shadow::GroundLevels levels{};
    shadow::HeightShadowStyle style;
    /// Height difference between the lowest ground and the top of the highest object on it.
    double relief_m = 0.0;
};

struct GroundShadowScene {
    const Camera& camera;
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    bool is_thrown = false;
    uint32_t page_height_px = 0;
    gpu::ExecutionProfile execution; ///< Kind of device that computes the shadow: CPU or GPU
    double relief_m = 0.0;           ///< Height difference of ground and objects, see GroundShadowPlan
};

/// Plans the height fields around the camera, from which the terrain's shadow is computed. On a CPU, horizons
/// are found by sweeps over the field, which need the least work. On a GPU, pyramids (coarser copies of the
/// field) are used, because sweeps have too few parallel threads. On a small page each height field is half
/// as wide as on a large page. A pixel of a small page covers as much ground as a pixel of a large page at
/// twice the distance.
[[nodiscard]] GroundShadowPlan plan_ground_shadow(const GroundShadowScene& scene,
                                                  const shadow::ShadowStyle& style);

struct GroundShadowInputs {
    const GroundShadowPlan& plan;
    gpu::BufferId texels; ///< Texels of the textures in the terrain's height graph
    gpu::BufferId frame;  ///< FrameGlobals of the picture
    gpu::ImageId depth;
    glm::uvec2 size_px{0};
    /// Camera matrix of the page; set if the page is not drawn in tiles.
    std::optional<glm::mat4> clip_from_anchor = std::nullopt;
};

/// Keeps fields of the terrain's heights and horizons between pictures. A field is computed again when it
/// moves with the eye, or when the sun or the ground changes. While sun or ground keep changing, the pyramid
/// method computes only the part of the field that the picture needs.
class GroundShadow {
public:
    void forget() { held_.reset(); }

    /// Allocates the buffer of height fields for `plan`.
    void ensure(gpu::Device& device, const GroundShadowPlan& plan);
    /// Updates the height fields, and returns an image with the visible share of the sun at each pixel.
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, terrain::TerrainBuffers& terrain,
                                      const GroundShadowInputs& in);
    /// Records that the height fields of `plan` have been computed.
    void drawn(const GroundShadowPlan& plan, const terrain::TerrainBuffers& terrain);

private:
    struct Held {
        GroundShadowPlan plan;
        uint64_t form = 0; ///< Number that identifies the terrain's shape
    };

    /// Returns whether a height field has the same position as in the last picture.
    [[nodiscard]] bool stands(const GroundShadowPlan& plan, uint32_t level) const;

    [[nodiscard]] bool is_held(const GroundShadowPlan& plan, uint32_t level, uint64_t form) const;

    gpu::Buffer kept_;
    std::optional<Held> held_;
    bool is_in_part_ = false; ///< Only those parts of the height fields are valid that the last picture used
};

/// Returns the properties of a local light on which its shadow maps depend. The range is rounded up in steps,
/// so that the maps stay valid when the exposure changes slightly.
[[nodiscard]] shadow::LocalLight local_light(const shared::LightRecord& record);

/// Radius of the light's sphere in metres: the light's own radius, or otherwise the style's.
[[nodiscard]] float radius_of(const shared::LightRecord& record, const shadow::ShadowStyle& style);

/// The eye and the resolution of the page, which determine the size of a lamp's shadow map.
struct PageView {
    glm::vec3 eye_anchor{0.0F};
    PixelSize pixel;
    float scene_radius_m = 1.0F;
    uint32_t longer_side_px = 1;
};

/// Returns a light's request for space in the shadow atlas: one texel for each pixel that the light's shadows
/// cover, but at most the size in the style. If the style sets no size, the limit is half the page for a
/// point light and the whole page for a spot. The importance grows with the share of the page that the light
/// reaches.
[[nodiscard]] shadow::AtlasRequest atlas_request(const shared::LightRecord& record,
                                                 const shadow::LocalLight& light, const PageView& page,
                                                 const shadow::ShadowStyle& style);

/// Appends the views from a light that draw its shadow maps; call raster::place_views() afterwards.
void add_views(std::vector<shared::RasterView>& list, const shadow::LocalLight& light,
               const shared::LocalShadow& shadow);

/// Views (from lights) that draw obsolete shadow maps, in one list per drawing method. raster::place_views()
/// gives the views of each list their places.
struct LocalMapViews {
    std::vector<shared::RasterView> whole; ///< Views that draw all shadow casters
    std::vector<shared::RasterView> still; ///< Views that draw static shadow casters into a separate layer
    /// Views that draw moving shadow casters and merge them with the layer of static casters.
    std::vector<shared::RasterView> moving;

    [[nodiscard]] bool empty() const { return whole.empty() && still.empty() && moving.empty(); }

    /// Clears the lists, but keeps their memory.
    void clear()
    {
        whole.clear();
        still.clear();
        moving.clear();
    }
};

/// The shadow maps of local lights in a picture.
struct LocalMapPlan {
    bool is_there = false; ///< At least one local light has a shadow map
    uint32_t variant = 0;  ///< Variant of the shadow shader, see shadow/shadow_style.hpp
    LocalMapViews views;   ///< Views that draw the obsolete shadow maps
};

/// The local lights' shadow maps of one frame.
struct LocalShadowPlan {
    /// Shadow maps of the lights; LightRecord::shadow is an index of this list, counted from 1.
    std::vector<shared::LocalShadow> shadows;
    LocalMapViews views;
    uint64_t texel_count = 0; ///< Number of texels in the buffer of all shadow maps
    size_t without = 0;       ///< Number of lights that cast shadows but got no shadow map
};

/// Plans the shadow maps of a scene's local lights and remembers which are valid.
class LocalShadows {
public:
    /// Plans the shadow maps and sets `shadow` in the lights' records. `moved` lists boxes of moved objects,
    /// before and after the move. If casters move within reach of an unchanged light, its static casters get
    /// a layer of their own in a second buffer, which is as large as the buffer of the maps.
    /// `shadow.local_megatexels` limits the size of the maps. The result is valid until the next call. Cost:
    /// linear in lights and moved objects.
    [[nodiscard]] const LocalShadowPlan& plan(light::Lighting& lighting, std::span<const Bounds> moved,
                                              const PageView& page, const shadow::ShadowStyle& style,
                                              const CasterKinds& casters = {});

    /// Makes all shadow maps and layers obsolete. Call this for another scene or another buffer.
    void forget() { kept_.clear(); }

private:
    struct Kept {
        shadow::LocalLight light;
        shadow::Allotment allotment;
        bool has_layer = false; ///< The map has a separate layer with static casters
    };

    shadow::Atlas atlas_;
    std::vector<Kept> kept_; ///< Content of the shadow maps, per local light
    /// Plan of the last picture; its memory is reused, like that of the next two members.
    LocalShadowPlan plan_;
    std::vector<shadow::LocalLight> lights_;
    std::vector<shadow::AtlasRequest> requests_;
};

/// The lists of LocalMapViews in buffers on the device.
struct LocalViewBuffers {
    gpu::Buffer whole;
    gpu::Buffer still;
    gpu::Buffer moving;
};

/// Buffers of the local lights' shadow maps.
struct LocalShadowBuffers {
    gpu::Buffer shadows; ///< Buffer of the shadow maps' descriptions: one LocalShadow per light that has maps
    gpu::Buffer maps;    ///< Texels of the shadow maps, kept from frame to frame
    gpu::Buffer layers;  ///< Texels of the layers of static casters; empty if no light has such a layer
    LocalViewBuffers views;
};

/// Returns the shadow casters as list_casters() does, as a new list.
[[nodiscard]] std::vector<raster::Batch> caster_batches(const pose::MeshData& layout, Groups groups,
                                                        Casters which = Casters::all);

/// Draws the obsolete shadow maps of lamps: from all casters, or from moving casters over the layer of static
/// ones.
///
/// Writes  maps and layers of `buffers`; returns the maps Cost    nothing if no map is obsolete; otherwise
/// raster::add_depth_views() per list of views
[[nodiscard]] gpu::BufferId add_local_maps(gpu::Graph& graph, const ShadowScene& scene,
                                           const LocalMapViews& views, LocalShadowBuffers& buffers);

/// The inputs for planning the local lights' shadow maps.
struct LocalMapScene {
    PageView page;
    shadow::ShadowStyle style; ///< Settings of shadows, with the number of local lights that may cast shadows
    CasterKinds casters;
};

/// The shadow maps of one sample of a picture, and which parts of them must be drawn.
struct ShadowMapWork {
    const SunMapPlan& sun;
    const SunMapWork& of_sun;
    const LocalMapPlan& local;
    /// The local lights' maps must be drawn; false if an earlier sample has drawn them.
    bool draws_local = true;
};

class Shadows final : public Feature {
public:
    /// Makes shadow maps obsolete when the scene, its lights or the origin of positions change.
    void invalidate(Event event) override;

    /// Records that an object moved between the boxes `places`, so that shadow maps are drawn again there.
    /// Boxes are relative to the scene's anchor (the origin of positions on the device).
    void move(std::span<const Bounds> places);

    /// Plans the shadow maps of local lights, sets `shadow` in the lights' records, and allocates buffers.
    /// Adds a note to `notes` that says how many lights get no map.
    [[nodiscard]] LocalMapPlan ensure_local_maps(gpu::Device& device, light::Lighting& lighting,
                                                 const LocalMapScene& scene, std::vector<std::string>& notes);

    /// Uploads the constants with which shaders look up shadows.
    void upload(gpu::Device& device, const shared::EdgeProfile& edges, const shared::SunShadow& sun);

    /// Draws the obsolete parts of a picture's shadow maps. Cost: that of SunMap::record() and
    /// add_local_maps().
    [[nodiscard]] light::ShadowMaps record(gpu::Graph& graph, const ShadowScene& scene,
                                           const ShadowMapWork& work);

    [[nodiscard]] SunMap& sun() { return sun_; }

    [[nodiscard]] GroundShadow& ground() { return ground_; }

private:
    SunMap sun_;
    GroundShadow ground_;
    LocalShadows local_;
    LocalShadowBuffers local_buffers_;
    std::vector<Bounds> moved_; ///< Boxes of objects that moved since local maps were last planned
    gpu::Buffer edge_profile_;  ///< Buffer of an EdgeProfile, see shadow/shadow.glsl.h
    gpu::Buffer sun_globals_;   ///< Buffer of a SunShadow, see shadow/shadow.glsl.h
};

} // namespace estampe::features
