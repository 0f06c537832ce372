// SPDX-License-Identifier: MIT
#include "frame/strokes.hpp"

#include "shaders/stroke_kind.glsl.h"

namespace estampe::frame {
namespace {

uint32_t kind_of(const shared::DrawRecord& draw, uint32_t wanted)
{
    const bool has_uv = (draw.flags & shared::draw_has_uv) != 0;
    const bool usable_uv = (draw.flags & shared::draw_follows_uv) != 0;
    if (wanted == shared::strokes_automatic) {
        return usable_uv ? shared::strokes_uv : shared::strokes_solid;
    }
    return wanted == shared::strokes_uv && !has_uv ? shared::strokes_solid : wanted;
}

} // namespace

StrokePlan plan_strokes(const pose::MeshData& meshes, hatch::Coordinates wanted)
{
    StrokePlan plan;
    plan.kind_of_draw.reserve(meshes.draws.size());
    for (const shared::DrawRecord& draw : meshes.draws) {
        const uint32_t kind = kind_of(draw, static_cast<uint32_t>(wanted));
        plan.kind_of_draw.push_back(kind);
        plan.present |= 1U << kind;
    }
    return plan;
}

} // namespace estampe::frame
