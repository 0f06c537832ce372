// SPDX-License-Identifier: MIT
#pragma once

// What is held in the temple: beings of ink and smoke. Here is how one behaves and how its body drifts after
// it, in steps of a sixtieth of a second, the same on every run.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "kit.hpp"
#include "plan.hpp"

namespace temple {

/// Ground that a demon keeps to: a rectangle, less what stands on it.
struct Haunt {
    glm::vec2 low_m{0.0F}; ///< for its middle: as far from walls as it is wide
    glm::vec2 high_m{0.0F};
    std::vector<glm::vec3> pillars; ///< x, z, and how far off its middle stays
    int room = outside;             ///< of the prison, that it is in
    bool is_on_floor = true;        ///< of the prison; else on sand
    bool is_cell = false;           ///< it is held there
    float size = 1.0F;              ///< of the demon, beside a usual one of 2.4 m
};

enum class Mood : uint8_t {
    wander,   ///< drifts from place to place
    watch,    ///< stands, and looks at who has come
    shy,      ///< keeps away from who is too near
    dissolve, ///< runs out
    gone
};

/// One that drifts after where it hangs: the parts of a body from its head down.
struct Strand {
    int joints = 4;
    float length_m = 0.3F;           ///< from one joint to the next
    glm::vec3 root_m{0.0F};          ///< where it hangs on the body, from the head
    glm::vec3 hangs{0.0F, -1, 0.0F}; ///< which way it would, unit
    float stiffness = 1.0F;          ///< of the first joint; less further down
};

inline constexpr int strand_count = 6;

/// The body, two sleeves and three ribbons.
[[nodiscard]] const std::array<Strand, strand_count>& strands();

class Demon {
public:
    static constexpr double step_s = 1.0 / 60.0;
    static constexpr float sees_m = 15.0F;       ///< who is nearer is watched
    static constexpr float shies_m = 5.5F;       ///< who is nearer is kept away from
    static constexpr float despairs_m = 2.2F;    ///< who stays nearer makes it dissolve
    static constexpr float despairs_s = 2.5F;    ///< after so long
    static constexpr float dissolves_s = 4.5F;   ///< it takes
    static constexpr float half_width_m = 0.75F; ///< room that it keeps to walls, for a size of 1
    static constexpr float head_m = 2.05F;       ///< over the ground, for a size of 1

    /// `ground_m` is the height at x and z.
    Demon(Haunt haunt, std::function<float(const glm::vec2&)> ground_m, Dice dice);

    /// A 60th of a second on. `wind_m_s` is x and z.
    void step(const glm::vec3& walker_m, const glm::vec2& wind_m_s);

    /// From now on it runs out, whoever is near.
    void dissolve();

    [[nodiscard]] Mood mood() const { return mood_; }

    [[nodiscard]] const Haunt& haunt() const { return haunt_; }

    [[nodiscard]] const glm::vec2& place_m() const { return place_m_; }

    [[nodiscard]] const glm::vec2& velocity_m_s() const { return velocity_m_s_; }

    [[nodiscard]] glm::vec3 head() const { return joints_[0][0]; }

    /// Where it faces, from +z towards +x.
    [[nodiscard]] float yaw_rad() const { return yaw_rad_; }

    [[nodiscard]] float pitch_rad() const { return pitch_rad_; }

    /// In the world, from where the strand hangs on.
    [[nodiscard]] const std::vector<glm::vec3>& joints(int strand) const
    {
        return joints_[static_cast<size_t>(strand)];
    }

    /// 0 shut, 1 as they are, more when it is afraid.
    [[nodiscard]] float eyes() const { return eyes_; }

    /// Share of its ink that has run out.
    [[nodiscard]] float spilled() const { return spilled_; }

    /// Share that is still in the body.
    [[nodiscard]] float body() const { return 1.0F - spilled_; }

    /// How far round its foot it stains what is there now; 0 when it is gone.
    [[nodiscard]] float stain_m() const;

private:
    void choose_mood(const glm::vec3& walker_m);
    void choose_goal(const glm::vec3& walker_m);
    void move(float most_m_s);
    void look(const glm::vec3& walker_m);
    void keep_in_haunt();
    void drift(const glm::vec2& wind_m_s);
    void keep_between_walls(glm::vec3& joint) const;
    [[nodiscard]] glm::vec3 hung(const glm::vec3& from_head) const;

    Haunt haunt_;
    std::function<float(const glm::vec2&)> ground_m_;
    Dice dice_;
    Mood mood_ = Mood::wander;
    glm::vec2 place_m_{0.0F};
    glm::vec2 velocity_m_s_{0.0F};
    glm::vec2 goal_m_{0.0F};
    float height_m_ = 0.0F; ///< of the head
    float yaw_rad_ = 0.0F;
    float pitch_rad_ = 0.0F;
    float eyes_ = 1.0F;
    float until_blink_s_ = 2.0F;
    float rests_s_ = 0.0F;
    float goes_s_ = 0.0F; ///< to its goal
    float despair_s_ = 0.0F;
    float dissolving_s_ = 0.0F;
    float spilled_ = 0.0F;
    float phase_ = 0.0F;
    double time_s_ = 0.0;
    std::array<std::vector<glm::vec3>, strand_count> joints_;
    std::array<std::vector<glm::vec3>, strand_count> joint_velocities_;
};

} // namespace temple
