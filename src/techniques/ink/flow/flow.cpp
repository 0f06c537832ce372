// SPDX-License-Identifier: MIT
#include "techniques/ink/flow/flow.hpp"

#include <cmath>
#include <numbers>

#include "core/hash.hpp"

namespace estampe::ink {
namespace {

/// 0 to 1, another for each number.
double random(int seed, size_t wave, int number)
{
    Hash hash;
    hash.add(seed);
    hash.add(static_cast<uint64_t>(wave));
    hash.add(number);
    return static_cast<double>(hash.value() >> 11U) * 0x1p-53;
}

/// A wave in the plane, whose amplitude is yet to be scaled.
struct PlaneWave {
    double angle_rad = 0.0;
    double turns_per_mm = 1.0;
    double amplitude = 1.0;
    double phase = 0.0;
    double turns_per_s = 0.0;
};

/// Three sizes of two waves each that cross: the smaller, the slower the flow and the sooner it changes.
PlaneWave plane_wave(const InkStyle& style, size_t i)
{
    constexpr double golden_turn = 0.618034;
    constexpr double size_step = 2.0;
    constexpr double speed_step = 1.3;
    const size_t pair = i / 2;
    const auto octave = static_cast<double>(pair);
    const double length_mm = static_cast<double>(style.swirl_mm) * std::pow(size_step, -octave) *
                             (0.85 + 0.3 * random(style.seed, i, 0));
    const double period_s = static_cast<double>(style.turn_s) * (0.7 + 0.6 * random(style.seed, i, 1)) *
                            std::sqrt(length_mm / static_cast<double>(style.swirl_mm));
    return {.angle_rad =
                std::numbers::pi * (golden_turn * static_cast<double>(i) + 0.2 * random(style.seed, i, 2)),
            .turns_per_mm = 1.0 / length_mm,
            .amplitude = std::pow(speed_step, -octave) * length_mm / (2.0 * std::numbers::pi),
            .phase = random(style.seed, i, 3),
            .turns_per_s = (i % 2 == 0 ? 1.0 : -1.0) / period_s};
}

std::array<PlaneWave, shared::ink_wave_count> plane_waves(const InkStyle& style)
{
    std::array<PlaneWave, shared::ink_wave_count> waves;
    double square = 0.0; // of the velocity, on average
    for (size_t i = 0; i < waves.size(); ++i) {
        waves.at(i) = plane_wave(style, i);
        const double speed = 2.0 * std::numbers::pi * waves.at(i).amplitude * waves.at(i).turns_per_mm;
        square += 0.5 * speed * speed;
    }
    for (PlaneWave& wave : waves) {
        wave.amplitude *= static_cast<double>(style.swirl_mm_s) / std::sqrt(square);
    }
    return waves;
}

} // namespace

Waves page_waves(const InkStyle& style)
{
    Waves waves;
    const auto plane = plane_waves(style);
    for (size_t i = 0; i < waves.size(); ++i) {
        const glm::dvec2 along(std::cos(plane.at(i).angle_rad), std::sin(plane.at(i).angle_rad));
        waves.at(i) = {.wave = {.wave = glm::vec3(plane.at(i).turns_per_mm * along, 0.0),
                                .amplitude = static_cast<float>(plane.at(i).amplitude)},
                       .phase = plane.at(i).phase,
                       .turns_per_s = plane.at(i).turns_per_s};
    }
    return waves;
}

Waves sphere_waves(const InkStyle& style, float mm_per_rad)
{
    Waves waves;
    const auto plane = plane_waves(style);
    const auto scale = static_cast<double>(mm_per_rad);
    for (size_t i = 0; i < waves.size(); ++i) {
        const double height = 2.0 * random(style.seed, i, 4) - 1.0;
        const double level = std::sqrt(1.0 - height * height);
        const double around = 2.0 * std::numbers::pi * random(style.seed, i, 5);
        const glm::dvec3 along(level * std::cos(around), height, level * std::sin(around));
        waves.at(i) = {.wave = {.wave = glm::vec3(scale * plane.at(i).turns_per_mm * along),
                                .amplitude = static_cast<float>(plane.at(i).amplitude / (scale * scale))},
                       .phase = plane.at(i).phase,
                       .turns_per_s = plane.at(i).turns_per_s};
    }
    return waves;
}

std::array<float, shared::ink_wave_count> phases_at(const Waves& waves, double time_s)
{
    std::array<float, shared::ink_wave_count> phases{};
    for (size_t i = 0; i < waves.size(); ++i) {
        const double turns = waves.at(i).phase + waves.at(i).turns_per_s * time_s;
        phases.at(i) = static_cast<float>(turns - std::floor(turns));
    }
    return phases;
}

float stream_at(const Waves& waves, const std::array<float, shared::ink_wave_count>& phases,
                glm::vec2 wind_mm_s, glm::vec2 place_mm)
{
    float stream = wind_mm_s.x * place_mm.y - wind_mm_s.y * place_mm.x;
    for (size_t i = 0; i < waves.size(); ++i) {
        const shared::InkWave& wave = waves.at(i).wave;
        stream += wave.amplitude * std::sin(2.0F * static_cast<float>(std::numbers::pi) *
                                            (glm::dot(glm::vec2(wave.wave), place_mm) + phases.at(i)));
    }
    return stream;
}

glm::vec2 wind_mm_s(const InkStyle& style)
{
    const float angle = glm::radians(style.wind_deg);
    return style.wind_mm_s * glm::vec2(std::cos(angle), -std::sin(angle));
}

} // namespace estampe::ink
