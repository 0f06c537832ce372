// SPDX-License-Identifier: MIT
#include "techniques/ink/flow/flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <estampe/image.hpp>

#include "core/hash.hpp"

namespace estampe::ink {
namespace {

/// A pseudo-random number, 0 to 1, for each combination of seed, wave and number.
double random(int seed, size_t wave, int number)
{
    Hash hash;
    hash.add(seed);
    hash.add(static_cast<uint64_t>(wave));
    hash.add(number);
    return static_cast<double>(hash.value() >> 11U) * 0x1p-53;
}

/// A plane wave of the ink's stream function, before its amplitude is scaled.
struct PlaneWave {
    double angle_rad = 0.0;
    double turns_per_mm = 1.0;
    double amplitude = 1.0;
    double phase = 0.0;
    double turns_per_s = 0.0;
};

/// Makes one of the waves that move the ink. Waves come in three sizes, with two crossing waves of each size;
/// smaller waves flow slower and change sooner.
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
    double square = 0.0; // mean square of the velocity of all waves
    for (size_t i = 0; i < waves.size(); ++i) {
        waves.at(i) = plane_wave(style, i);
        const double speed = 2.0 * std::numbers::pi * waves.at(i).amplitude * waves.at(i).turns_per_mm;
        square += 0.5 * speed * speed;
    }
    for (PlaneWave& wave : waves) {
        wave.amplitude *= static_cast<double>(style.swirl_mm_per_s) / std::sqrt(square);
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
                glm::vec2 wind_mm_per_s, glm::vec2 place_mm)
{
    float stream = wind_mm_per_s.x * place_mm.y - wind_mm_per_s.y * place_mm.x;
    for (size_t i = 0; i < waves.size(); ++i) {
        const shared::InkWave& wave = waves.at(i).wave;
        stream += wave.amplitude * std::sin(2.0F * static_cast<float>(std::numbers::pi) *
                                            (glm::dot(glm::vec2(wave.wave), place_mm) + phases.at(i)));
    }
    return stream;
}

glm::vec2 wind_mm_per_s(const InkStyle& style)
{
    const float angle = glm::radians(style.wind_deg);
    return style.wind_mm_per_s * glm::vec2(std::cos(angle), -std::sin(angle));
}

// Flow maps (pictures of velocities), and the stream functions that are fitted to them.

std::vector<glm::vec2> read_flow(const std::string& path, const ReadScope& scope)
{
    const Image picture = load_image(path, scope);
    constexpr uint32_t side = shared::ink_map_side;
    std::vector<glm::vec2> velocities;
    velocities.reserve(size_t{side} * side);
    for (uint32_t row = 0; row < side; ++row) {
        for (uint32_t column = 0; column < side; ++column) {
            const size_t x = std::min<size_t>(size_t{column} * picture.width / (side - 1), picture.width - 1);
            const size_t y = std::min<size_t>(size_t{row} * picture.height / (side - 1), picture.height - 1);
            const uint8_t* const texel = picture.rgba.data() + 4 * (y * picture.width + x);
            velocities.push_back((glm::vec2(texel[0], texel[1]) - 128.0F) / 127.0F);
        }
    }
    return velocities;
}

namespace {

/// Fits the differences of the stream function psi along the grid's edges to the wanted velocities: least
/// squares by conjugate gradients.
class StreamSolver {
public:
    StreamSolver(const std::vector<glm::vec2>& velocities, glm::dvec2 step_mm) : step_mm_(step_mm)
    {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const glm::dvec2 here(velocities.at(place(x, y)));
                if (x + 1 < side) {
                    const double down =
                        0.5 * (here.y + static_cast<double>(velocities.at(place(x + 1, y)).y));
                    add_edge(place(x, y), place(x + 1, y), -down / step_mm_.x, target_);
                }
                if (y + 1 < side) {
                    const double right =
                        0.5 * (here.x + static_cast<double>(velocities.at(place(x, y + 1)).x));
                    add_edge(place(x, y), place(x, y + 1), right / step_mm_.y, target_);
                }
            }
        }
    }

    [[nodiscard]] std::vector<float> solve() const
    {
        std::vector<double> psi(count, 0.0);
        std::vector<double> residual = target_;
        std::vector<double> direction = residual;
        double square = dot(residual, residual);
        const double enough = 1e-12 * square;
        for (int i = 0; i < most_rounds && square > enough; ++i) {
            const std::vector<double> applied = laplacian(direction);
            const double length = square / dot(direction, applied);
            for (size_t k = 0; k < count; ++k) {
                psi[k] += length * direction[k];
                residual[k] -= length * applied[k];
            }
            const double next = dot(residual, residual);
            for (size_t k = 0; k < count; ++k) {
                direction[k] = residual[k] + next / square * direction[k];
            }
            square = next;
        }
        return {psi.begin(), psi.end()};
    }

private:
    static constexpr int side = static_cast<int>(shared::ink_map_side);
    static constexpr size_t count = size_t{shared::ink_map_side} * shared::ink_map_side;
    static constexpr int most_rounds = 400;

    static size_t place(int x, int y) { return static_cast<size_t>(y) * side + static_cast<size_t>(x); }

    static void add_edge(size_t from, size_t to, double flow, std::vector<double>& sums)
    {
        sums[from] -= flow;
        sums[to] += flow;
    }

    static double dot(const std::vector<double>& a, const std::vector<double>& b)
    {
        double sum = 0.0;
        for (size_t k = 0; k < count; ++k) {
            sum += a[k] * b[k];
        }
        return sum;
    }

    [[nodiscard]] std::vector<double> laplacian(const std::vector<double>& psi) const
    {
        std::vector<double> sums(count, 0.0);
        const glm::dvec2 weight = 1.0 / (step_mm_ * step_mm_);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                if (x + 1 < side) {
                    add_edge(place(x, y), place(x + 1, y),
                             weight.x * (psi[place(x + 1, y)] - psi[place(x, y)]), sums);
                }
                if (y + 1 < side) {
                    add_edge(place(x, y), place(x, y + 1),
                             weight.y * (psi[place(x, y + 1)] - psi[place(x, y)]), sums);
                }
            }
        }
        return sums;
    }

    glm::dvec2 step_mm_;
    std::vector<double> target_ = std::vector<double>(count, 0.0);
};

} // namespace

std::vector<float> stream_of_flow(const std::vector<glm::vec2>& velocities, glm::vec2 page_mm)
{
    return StreamSolver(velocities, glm::dvec2(page_mm) / static_cast<double>(shared::ink_map_side - 1))
        .solve();
}

} // namespace estampe::ink
