// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/read_scope.hpp>

#include "style/parameter.hpp"
#include "style/wind.hpp"

namespace estampe::particles {

enum class Look : uint8_t { drawn, wash, blots, strokes };

struct ParticleStyle {
    std::string emitters = "emitter*";
    Look look = Look::drawn;
    float per_s = 8.0F;
    float life_s = 6.0F;
    float speed_m_per_s = 1.5F;
    float spread_deg = 12.0F;
    float lift_m_per_s2 = 0.0F;
    float wind_m_per_s = 0.8F;
    wind::Wind wind; ///< wind of the scene's section [wind]; the section of particles has no key for it
    float swirl_m_per_s = 0.6F;
    float swirl_m = 2.0F;
    float size_m = 0.5F;
    float grown_m = 2.2F;
    std::string sheet;
    ReadScope scope; ///< Limits the files that the style may name; no parameter
    int rows = 1;
    int columns = 1;
    glm::vec3 color = style::srgb(0xf4efe4);
    float opacity = 0.8F;
    float outline_mm = 0.35F;
    glm::vec3 ink = style::srgb(0x1c1a20);
    float soft_m = 0.6F;
    int seed = 1;
};

[[nodiscard]] const style::Table<ParticleStyle>& particle_table();

} // namespace estampe::particles
