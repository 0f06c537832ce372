// SPDX-License-Identifier: MIT
#pragma once

// The shadows of a scene from picture to picture: that of the terrain; the maps of lamps and spots, who gets
// one, how large, and which are drawn anew by which passes; and, in sun.hpp, the sun's map.

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
    uint32_t size = 0; ///< texels a side of each field
    shadow::GroundLevels levels{};
    shadow::HeightMethod method = shadow::HeightMethod::sweep;
    double relief_m = 0.0; ///< between the lowest ground and the highest of what stands on it
};

struct GroundShadowScene {
    const Camera& camera;
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    bool is_thrown = false;
    uint32_t page_height_px = 0;
    gpu::ExecutionProfile execution; ///< of the device that draws it
    double relief_m = 0.0;           ///< of the scene
};

/// Plans the fields about the camera. Their horizons are found by sweeps on a processor, which does least
/// then; a device of many threads keeps too few of them busy by that, and climbs pyramids. A small page's
/// fields reach half as far each: its pixels are as large there as a large page's are twice as far away.
[[nodiscard]] GroundShadowPlan plan_ground_shadow(const GroundShadowScene& scene,
                                                  const shadow::ShadowStyle& style);

struct GroundShadowInputs {
    const GroundShadowPlan& plan;
    gpu::BufferId texels; ///< of the terrain
    gpu::BufferId frame;  ///< FrameGlobals
    gpu::ImageId depth;
    glm::uvec2 size_px{0};
    std::optional<glm::mat4> clip_from_anchor = std::nullopt; ///< where all of a picture is drawn at once
};

/// Fields of heights and horizons between pictures. A field is made anew when it has gone along with the eye,
/// or when the sun or the ground have changed. By pyramid, fields that stand on ground which goes on
/// changing, or under such a sun, are made where the picture looks them up and no farther.
class GroundShadow {
public:
    void forget() { held_.reset(); }

    /// Makes room for what `plan` wants.
    void ensure(gpu::Device& device, const GroundShadowPlan& plan);
    /// Brings the fields up to date, and looks up in them how much of the sun is left at each pixel.
    [[nodiscard]] gpu::ImageId record(gpu::Graph& graph, terrain::TerrainBuffers& terrain,
                                      const GroundShadowInputs& in);
    /// That has been drawn.
    void drawn(const GroundShadowPlan& plan, const terrain::TerrainBuffers& terrain);

private:
    struct Held {
        GroundShadowPlan plan;
        uint64_t form = 0; ///< of the terrain
    };

    /// Whether a field is where it was.
    [[nodiscard]] bool stands(const GroundShadowPlan& plan, uint32_t level) const;

    [[nodiscard]] bool is_held(const GroundShadowPlan& plan, uint32_t level, uint64_t form) const;

    gpu::Buffer kept_;
    std::optional<Held> held_;
    bool is_in_part_ = false; ///< what is held is up to date only where the last picture looked it up
};

/// What the maps of a local light depend on. The range is rounded up, so that the exposure of a scene that
/// moves does not change it all the time.
[[nodiscard]] shadow::LocalLight local_light(const shared::LightRecord& record);

/// Radius in metres of the ball that glows: the light's own, or what the style says of all.
[[nodiscard]] float radius_of(const shared::LightRecord& record, const shadow::ShadowStyle& style);

/// Where the page is taken from, for judging how many texels a light is worth.
struct PageView {
    glm::vec3 eye_anchor{0.0F};
    PixelSize pixel;
    float scene_radius_m = 1.0F;
    uint32_t longer_side_px = 1;
};

/// What a light asks of the atlas: as many texels as its shadow fills pixels, at most the style's size or
/// half the page for an omni and the whole page for a spot; more important the more of the page it lights.
[[nodiscard]] shadow::AtlasRequest atlas_request(const shared::LightRecord& record,
                                                 const shadow::LocalLight& light, const PageView& page,
                                                 const shadow::ShadowStyle& style);

/// The views that draw the maps of a light, not placed yet.
void add_views(std::vector<shared::RasterView>& list, const shadow::LocalLight& light,
               const shared::LocalShadow& shadow);

/// Maps that are out of date, each list placed by raster::place_views().
struct LocalMapViews {
    std::vector<shared::RasterView> whole;  ///< to be drawn from all casters
    std::vector<shared::RasterView> still;  ///< whose layer of what stands still is to be drawn
    std::vector<shared::RasterView> moving; ///< to be drawn from what moves, and merged with that layer

    [[nodiscard]] bool empty() const { return whole.empty() && still.empty() && moving.empty(); }

    /// Keeps the room that they took.
    void clear()
    {
        whole.clear();
        still.clear();
        moving.clear();
    }
};

/// Shadow maps of local lights, as a picture is to have them.
struct LocalMapPlan {
    bool is_there = false; ///< some light has any
    uint32_t variant = 0;  ///< see shadow/shadow_style.hpp
    LocalMapViews views;   ///< to draw anew
};

/// The maps of one frame.
struct LocalShadowPlan {
    std::vector<shared::LocalShadow> shadows; ///< what LightRecord::shadow numbers, from 1
    LocalMapViews views;
    uint64_t texel_count = 0; ///< that the buffer of all maps must hold
    size_t without = 0;       ///< lights that asked for a shadow and got none
};

/// Plans the maps of a scene's local lights and remembers which of them are up to date.
class LocalShadows {
public:
    /// Fills in the records' `shadow`. `moved` are the places, before and after, of what moved since the last
    /// call. A light within whose reach casters move while it stands keeps a layer of those that do not, in a
    /// second buffer as large as the maps', which are held to `shadow.local_megatexels`. Valid until the next
    /// call. Cost: linear in lights and in what moved.
    [[nodiscard]] const LocalShadowPlan& plan(light::Lighting& lighting, std::span<const Bounds> moved,
                                              const PageView& page, const shadow::ShadowStyle& style,
                                              const CasterKinds& casters = {});

    /// All maps and layers are out of date: another scene, or another buffer.
    void forget() { kept_.clear(); }

private:
    struct Kept {
        shadow::LocalLight light;
        shadow::Allotment allotment;
        bool has_layer = false; ///< of what stands still
    };

    shadow::Atlas atlas_;
    std::vector<Kept> kept_; ///< by local light: what its maps show
    LocalShadowPlan plan_;   ///< its room serves the next frame, as does that of these:
    std::vector<shadow::LocalLight> lights_;
    std::vector<shadow::AtlasRequest> requests_;
};

/// The views to draw, for the device.
struct LocalViewBuffers {
    gpu::Buffer whole;
    gpu::Buffer still;
    gpu::Buffer moving;
};

/// Shadow maps of local lights.
struct LocalShadowBuffers {
    gpu::Buffer shadows; ///< LocalShadow, one for each light that has maps
    gpu::Buffer maps;    ///< their texels, kept from frame to frame
    gpu::Buffer layers;  ///< texels of what stands still alone, where some light keeps those apart
    LocalViewBuffers views;
};

/// What blocks a light, see list_casters(), in a list of its own.
[[nodiscard]] std::vector<raster::Batch> caster_batches(const pose::MeshData& layout, Groups groups,
                                                        Casters which = Casters::all);

/// Draws the maps that are out of date: whole, or what moves alone, over the layer of what stands still.
///
/// Writes  maps and layers of `buffers`; returns the maps
/// Cost    nothing where no map is out of date; else that of raster::add_depth_views() for each list of views
[[nodiscard]] gpu::BufferId add_local_maps(gpu::Graph& graph, const ShadowScene& scene,
                                           const LocalMapViews& views, LocalShadowBuffers& buffers);

/// What the maps of local lights are planned from.
struct LocalMapScene {
    PageView page;
    shadow::ShadowStyle style; ///< with as many local lights as may throw shadows
    CasterKinds casters;
};

/// The maps that a sample of a picture has, and what of them is to be drawn.
struct ShadowMapWork {
    const SunMapPlan& sun;
    const SunMapWork& of_sun;
    const LocalMapPlan& local;
    bool draws_local = true; ///< else a sample before this one did
};

class Shadows final : public Feature {
public:
    /// Maps hold what they were drawn from: another scene, light or origin makes them out of date.
    void invalidate(Event event) override;

    /// Something moved from and to these places (anchor space).
    void move(std::span<const Bounds> places);

    /// Plans the maps of local lights, fills in the records' `shadow`, makes room, and says in `notes` how
    /// many lights go without.
    [[nodiscard]] LocalMapPlan ensure_local_maps(gpu::Device& device, light::Lighting& lighting,
                                                 const LocalMapScene& scene, std::vector<std::string>& notes);

    /// Uploads what lookups read.
    void upload(gpu::Device& device, const shared::EdgeLook& edges, const shared::SunShadow& sun);

    /// Draws what of a picture's maps is out of date. Cost: that of SunMap::record() and add_local_maps().
    [[nodiscard]] light::ShadowMaps record(gpu::Graph& graph, const ShadowScene& scene,
                                           const ShadowMapWork& work);

    [[nodiscard]] SunMap& sun() { return sun_; }

    [[nodiscard]] GroundShadow& ground() { return ground_; }

private:
    SunMap sun_;
    GroundShadow ground_;
    LocalShadows local_;
    LocalShadowBuffers local_buffers_;
    std::vector<Bounds> moved_; ///< since local maps were planned last
    gpu::Buffer edge_look_;     ///< EdgeLook, see shadow/shadow.glsl.h
    gpu::Buffer sun_globals_;   ///< SunShadow, see shadow/shadow.glsl.h
};

} // namespace estampe::features
