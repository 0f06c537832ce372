// SPDX-License-Identifier: MIT
#pragma once

// Compiles the nodes of a terrain to a program. Coordinate frames are merged into the places at which the
// program evaluates noise and other functions of the coordinates.

#include <algorithm>
#include <array>
#include <cmath>

#include <estampe/terrain.hpp>

#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {

/// Compiles the nodes of a terrain to a program that computes the node "height". Resolves names, merges
/// coordinate transformations into places, evaluates constants, and computes equal expressions only once.
/// Throws the same Errors as Terrain's constructor. Cost: linear in the number of used nodes; reads textures.
[[nodiscard]] Program compile_program(const TerrainDescription& terrain);

/// Cosine and sine of an angle. Cosine and sine are exact for quarter turns. So a form that repeats along an
/// axis stays exact a million metres away.
[[nodiscard]] inline glm::dvec2 cosine_and_sine(double angle_rad)
{
    constexpr double rounding = 1e-15; // largest rounding error of an angle of up to two turns
    const auto exact = [](double value) { return std::abs(value) < rounding ? 0.0 : value; };
    return {exact(std::cos(angle_rad)), exact(std::sin(angle_rad))};
}

/// The coordinates in metres in which a part of a height graph is evaluated. The coordinates are linear
/// functions of x, z and time. A warp may add two values of the program to them.
struct Frame {
    Linear u{.x = 1.0};
    Linear v{.z = 1.0};
    std::array<uint32_t, 2> warp{shared::height_no_register, shared::height_no_register};
    /// Smallest length on the ground, in metres, that corresponds to one metre in the frame.
    double stretch = 1.0;

    /// Key of a frame; equal frames have equal keys.
    using Key = std::array<double, 11>;

    [[nodiscard]] Key key() const
    {
        return {u.x,    u.z, u.t, u.constant, v.x, v.z, v.t, v.constant, double(warp[0]), double(warp[1]),
                stretch};
    }

    [[nodiscard]] bool is_warped() const { return warp[0] != shared::height_no_register; }

    /// Rotates the content of the coordinate frame from x towards z. Does not change the warp.
    [[nodiscard]] Frame turned(double angle_rad) const
    {
        const glm::dvec2 turn = cosine_and_sine(angle_rad);
        const double c = turn.x;
        const double s = turn.y;
        Frame result = *this;
        result.u = {c * u.x + s * v.x, c * u.z + s * v.z, c * u.t + s * v.t, c * u.constant + s * v.constant};
        result.v = {c * v.x - s * u.x, c * v.z - s * u.z, c * v.t - s * u.t, c * v.constant - s * u.constant};
        return result;
    }

    /// Multiplies the coordinates of the frame by `factor`. Does not change the warp.
    [[nodiscard]] Frame scaled(const glm::dvec2& factor) const
    {
        Frame result = *this;
        result.u = times(u, factor.x);
        result.v = times(v, factor.y);
        result.stretch = stretch / std::max(factor.x, factor.y);
        return result;
    }

    /// Moves the content of the coordinate frame by two linear functions of time. Uses only the members `t`
    /// and `constant` of the arguments.
    [[nodiscard]] Frame moved(const Linear& by_u, const Linear& by_v) const
    {
        Frame result = *this;
        result.u.t -= by_u.t;
        result.u.constant -= by_u.constant;
        result.v.t -= by_v.t;
        result.v.constant -= by_v.constant;
        return result;
    }

    [[nodiscard]] PlaceSource place(const glm::dvec2& units_per_m) const
    {
        return {.u = times(u, units_per_m.x),
                .v = times(v, units_per_m.y),
                .period_m = stretch / std::max(units_per_m.x, units_per_m.y),
                .units_per_m = units_per_m};
    }

private:
    static Linear times(const Linear& a, double factor)
    {
        return {a.x * factor, a.z * factor, a.t * factor, a.constant * factor};
    }
};

} // namespace estampe::terrain
