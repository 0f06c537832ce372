// SPDX-License-Identifier: MIT
#pragma once

// Random numbers, and a kit of shapes. Each shape has one material; shapes are collected into meshes.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>
#include <estampe/shapes.hpp>

namespace temple {

using estampe::shapes::at;
using estampe::shapes::rod;

/// Random numbers that are equal on every machine: SplitMix64 (Steele et al., "Fast splittable pseudorandom
/// number generators", 2014). The standard library's distributions would differ between implementations.
class Dice {
public:
    /// Starts the random numbers of one `part` of a seed. Each part of the temple has its own random numbers,
    /// so that a change of one part leaves all other parts unchanged.
    explicit Dice(uint64_t seed, uint64_t part = 0) : state_(mixed(seed) ^ mixed(~part)) {}

    [[nodiscard]] uint64_t number()
    {
        state_ += 0x9e3779b97f4a7c15U;
        return mixed(state_);
    }

    /// Returns a uniform random number from 0 inclusive to 1 exclusive.
    [[nodiscard]] float share() { return static_cast<float>(number() >> 40U) * 0x1p-24F; }

    [[nodiscard]] float between(float low, float high) { return low + (high - low) * share(); }

    /// Returns a uniform random whole number from 0 to count - 1.
    [[nodiscard]] int below(int count) { return static_cast<int>(share() * static_cast<float>(count)); }

    [[nodiscard]] bool chance(float of_one) { return share() < of_one; }

private:
    [[nodiscard]] static uint64_t mixed(uint64_t bits)
    {
        bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
        bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
        return bits ^ (bits >> 31U);
    }

    uint64_t state_;
};

enum class Stuff : estampe::Index { stone, paving, marble, dark, iron, flame, red };

/// Returns the temple's materials, in the order of the enum Stuff.
[[nodiscard]] std::vector<estampe::Material> materials();

/// Direction of the pen strokes on a flat face. Strokes run along the unit vector `along`; the unit vector
/// `up` points to their left.
struct Grain {
    glm::vec3 along{1.0F, 0.0F, 0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    /// Shift of the strokes. The shift differs between stones, so that the strokes of neighbouring stones do
    /// not line up.
    glm::vec2 offset_m{0.0F};
};

/// Collects the shapes of one object. For some faces it stores which edges a pen would draw.
class Kit : public estampe::shapes::MeshBuilder {
public:
    /// Adds a convex flat face, counter-clockwise from outside. Draws the edge from corner k to the next
    /// corner exactly if bit k of `drawn` is set. The shading normal may differ from the face's normal.
    void add_face(Stuff stuff, std::span<const glm::vec3> corners, const glm::vec3& normal,
                  const Grain& grain, uint32_t drawn);
};

/// Adds a block with its opposite corners at `low` and `high`.
void add_block(Kit& kit, Stuff stuff, const glm::vec3& low, const glm::vec3& high);

} // namespace temple
