// SPDX-License-Identifier: MIT
#pragma once

// How the temple's things are put together: chance, and shapes, each of one stuff, gathered into meshes.

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

/// Chance that is the same on every machine: SplitMix64 (Steele et al., "Fast splittable pseudorandom number
/// generators", 2014). The standard's distributions are each library's own.
class Dice {
public:
    /// Each `part` of a seed has throws of its own: what one part takes changes no other.
    explicit Dice(uint64_t seed, uint64_t part = 0) : state_(mixed(seed) ^ mixed(~part)) {}

    [[nodiscard]] uint64_t number()
    {
        state_ += 0x9e3779b97f4a7c15U;
        return mixed(state_);
    }

    /// 0 up to, and without, 1.
    [[nodiscard]] float share() { return static_cast<float>(number() >> 40U) * 0x1p-24F; }

    [[nodiscard]] float between(float low, float high) { return low + (high - low) * share(); }

    /// 0 to count - 1.
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

/// The materials, in the order of Stuff.
[[nodiscard]] std::vector<estampe::Material> materials();

/// The way strokes run over a flat face: along `along`, with `up` to their left, both unit.
struct Grain {
    glm::vec3 along{1.0F, 0.0F, 0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    glm::vec2 offset_m{0.0F}; ///< strokes of two stones begin at two places
};

/// Gathers shapes of one thing. Of some faces it says which edges a pen would draw.
class Kit : public estampe::shapes::MeshBuilder {
public:
    /// A convex flat face, counter-clockwise from outside, of which the edges from corner k to the next are
    /// drawn where bit k of `drawn` is set, and no others. Its shading may lean away from its plane.
    void add_face(Stuff stuff, std::span<const glm::vec3> corners, const glm::vec3& normal,
                  const Grain& grain, uint32_t drawn);
};

/// A block whose strokes run level, with all its edges drawn, or only those on which the light breaks.
void add_block(Kit& kit, Stuff stuff, const glm::vec3& low, const glm::vec3& high);

} // namespace temple
