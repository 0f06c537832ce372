// SPDX-License-Identifier: MIT
#pragma once

// How what lives and what burns in the temple is drawn, over any style.

#include <string>

#include <glm/glm.hpp>

#include <estampe/style.hpp>

namespace temple {

/// Sets parameters of a style.
class Setter {
public:
    explicit Setter(estampe::Style& style) : style_(style) {}

    void operator()(const std::string& key, double value) { style_.set(key + "=" + std::to_string(value)); }

    void operator()(const std::string& key, const std::string& value) { style_.set(key + "=" + value); }

    void color(const std::string& key, const glm::vec3& srgb);

private:
    estampe::Style& style_;
};

/// Demons of ink, and the blots that stay behind where they go.
void dress_demons(Setter& set);

/// What the wind carries.
void dress_air(Setter& set);

/// Ink runs from demons, and over the page when they dissolve; of a style that has ink already there is that.
void dress_ink(Setter& set, const estampe::Style& base);

/// What rises from fires, where it is drawn; smoke of a style that has some already is as that says.
void dress_smoke(Setter& set, const estampe::Style& base);

/// What a film has and a picture has not: smoke rises, the lens is sharp at one distance, and the shutter is
/// open while the eye moves. What a style has of these already is as that says.
void dress_film(Setter& set, const estampe::Style& base);

} // namespace temple
