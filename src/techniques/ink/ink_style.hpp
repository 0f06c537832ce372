// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/read_scope.hpp>

#include "shaders/shared.hpp"
#include "style/parameter.hpp"

namespace estampe::ink {

/// The thing that flowing ink moves with when the camera moves.
enum class Follow : uint8_t {
    page,
    turn,    ///< the background at infinity, which turns with the camera
    advance, ///< a plane in front of the eye, which grows as the camera advances
    around,  ///< fixed directions of the scene: ink lies on a cube around the eye
    surface  ///< the surface on which the ink lies
};

enum class Source : uint8_t { strokes, light, things };

/// How the pressure of simulated water is computed.
enum class Solver : uint8_t { automatic, multigrid, jacobi, mass };

/// The flow of ink in a zone around an object that has no mesh.
struct ZoneStyle {
    float blow_mm_per_s = 0.0F; ///< speed of the flow along the object's -z axis
    float turn_deg_per_s = 0.0F;
    float give = 0.0F;
    float amount = 1.0F;
};

struct InkStyle {
    bool enabled = false;
    Follow follow = Follow::surface;
    Source source = Source::strokes;
    std::string objects = "*";
    float threshold = 0.5F;
    float amount_per_s = 40.0F;
    float spot_mm = 1.1F;
    float spacing_mm = 6.5F;
    float spot_s = 4.0F;
    float wind_mm_per_s = 18.0F;
    float wind_deg = 12.0F;
    float swirl_mm = 60.0F;
    float swirl_mm_per_s = 11.0F;
    float turn_s = 5.0F;
    float solved = 0.0F;
    Solver solver = Solver::automatic;
    uint32_t jacobi_passes = 80;
    std::string flow_map;
    ReadScope scope; ///< Limits the files that the style may name; no parameter
    float flow_mm_per_s = 15.0F;
    float drag = 0.5F;
    ZoneStyle zone; ///< default settings of every zone
    float life_s = 3.0F;
    float soak = 0.15F;
    float stain_s = 8.0F;
    glm::vec3 color = style::srgb(0x0c1a48);
    glm::vec3 thin_color = style::srgb(0x1c4cb8);
    float opacity = 1.0F;
    float sharpness = 0.9F;
    float edge = 0.05F;
    float granulation = 0.4F;
    float budget = 0.15F;
    bool spills = false;
    float age_s = 4.0F;
    float steps_per_s = 24.0F;
    float cell_mm = 0.2F;
    float oversize = 1.25F;
    int seed = 1;
};

[[nodiscard]] const style::Table<InkStyle>& ink_table();

} // namespace estampe::ink
