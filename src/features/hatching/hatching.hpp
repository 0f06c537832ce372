// SPDX-License-Identifier: MIT
#pragma once

// Strokes from picture to picture: the tonal art maps they come from, and what they follow on each surface,
// which is decided from the style and what the meshes can offer.

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
    std::vector<uint32_t> kind_of_draw; ///< numbered as in shaders/stroke_kind.glsl.h
    uint32_t present = 0;               ///< a bit for each kind that occurs
    glm::vec2 ground_wind{1.0F, 0.0F};  ///< horizontal direction x, z

    [[nodiscard]] bool has(uint32_t kind) const { return (present >> kind & 1U) != 0; }

    /// Whether some strokes follow height, wind, light or slope.
    [[nodiscard]] bool has_directions() const
    {
        return has(shared::strokes_height) || has(shared::strokes_wind) || has(shared::strokes_light) ||
               has(shared::strokes_slope);
    }
};

/// What the strokes of each draw follow: what its style variant asks for, if its surface has it. UVs are
/// followed only where there are any; grounds have no form, dunes keep to their slopes. The list takes
/// `room`. Cost: linear in draws.
[[nodiscard]] StrokePlan plan_strokes(const pose::MeshData& meshes, const StyleVariants& looks,
                                      std::vector<uint32_t> room = {});

/// The lines of the hatching that edges of shadows can follow; none where no lines are drawn.
[[nodiscard]] std::optional<shadow::HatchedLines>
hatched_lines(const hatch::HatchStyle& style, const glm::vec3& towards_light, const StrokePlan& strokes);

/// Coordinates along the form in the rest pose, three a triangle, zero where a draw does not follow it.
/// Cost: see form::follow_form; each draw by itself.
[[nodiscard]] std::vector<glm::vec2> form_coordinates(const pose::MeshData& meshes, const StrokePlan& plan);

/// What a map depends on.
struct MapChoice {
    std::string file; ///< empty: drawn as `drawn` says
    tam::TamStyle drawn;
    hatch::MapTone tone = hatch::MapTone::order;
    float contrast = 1.0F;

    bool operator==(const MapChoice&) const = default;
};

[[nodiscard]] MapChoice map_choice(const StyleTables& style);

/// Reads the file, or draws the map. A map that was drawn is kept in `estampe` under $XDG_CACHE_HOME, or
/// ~/.cache, and read from there the next time; where that cannot be it is drawn again. Throws Error naming
/// the file when it is not a map, or the style when it cannot be drawn. Cost: about a second to draw 512 px
/// and six tones; 50 ms to read them.
[[nodiscard]] hatch::MapData load_map(const MapChoice& choice);

/// The maps of a picture's looks on the device, kept from picture to picture.
class TonalMaps {
public:
    /// Loads what the styles of looks ask for and is not there yet. Throws Error as load_map().
    void ensure(gpu::Device& device, const std::vector<StyleTables>& looks);

    /// That of a look; null where its strokes come from none.
    [[nodiscard]] hatch::MapImages* of_look(size_t look)
    {
        return place_of_look_.at(look) ? &maps_.at(*place_of_look_[look]).images : nullptr;
    }

private:
    struct Loaded {
        MapChoice choice;
        hatch::MapImages images;
    };

    std::vector<Loaded> maps_;
    std::vector<std::optional<size_t>> place_of_look_;
};

/// Where load_map() keeps the map of `style`; empty when there is no place for it.
[[nodiscard]] std::filesystem::path kept_map(const tam::TamStyle& style);

class Hatching final : public Feature {
public:
    /// What strokes follow is numbered by draws, and the coordinates along the form by triangles.
    void invalidate(Event event) override;

    /// Uploads what the strokes of each draw follow. Cost: nothing where that is as before; otherwise linear
    /// in triangles where strokes follow the form.
    void ensure_strokes(gpu::Device& device, const pose::MeshData& layout, const StrokePlan& strokes);

    /// One map per style variant.
    [[nodiscard]] TonalMaps& maps() { return maps_; }

    /// How the surfaces of each style variant are hatched, once their maps are there. Valid until the next
    /// call.
    [[nodiscard]] const std::vector<hatch::LookHatch>& looks(gpu::Graph& graph,
                                                             const std::vector<StyleTables>& styles);

    /// One kind per draw, as shaders/stroke_kind.glsl.h numbers them.
    [[nodiscard]] gpu::Buffer& kinds() { return kinds_; }

    /// Three per triangle, where strokes follow the form.
    [[nodiscard]] gpu::Buffer& form_coordinates() { return form_coordinates_; }

private:
    TonalMaps maps_;
    std::vector<hatch::LookHatch> looks_; ///< its room serves the next frame
    std::vector<uint32_t> kind_of_draw_;  ///< what `kinds_` holds
    gpu::Buffer kinds_;
    gpu::Buffer form_coordinates_;
};

} // namespace estampe::features
