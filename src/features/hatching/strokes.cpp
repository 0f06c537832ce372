// SPDX-License-Identifier: MIT
#include "features/hatching/strokes.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "shaders/stroke_kind.glsl.h"
#include "style/name_lists.hpp"
#include "style/raw.hpp"

namespace estampe::features {
namespace {

constexpr const char* materials_key = "hatch.materials";

/// The kind that `hatch.coordinates` calls `name`.
uint32_t kind_named(const std::string& name)
{
    const auto& parameters = hatch::hatch_table().parameters();
    const auto wanted = std::find_if(parameters.begin(), parameters.end(),
                                     [](const auto& parameter) { return parameter.key == "coordinates"; });
    if (std::find(wanted->choices.begin(), wanted->choices.end(), name) == wanted->choices.end()) {
        throw Error(fmt::format("strokes cannot follow {}", style::in_quotes(name)), materials_key,
                    fmt::format("allowed: {}", style::allowed(*wanted)));
    }
    hatch::HatchStyle style;
    wanted->set(&style, style::Value(name));
    return static_cast<uint32_t>(style.coordinates);
}

/// What single materials follow, by their number.
std::map<Index, uint32_t> kinds_of_materials(const std::vector<Material>& materials, std::string_view text)
{
    std::map<Index, uint32_t> kinds;
    if (text.empty()) {
        return kinds;
    }
    for (const style::Assignment& part :
         style::assignments(text, materials_key, "material=kind", "Skin=form, Sea=wind")) {
        const uint32_t kind = kind_named(part.value);
        std::vector<std::string> names;
        bool is_known = false;
        for (Index i = 0; i < materials.size(); ++i) {
            names.push_back(materials[i].name);
            if (materials[i].name == part.name) {
                kinds[i] = kind;
                is_known = true;
            }
        }
        if (!is_known) {
            style::fail_unknown("the scene has no material", part.name, materials_key, names);
        }
    }
    return kinds;
}

enum class GroundForm : uint8_t { no, level, dunes };

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

const StyleTables& look_of(const LookPlan& looks, size_t draw)
{
    return looks.has_several() ? looks.styles[looks.look_of_draw[draw]] : looks.styles.front();
}

} // namespace

StrokePlan plan_strokes(const pose::MeshData& meshes, const std::vector<Material>& materials,
                        const LookPlan& looks, std::vector<uint32_t> room)
{
    const std::map<Index, uint32_t> kinds =
        kinds_of_materials(materials, looks.styles.front().hatch.materials);
    StrokePlan plan{.kind_of_draw = std::move(room)};
    plan.kind_of_draw.clear();
    plan.kind_of_draw.reserve(meshes.draws.size());
    for (const shared::DrawRecord& draw : meshes.draws) {
        const auto own = kinds.find(draw.material);
        const auto of_look =
            static_cast<uint32_t>(look_of(looks, plan.kind_of_draw.size()).hatch.coordinates);
        const uint32_t wanted = own != kinds.end() ? own->second : of_look;
        const uint32_t kind = possible(wanted, draw, ground_of(meshes, plan.kind_of_draw.size()));
        plan.kind_of_draw.push_back(kind);
        plan.present |= 1U << kind;
    }
    return plan;
}

std::optional<shadow::HatchedLines> hatched_lines(const hatch::HatchStyle& style,
                                                  const glm::vec3& towards_light, const StrokePlan& strokes)
{
    if (!style.drawn || style.strokes != hatch::Strokes::lines) {
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

} // namespace estampe::features
