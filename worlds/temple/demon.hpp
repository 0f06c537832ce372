// SPDX-License-Identifier: MIT
#pragma once

// The demons of the temple: beings of ink and smoke. This file has the behaviour of one demon and the motion
// of its body, simulated in steps of a sixtieth of a second; the result is deterministic.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "kit.hpp"
#include "plan.hpp"

namespace temple {

/// Ground that a demon stays on: a rectangle without the pillars on it.
struct Haunt {
    glm::vec2 low_m{0.0F}; ///< limits of the demon's middle, which keeps its own width away from walls
    glm::vec2 high_m{0.0F};
    std::vector<glm::vec3> pillars; ///< x, z, and the distance that the demon's middle keeps
    int room = outside;             ///< room of the prison that the ground is in
    bool is_on_floor = true;        ///< it is a floor of the prison, not sand
    bool is_cell = false;           ///< the demon is held in this cell
    float size = 1.0F;              ///< size of the demon relative to the usual height of 2.4 m
};

enum class Mood : uint8_t {
    wander,   ///< drifts from place to place
    watch,    ///< stands and looks at the visitor
    shy,      ///< keeps away from a visitor who is too near
    dissolve, ///< dissolves into ink
    gone
};

/// A chain of joints that trails behind the body: a part of the body from the head down.
struct Strand {
    int joints = 4;
    float length_m = 0.3F;           ///< distance between joints
    glm::vec3 root_m{0.0F};          ///< attachment on the body, relative to the head
    glm::vec3 hangs{0.0F, -1, 0.0F}; ///< rest direction, unit
    float stiffness = 1.0F;          ///< stiffness of the first joint; decreases further down
};

inline constexpr int strand_count = 6;

/// The strands of a demon: the body, two sleeves and three ribbons.
[[nodiscard]] const std::array<Strand, strand_count>& strands();

class Demon {
public:
    static constexpr double step_s = 1.0 / 60.0;
    static constexpr float sees_m = 15.0F;       ///< a visitor nearer than this is watched
    static constexpr float shies_m = 5.5F;       ///< a demon retreats from a visitor nearer than this
    static constexpr float despairs_m = 2.2F;    ///< a demon dissolves if a visitor stays nearer than this
    static constexpr float despairs_s = 2.5F;    ///< how long the visitor must stay that near
    static constexpr float dissolves_s = 4.5F;   ///< duration of the dissolving
    static constexpr float half_width_m = 0.75F; ///< distance kept from walls, for a size of 1
    static constexpr float head_m = 2.05F;       ///< height of the head above the ground, for a size of 1

    /// `ground_m` gives the height of the ground at x and z.
    Demon(Haunt haunt, std::function<float(const glm::vec2&)> ground_m, Dice dice);

    /// Advances the simulation by step_s. `wind_m_per_s` is the wind along x and z.
    void step(const glm::vec3& walker_m, const glm::vec2& wind_m_per_s);

    /// Starts to dissolve, whoever is near.
    void dissolve();

    [[nodiscard]] Mood mood() const { return mood_; }

    [[nodiscard]] const Haunt& haunt() const { return haunt_; }

    [[nodiscard]] const glm::vec2& place_m() const { return place_m_; }

    [[nodiscard]] const glm::vec2& velocity_m_per_s() const { return velocity_m_s_; }

    [[nodiscard]] glm::vec3 head() const { return joints_[0][0]; }

    /// Direction that the demon faces, from +z towards +x.
    [[nodiscard]] float yaw_rad() const { return yaw_rad_; }

    [[nodiscard]] float pitch_rad() const { return pitch_rad_; }

    /// Joints of a strand in world space, from its attachment on.
    [[nodiscard]] const std::vector<glm::vec3>& joints(int strand) const
    {
        return joints_[static_cast<size_t>(strand)];
    }

    /// Opening of the eyes: 0 shut, 1 normal, above 1 when the demon is afraid.
    [[nodiscard]] float eyes() const { return eyes_; }

    /// Share of the demon's ink that has flowed out.
    [[nodiscard]] float spilled() const { return spilled_; }

    /// Share of the demon's ink that is still in the body.
    [[nodiscard]] float body() const { return 1.0F - spilled_; }

    /// Radius of the stain around the demon's foot; 0 after the demon is gone.
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
    float height_m_ = 0.0F; ///< height of the head
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
