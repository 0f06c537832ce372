// SPDX-License-Identifier: MIT
#include "features/hatching/hatching.hpp"

#include <algorithm>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "gpu/resources.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "style/schema.hpp"
#include "techniques/form/form.hpp"
#include "techniques/tam/files/map_files.hpp"
#include "techniques/tam/maker.hpp"

namespace estampe::features {
namespace {

enum class GroundForm : uint8_t { no, level, dunes };

// The most vertices, of all draw calls together, for which coordinates along the form are computed unless the
// style asks for them: about 3 s on two threads.
constexpr uint32_t most_form_vertices = 150'000;

uint32_t possible(uint32_t wanted, const shared::DrawRecord& draw, GroundForm ground)
{
    const bool has_uv = (draw.flags & shared::draw_has_uv) != 0;
    const bool usable_uv = (draw.flags & shared::draw_follows_uv) != 0;
    const uint32_t without_uv = ground == GroundForm::dunes ? shared::strokes_slope : shared::strokes_solid;
    switch (wanted) {
    case shared::strokes_automatic:
        return usable_uv ? shared::strokes_uv : without_uv;
    case shared::strokes_uv:
        return has_uv ? wanted : without_uv;
    case shared::strokes_form:
        return ground == GroundForm::no ? wanted : without_uv;
    default:
        return wanted;
    }
}

GroundForm ground_of(const pose::MeshData& meshes, size_t draw)
{
    if (meshes.foreign_vertex && meshes.draw_of_vertex[*meshes.foreign_vertex] == draw) {
        return GroundForm::dunes;
    }
    return draw == meshes.sources.size() ? GroundForm::level : GroundForm::no;
}

bool has_strokes(const hatch::HatchStyle& style)
{
    return style.enabled && style.strokes != hatch::Strokes::dots;
}

const StyleTables& style_of(const StyleVariants& variants, size_t draw)
{
    return variants.has_several() ? variants.styles[variants.variant_of_draw[draw]] : variants.styles.front();
}

} // namespace

StrokePlan plan_strokes(const pose::MeshData& meshes, const StyleVariants& variants,
                        std::vector<uint32_t> room)
{
    StrokePlan plan{.kind_of_draw = std::move(room)};
    plan.kind_of_draw.clear();
    plan.kind_of_draw.reserve(meshes.draws.size());
    uint32_t form_vertices = 0;
    for (const shared::DrawRecord& draw : meshes.draws) {
        const hatch::HatchStyle& style = style_of(variants, plan.kind_of_draw.size()).hatch;
        auto wanted = static_cast<uint32_t>(style.coordinates);
        if (style.coordinates == hatch::Coordinates::automatic && has_strokes(style) &&
            (draw.flags & shared::draw_is_round) != 0 && (draw.flags & shared::draw_is_foliage) == 0 &&
            form_vertices + draw.vertex_count <= most_form_vertices) {
            wanted = shared::strokes_form;
            form_vertices += draw.vertex_count;
        }
        const GroundForm ground = ground_of(meshes, plan.kind_of_draw.size());
        if (ground != GroundForm::no) {
            plan.ground_draws[ground == GroundForm::dunes ? 1 : 0] =
                static_cast<uint32_t>(plan.kind_of_draw.size());
        }
        plan.has_causes = plan.has_causes || (style.enabled && hatch::needs_causes(style));
        const uint32_t kind = possible(wanted, draw, ground);
        plan.kind_of_draw.push_back(kind);
        plan.present |= 1U << kind;
    }
    return plan;
}

std::optional<shadow::HatchedLines> hatched_lines(const hatch::HatchStyle& style,
                                                  const glm::vec3& towards_light, const StrokePlan& strokes)
{
    if (!style.enabled || style.strokes != hatch::Strokes::lines) {
        return std::nullopt;
    }
    const hatch::FirstLayer layer = hatch::first_layer(style);
    return shadow::HatchedLines{.width_mm = layer.width_mm,
                                .darkness = layer.darkness,
                                .seed = layer.seed,
                                .flat_axis = layer.flat_axis,
                                .wind = layer.wind,
                                .ground_wind = strokes.ground_wind,
                                .towards_light = towards_light,
                                .has_directions = strokes.has_directions()};
}

namespace {

struct DrawTriangles {
    std::vector<uint32_t> indices; ///< Vertices of the triangles, as indices of the draw call's vertices
    std::vector<size_t> numbers;
};

} // namespace

std::vector<glm::vec2> form_coordinates(const pose::MeshData& meshes, const StrokePlan& plan)
{
    std::map<uint32_t, DrawTriangles> draws;
    for (size_t i = 0; i < meshes.triangles.size(); ++i) {
        const glm::uvec4& triangle = meshes.triangles[i];
        const uint32_t draw = triangle.w & shared::triangle_draw_mask;
        if (plan.kind_of_draw[draw] == shared::strokes_form) {
            DrawTriangles& own = draws[draw];
            for (int k = 0; k < 3; ++k) {
                own.indices.push_back(triangle[k] - meshes.draws[draw].first_posed_vertex);
            }
            own.numbers.push_back(i);
        }
    }
    std::vector<glm::vec2> coordinates(3 * meshes.triangles.size());
    const auto unit_m = static_cast<float>(meshes.stroke_unit_m);
    for (const auto& [index, own] : draws) {
        const shared::DrawRecord& draw = meshes.draws[index];
        std::vector<glm::vec3> positions_m;
        for (uint32_t i = 0; i < draw.vertex_count; ++i) {
            positions_m.push_back(meshes.stroke_coordinates[draw.first_posed_vertex + i] * unit_m);
        }
        const form::FormField field = form::follow_form(
            positions_m, own.indices, {.period_m = 0.25F * unit_m, .most_singular_share = 0.02F});
        for (size_t i = 0; i < own.numbers.size(); ++i) {
            std::copy(field.corners[i].begin(), field.corners[i].end(),
                      coordinates.begin() + static_cast<std::ptrdiff_t>(3 * own.numbers[i]));
        }
    }
    return coordinates;
}

namespace {

tam::TonalArtMap drawn_or_kept(const tam::TamStyle& style)
{
    const std::filesystem::path path = kept_map(style);
    // Other users could write files into a folder that is not private, for this program to decode.
    const auto may_use_folder = [&] {
        return !path.empty() && fault_of_private_folder(path.parent_path()).empty();
    };
    std::error_code missing;
    if (may_use_folder() && std::filesystem::exists(path, missing)) {
        try {
            return tam::load_tam(path, ReadScope::beside(path));
        } catch (const Error&) {
            // A damaged cache file is ignored: the tonal art map is drawn and written again below.
        }
    }
    tam::TonalArtMap map = tam::make_map(style);
    if (!path.empty()) {
        try {
            make_private_folder(path.parent_path());
            if (may_use_folder()) {
                tam::save_tam(map, path);
            }
        } catch (const std::exception&) {
            // On a full or read-only disk the tonal art map is not cached, and is drawn again next time.
        }
    }
    return map;
}

} // namespace

MapChoice map_choice(const StyleTables& style)
{
    return {.file = style.hatch.map,
            .scope = style.hatch.scope,
            .drawn = style.tam,
            .tone = style.hatch.map_tone,
            .contrast = style.hatch.map_contrast};
}

std::filesystem::path kept_map(const tam::TamStyle& style)
{
    const std::filesystem::path folder = user_cache_folder();
    if (folder.empty()) {
        return {};
    }
    Hash hash;
    hash.add_text(style::Schema(tam::tam_table()).to_toml(style));
    hash.add(style.seed); // The table does not contain `seed`, because the seed is set by drawing.seed
    return folder / "estampe" / fmt::format("map-{}-{:016x}.tam", tam::drawing_version, hash.value());
}

hatch::MapData load_map(const MapChoice& choice)
{
    tam::TonalArtMap map =
        choice.file.empty() ? drawn_or_kept(choice.drawn) : tam::read_map(choice.file, choice.scope).map;
    std::vector<std::vector<uint8_t>> thresholds = tam::threshold_levels(map);
    return {.size_px = map.size_px,
            .level_of_tone = std::move(map.level_of_tone),
            .threshold_of_level = std::move(thresholds)};
}

void TonalMaps::ensure(gpu::Device& device, const std::vector<StyleTables>& variants)
{
    place_of_variant_.assign(variants.size(), std::nullopt);
    std::vector<Loaded> wanted;
    for (size_t variant = 0; variant < variants.size(); ++variant) {
        const hatch::HatchStyle& hatch = variants[variant].hatch;
        if (!hatch.enabled || hatch.strokes != hatch::Strokes::map) {
            continue;
        }
        MapChoice choice = map_choice(variants[variant]);
        const auto is_choice = [&](const Loaded& loaded) { return loaded.choice == choice; };
        const auto ready = std::ranges::find_if(wanted, is_choice);
        place_of_variant_[variant] = static_cast<size_t>(ready - wanted.begin());
        if (ready != wanted.end()) {
            continue;
        }
        if (const auto kept = std::ranges::find_if(maps_, is_choice); kept != maps_.end()) {
            wanted.push_back(std::move(*kept));
            maps_.erase(kept);
        } else {
            hatch::MapImages images =
                hatch::upload_map(device, load_map(choice), choice.tone, choice.contrast);
            wanted.push_back({std::move(choice), std::move(images)});
        }
    }
    maps_ = std::move(wanted);
}

void Hatching::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::layout_replaced) {
        kind_of_draw_.clear();
    }
}

const std::vector<hatch::HatchVariant>& Hatching::variants(gpu::Graph& graph,
                                                           const std::vector<StyleTables>& styles)
{
    variants_.clear();
    for (const StyleTables& style : styles) {
        hatch::MapImages* const map = maps_.of_variant(variants_.size());
        variants_.push_back(
            {.style = style.hatch,
             .tone = light::tone_constants(style.tone),
             .map = map != nullptr ? std::optional(hatch::import_map(graph, *map)) : std::nullopt});
    }
    return variants_;
}

void Hatching::ensure_strokes(gpu::Device& device, const pose::MeshData& layout, const StrokePlan& strokes)
{
    if (kind_of_draw_ == strokes.kind_of_draw) {
        return;
    }
    kinds_ = gpu::upload_buffer(device, "stroke kinds", strokes.kind_of_draw);
    form_coordinates_ =
        gpu::upload_buffer(device, "form coordinates",
                           strokes.has(shared::strokes_form) ? features::form_coordinates(layout, strokes)
                                                             : std::vector<glm::vec2>());
    kind_of_draw_ = strokes.kind_of_draw;
}

} // namespace estampe::features
