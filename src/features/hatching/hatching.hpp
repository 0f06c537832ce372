// SPDX-License-Identifier: MIT
#pragma once

// Hatching from picture to picture: the tonal art maps of the strokes, and the direction that strokes follow
// on each surface, chosen from the style and from the data of the meshes.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "features/common/feature.hpp"
#include "features/common/style_tables.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/hatch/hatch.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/shadow/shadow_style.hpp"

namespace estampe::features {

struct StrokePlan {
    /// Stroke kind of each draw call, numbered as in shaders/stroke_kind.glsl.h.
    std::vector<uint32_t> kind_of_draw;
    uint32_t present = 0;              ///< Stroke kinds that occur in the picture, one bit per kind
    glm::vec2 ground_wind{1.0F, 0.0F}; ///< Horizontal direction of the wind over the ground, as x and z
    /// Draw calls of the ground and the terrain; UINT32_MAX where there is none.
    glm::uvec2 ground_draws{UINT32_MAX};
    bool has_causes = false; ///< Shade is hatched by its cause, see hatch::needs_causes()

    [[nodiscard]] bool has(uint32_t kind) const { return (present >> kind & 1U) != 0; }

    /// Returns whether some strokes follow height, wind, light or slope.
    [[nodiscard]] bool has_directions() const
    {
        return has(shared::strokes_height) || has(shared::strokes_wind) || has(shared::strokes_light) ||
               has(shared::strokes_slope);
    }
};

/// Chooses the direction that the strokes of each draw call follow: the choice of its style variant, if the
/// surface allows this choice. Strokes follow UVs only on meshes with UVs. The blank ground has no form to
/// follow; on dunes, strokes follow the slope. The list reuses the memory of `room`. Cost: linear in draw
/// calls.
[[nodiscard]] StrokePlan plan_strokes(const pose::MeshData& meshes, const StyleVariants& variants,
                                      std::vector<uint32_t> room = {});

/// Returns the hatching lines along which the edges of shadows can be drawn; none if the hatching does not
/// consist of lines.
[[nodiscard]] std::optional<shadow::HatchedLines>
hatched_lines(const hatch::HatchStyle& style, const glm::vec3& towards_light, const StrokePlan& strokes);

/// Computes texture coordinates that follow the form of a surface in the rest pose, three per triangle. The
/// texture coordinates are zero for draw calls with strokes that do not follow the form. Cost:
/// form::follow_form() per draw call.
[[nodiscard]] std::vector<glm::vec2> form_coordinates(const pose::MeshData& meshes, const StrokePlan& plan);

/// The settings on which a tonal art map depends.
struct MapChoice {
    std::string file; ///< Path of a tonal art map; if empty, a map is drawn with the settings of `drawn`
    ReadScope scope;  ///< Limits the files of the tonal art map
    tam::TamStyle drawn;
    hatch::MapTone tone = hatch::MapTone::order;
    float contrast = 1.0F;

    bool operator==(const MapChoice&) const = default;
};

[[nodiscard]] MapChoice map_choice(const StyleTables& style);

/// Reads the tonal art map's file, or draws the map. A drawn map is cached in `estampe` under $XDG_CACHE_HOME
/// or ~/.cache; without a usable cache the map is drawn every time. Throws Error with the file's name if the
/// file is not a map, or with the style's name if the map cannot be drawn. Cost: about a second to draw a map
/// of six tones of 512 px, or 50 ms to read it from the cache.
[[nodiscard]] hatch::MapData load_map(const MapChoice& choice);

/// Tonal art maps on the device, one per distinct choice among the style variants, kept from picture to
/// picture.
class TonalMaps {
public:
    /// Loads the tonal art maps that the style variants need and that are not loaded yet. Throws Error as
    /// load_map() does.
    void ensure(gpu::Device& device, const std::vector<StyleTables>& variants);

    /// Returns the tonal art map of a style variant; null if its strokes use no map.
    [[nodiscard]] hatch::MapImages* of_variant(size_t variant)
    {
        return place_of_variant_.at(variant) ? &maps_.at(*place_of_variant_[variant]).images : nullptr;
    }

private:
    struct Loaded {
        MapChoice choice;
        hatch::MapImages images;
    };

    std::vector<Loaded> maps_;
    std::vector<std::optional<size_t>> place_of_variant_;
};

/// Returns the path of the cache file for the tonal art map of `style`; empty if there is no cache folder.
[[nodiscard]] std::filesystem::path kept_map(const tam::TamStyle& style);

class Hatching final : public Feature {
public:
    /// Forgets the stroke kinds when draw calls or triangles get new numbers.
    void invalidate(Event event) override;

    /// Uploads the stroke kind of each draw call. Costs nothing if no stroke kind changed; otherwise linear
    /// in triangles if strokes follow the form.
    void ensure_strokes(gpu::Device& device, const pose::MeshData& layout, const StrokePlan& strokes);

    /// Returns the tonal art maps of the style variants.
    [[nodiscard]] TonalMaps& maps() { return maps_; }

    /// Returns how each style variant is hatched; call TonalMaps::ensure() first. The result is valid until
    /// the next call.
    [[nodiscard]] const std::vector<hatch::HatchVariant>& variants(gpu::Graph& graph,
                                                                   const std::vector<StyleTables>& styles);

    /// Returns the buffer with the stroke kind of each draw call, numbered as in shaders/stroke_kind.glsl.h.
    [[nodiscard]] gpu::Buffer& kinds() { return kinds_; }

    /// Returns the buffer with the result of form_coordinates(), three texture coordinates per triangle;
    /// empty if no strokes follow the form.
    [[nodiscard]] gpu::Buffer& form_coordinates() { return form_coordinates_; }

private:
    TonalMaps maps_;
    std::vector<hatch::HatchVariant> variants_; ///< Hatching of each variant, kept to reuse the list's memory
    std::vector<uint32_t> kind_of_draw_;        ///< Stroke kind of each draw call, as stored in `kinds_`
    gpu::Buffer kinds_;
    gpu::Buffer form_coordinates_;
};

} // namespace estampe::features
