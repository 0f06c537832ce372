// SPDX-License-Identifier: MIT
#include "dress.hpp"

#include <cstdio>

namespace temple {

void Setter::color(const std::string& key, const glm::vec3& srgb)
{
    const glm::ivec3 bytes(glm::round(255.0F * glm::clamp(srgb, 0.0F, 1.0F)));
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", bytes.x, bytes.y, bytes.z);
    style_.set(key + "=" + text);
}

void dress_demons(Setter& set)
{
    // What is of ink is black in every style.
    set("material.demon*.wash.strength", 1.0);
    set("material.demon*.wash.neutral", 1.0);
    set("material.demon*.wash.least", 0.0);
    set("material.demon*.wash.detail", 0.0);
    const std::string wisp = "object.wisp*.particles.";
    set(wisp + "look", "blots");
    set(wisp + "ink", "#0a090d");
    set(wisp + "per_s", 15.0);
    set(wisp + "life_s", 1.7);
    set(wisp + "speed_mps", 0.3);
    set(wisp + "spread_deg", 50.0);
    set(wisp + "lift_mps2", 0.3);
    set(wisp + "swirl_mps", 0.5);
    set(wisp + "swirl_m", 0.8);
    set(wisp + "size_m", 0.34);
    set(wisp + "grown_m", 0.04);
    set(wisp + "opacity", 1.0);
    set(wisp + "soft_m", 0.05);
}

void dress_air(Setter& set)
{
    const std::string sand = "object.sand*.particles.";
    set(sand + "look", "wash");
    set(sand + "per_s", 5.0);
    set(sand + "life_s", 2.6);
    set(sand + "speed_mps", 4.0);
    set(sand + "spread_deg", 25.0);
    set(sand + "lift_mps2", 0.15);
    set(sand + "swirl_mps", 1.4);
    set(sand + "swirl_m", 5.0);
    set(sand + "size_m", 0.8);
    set(sand + "grown_m", 5.5);
    set(sand + "opacity", 0.3);
    set(sand + "soft_m", 1.5);
    set("object.whirl*.particles.look", "drawn");
    set("object.whirl*.particles.opacity", 0.75);
    set("object.murk*.particles.look", "strokes");
    set("object.murk*.particles.ink", "#17141a");
    for (const std::string& whirl :
         {std::string("object.whirl*.particles."), std::string("object.murk*.particles.")}) {
        set(whirl + "per_s", 13.0);
        set(whirl + "life_s", 1.5);
        set(whirl + "speed_mps", 11.0);
        set(whirl + "spread_deg", 14.0);
        set(whirl + "lift_mps2", 1.2);
        set(whirl + "swirl_mps", 1.5);
        set(whirl + "swirl_m", 6.0);
        set(whirl + "size_m", 1.4);
        set(whirl + "grown_m", 6.0);
        set(whirl + "soft_m", 1.0);
    }
}

void dress_ink(Setter& set, const estampe::Style& base)
{
    if (base.number("ink.drawn") != 0.0) {
        return;
    }
    set("ink.drawn", "true");
    set("ink.source", "things");
    set("ink.objects", R"("body of demon*")");
    set("ink.zones", R"("stain*=give:0.6 turn:12, eddy*=turn:110")");
    set("ink.color", "#0b0a0e");
    set("ink.thin_color", "#2b2830");
    set("ink.spot_mm", 0.9);
    set("ink.spacing_mm", 4.2);
    set("ink.amount_per_s", 22.0);
    set("ink.spot_s", 1.5);
    set("ink.life_s", 1.7);
    set("ink.soak", 0.12);
    set("ink.stain_s", 7.0);
    set("ink.swirl_mm", 34.0);
    set("ink.swirl_mm_s", 12.0);
    set("ink.sharpness", 0.8);
}

void dress_smoke(Setter& set, const estampe::Style& base)
{
    if (base.number("smoke.drawn") != 0.0) {
        return;
    }
    // A slender column that one sees through: puffs over a bowl on a foot would be a tree.
    set("smoke.cells", "64");
    set("smoke.puffs", "false");
    set("smoke.age_s", 3.0);
    set("smoke.source", 0.15);
    set("smoke.amount_per_s", 5.0);
    set("smoke.rise_s", 1.2);
    set("smoke.life_s", 2.6);
    set("smoke.curl", 0.2);
    set("smoke.thickness", 4.0);
    set("smoke.medium", "wash");
    set("smoke.opacity", 0.6);
    set("smoke.color", "#e0d2b6");
    set("smoke.shade_color", "#ab9e86");
    set("smoke.deep_color", "#7b7264");
    set("smoke.shade_below", 0.25);
    set("smoke.deep_below", 0.08);
    set("smoke.line_mm", 0.16);
}

void dress_film(Setter& set, const estampe::Style& base)
{
    set("smoke.drawn", "true");
    if (base.text("lens.mode") == "none") {
        // As wide as leaves all of a room sharp but what is close to the eye, and what is far a little soft.
        set("lens.mode", "gather");
        set("lens.focus_m", 8.0);
        set("lens.f_number", 2.8);
        set("lens.largest_mm", 3.0);
    }
    if (base.text("motion_blur.mode") == "none") {
        set("motion_blur.mode", "tiles");
        set("motion_blur.shutter_deg", 60.0);
        set("motion_blur.largest_mm", 4.0);
    }
}

} // namespace temple
