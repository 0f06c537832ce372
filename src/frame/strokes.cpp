// SPDX-License-Identifier: MIT
#include "frame/strokes.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "frame/assignments.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "style/raw.hpp"
#include "techniques/form/form.hpp"

namespace estampe::frame {
namespace {

constexpr const char* key = "hatch.materials";

/// The kind that `hatch.coordinates` calls `name`.
uint32_t kind_named(const std::string& name)
{
    const auto& parameters = hatch::hatch_table().parameters();
    const auto wanted = std::find_if(parameters.begin(), parameters.end(),
                                     [](const auto& parameter) { return parameter.key == "coordinates"; });
    if (std::find(wanted->choices.begin(), wanted->choices.end(), name) == wanted->choices.end()) {
        throw Error(fmt::format("strokes cannot follow {}", style::in_quotes(name)), key,
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
    for (const Assignment& part : assignments(text, key, "material=kind", "Skin=form, Sea=wind")) {
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
            fail_unknown("the scene has no material", part.name, key, names);
        }
    }
    return kinds;
}

uint32_t possible(uint32_t wanted, const shared::DrawRecord& draw, bool is_ground)
{
    const bool has_uv = (draw.flags & shared::draw_has_uv) != 0;
    const bool usable_uv = (draw.flags & shared::draw_follows_uv) != 0;
    switch (wanted) {
    case shared::strokes_automatic:
        return usable_uv ? shared::strokes_uv : shared::strokes_solid;
    case shared::strokes_uv:
        return has_uv ? wanted : shared::strokes_solid;
    case shared::strokes_form:
        return is_ground ? shared::strokes_solid : wanted;
    default:
        return wanted;
    }
}

/// Triangles of one draw, and where they stand among all.
struct DrawTriangles {
    std::vector<uint32_t> indices; ///< into the vertices of the draw
    std::vector<size_t> numbers;
};

} // namespace

StrokePlan plan_strokes(const pose::MeshData& meshes, const std::vector<Material>& materials,
                        const hatch::HatchStyle& style)
{
    const std::map<Index, uint32_t> kinds = kinds_of_materials(materials, style.materials);
    StrokePlan plan;
    plan.kind_of_draw.reserve(meshes.draws.size());
    for (const shared::DrawRecord& draw : meshes.draws) {
        const auto own = kinds.find(draw.material);
        const uint32_t wanted = own != kinds.end() ? own->second : static_cast<uint32_t>(style.coordinates);
        const bool is_ground = plan.kind_of_draw.size() == meshes.sources.size();
        const uint32_t kind = possible(wanted, draw, is_ground);
        plan.kind_of_draw.push_back(kind);
        plan.present |= 1U << kind;
    }
    return plan;
}

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
        const form::FormField field =
            form::follow_form(positions_m, own.indices, {.period_m = 0.25F * unit_m});
        for (size_t i = 0; i < own.numbers.size(); ++i) {
            std::copy(field.corners[i].begin(), field.corners[i].end(),
                      coordinates.begin() + static_cast<std::ptrdiff_t>(3 * own.numbers[i]));
        }
    }
    return coordinates;
}

} // namespace estampe::frame
