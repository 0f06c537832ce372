// SPDX-License-Identifier: MIT
#pragma once

// The demons of the temple: beings of ink and smoke. The file declares the simulation of a demon's behaviour
// and of its body's motion, in steps of a sixtieth of a second. The same input always gives the same motion.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "kit.hpp"
#include "plan.hpp"

namespace temple {

/// Ground on which a demon moves: a rectangle, except the pillars that stand on it.
struct Haunt {
    /// Smallest x and z of the demon's middle. The demon's own width is subtracted, so that the demon does
    /// not touch walls.
    glm::vec2 low_m{0.0F};
    glm::vec2 high_m{0.0F};
    /// Pillars on the ground: x, z, and the smallest distance of the demon's middle from the pillar's middle.
    std::vector<glm::vec3> pillars;
    int room = outside;      ///< Room of the prison in which the ground lies
    bool is_on_floor = true; ///< The ground is a floor of the prison, not sand
    bool is_cell = false;    ///< The ground is a cell in which the demon is held
    float size = 1.0F;       ///< Size of the demon relative to the usual height of 2.4 m
};

enum class Mood : uint8_t {
    wander,   ///< The demon drifts from place to place
    watch,    ///< The demon stands and looks at the visitor
    shy,      ///< The demon keeps away from a visitor who is too near
    dissolve, ///< The demon dissolves into ink
    gone
};

/// A strand of a demon: a chain of joints from the head down, which trails behind when the body moves.
struct Strand {
    int joints = 4;
    float length_m = 0.3F;           ///< Distance between two joints of the strand
    glm::vec3 root_m{0.0F};          ///< Place where the strand starts on the body, relative to the head
    glm::vec3 hangs{0.0F, -1, 0.0F}; ///< Direction in which the strand hangs at rest, a unit vector
    float stiffness = 1.0F;          ///< Stiffness of the first joint; the stiffness decreases further down
};

inline constexpr int strand_count = 6;

/// Returns the strands of a demon: the body, two sleeves and three ribbons.
[[nodiscard]] const std::array<Strand, strand_count>& strands();

class Demon {
public:
    static constexpr double step_s = 1.0 / 60.0;
    static constexpr float sees_m = 15.0F;    ///< A demon watches a visitor who is nearer than this
    static constexpr float shies_m = 5.5F;    ///< A demon retreats from a visitor who is nearer than this
    static constexpr float despairs_m = 2.2F; ///< A demon dissolves if a visitor stays nearer than this
    /// Time for which the visitor must be nearer than `despairs_m` until the demon dissolves.
    static constexpr float despairs_s = 2.5F;
    static constexpr float dissolves_s = 4.5F;   ///< Time in which a demon dissolves
    static constexpr float half_width_m = 0.75F; ///< Distance that a demon of size 1 keeps from walls
    static constexpr float head_m = 2.05F; ///< Height of a demon's head above the ground, for a size of 1

    /// Creates a demon. `ground_m` gives the height of the ground at x and z.
    Demon(Haunt haunt, std::function<float(const glm::vec2&)> ground_m, Dice dice);

    /// Advances the demon by one step of step_s. `wind_m_per_s` is the wind along x and z.
    void step(const glm::vec3& walker_m, const glm::vec2& wind_m_per_s);

    /// Makes the demon dissolve, even if no visitor is near.
    void dissolve();

    [[nodiscard]] Mood mood() const { return mood_; }

    [[nodiscard]] const Haunt& haunt() const { return haunt_; }

    [[nodiscard]] const glm::vec2& place_m() const { return place_m_; }

    [[nodiscard]] const glm::vec2& velocity_m_per_s() const { return velocity_m_s_; }

    [[nodiscard]] glm::vec3 head() const { return joints_[0][0]; }

    /// Returns the direction that the demon faces: 0 is +z, a quarter turn is +x.
    [[nodiscard]] float yaw_rad() const { return yaw_rad_; }

    [[nodiscard]] float pitch_rad() const { return pitch_rad_; }

    /// Returns the joints of a demon's strand in world space, from its first joint on the body.
    [[nodiscard]] const std::vector<glm::vec3>& joints(int strand) const
    {
        return joints_[static_cast<size_t>(strand)];
    }

    /// Returns how far the demon's eyes are open: 0 shut, 1 normal, above 1 when the demon is afraid.
    [[nodiscard]] float eyes() const { return eyes_; }

    /// Share of the demon's ink that has flowed out.
    [[nodiscard]] float spilled() const { return spilled_; }

    /// Share of the demon's ink that is still in the body.
    [[nodiscard]] float body() const { return 1.0F - spilled_; }

    /// Radius of the stain of ink under the demon; 0 after the demon is gone.
    [[nodiscard]] float stain_m() const;

private:
    void choose_mood(const glm::vec3& walker_m);
    void choose_goal(const glm::vec3& walker_m);
    void move(float most_m_per_s);
    void look(const glm::vec3& walker_m);
    void keep_in_haunt();
    void drift(const glm::vec2& wind_m_per_s);
    void keep_between_walls(glm::vec3& joint) const;
    [[nodiscard]] glm::vec3 hung(const glm::vec3& from_head) const;

    Haunt haunt_;
    std::function<float(const glm::vec2&)> ground_m_;
    Dice dice_;
    Mood mood_ = Mood::wander;
    glm::vec2 place_m_{0.0F};
    glm::vec2 velocity_m_s_{0.0F};
    glm::vec2 goal_m_{0.0F};
    float height_m_ = 0.0F; ///< Height of the demon's head
    float yaw_rad_ = 0.0F;
    float pitch_rad_ = 0.0F;
    float eyes_ = 1.0F;
    float until_blink_s_ = 2.0F;
    float rests_s_ = 0.0F;
    float goes_s_ = 0.0F; ///< time since the demon chose its goal
    float despair_s_ = 0.0F;
    float dissolving_s_ = 0.0F;
    float spilled_ = 0.0F;
    float phase_ = 0.0F;
    double time_s_ = 0.0;
    std::array<std::vector<glm::vec3>, strand_count> joints_;
    std::array<std::vector<glm::vec3>, strand_count> joint_velocities_;
};

} // namespace temple
