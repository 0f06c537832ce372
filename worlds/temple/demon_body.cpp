// SPDX-License-Identifier: MIT
#include "demon_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include <estampe/shapes.hpp>

#include "demon.hpp"

namespace temple {
namespace {

using estampe::Primitive;

constexpr float full_turn = 2.0F * std::numbers::pi_v<float>;

/// Two joints and how much of the second.
struct Hold {
    size_t first = 0;
    size_t second = 0;
    float share = 0.0F;
};

void add_vertex(Primitive& part, const glm::vec3& place, const glm::vec2& uv, const Hold& hold)
{
    part.positions.push_back(place);
    part.uvs[0].push_back(uv);
    part.joints_0.emplace_back(hold.first, hold.second, 0, 0);
    part.weights_0.emplace_back(1.0F - hold.share, hold.share, 0.0F, 0.0F);
}

/// Joins two rows of so many vertices, the second of which begins right after the first; closed to a ring.
void add_band(Primitive& part, uint32_t first, uint32_t columns)
{
    for (uint32_t i = 0; i < columns; ++i) {
        const uint32_t a = first + i;
        const uint32_t b = first + (i + 1) % columns;
        part.indices.insert(part.indices.end(), {a, a + columns, b, b, a + columns, b + columns});
    }
}

void find_normals(Primitive& part)
{
    part.normals.assign(part.positions.size(), glm::vec3(0.0F));
    for (size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        const uint32_t* const corner = &part.indices[i];
        const glm::vec3 normal = glm::cross(part.positions[corner[1]] - part.positions[corner[0]],
                                            part.positions[corner[2]] - part.positions[corner[0]]);
        for (int k = 0; k < 3; ++k) {
            part.normals[corner[k]] += normal;
        }
    }
    for (glm::vec3& normal : part.normals) {
        normal = glm::length(normal) > 1e-9F ? glm::normalize(normal) : glm::vec3(0.0F, 1.0F, 0.0F);
    }
}

/// Where along a strand a place so far from its root is held.
Hold hold_at(int strand, float down_m)
{
    const Strand& hung = strands()[static_cast<size_t>(strand)];
    const float along = glm::clamp(down_m / hung.length_m, 0.0F, static_cast<float>(hung.joints));
    const auto whole = std::min(static_cast<size_t>(along), static_cast<size_t>(hung.joints) - 1);
    const size_t first = first_joint(strand) + whole;
    return {first, first + 1, along - static_cast<float>(whole)};
}

/// Hood, shoulders and a cloak whose hem is torn.
void add_cloak(Primitive& part, Dice& dice)
{
    struct Ring {
        float y, wide, deep, back;
    };

    constexpr std::array<Ring, 15> rings{{{0.40F, 0.015F, 0.02F, 0.13F},
                                          {0.34F, 0.075F, 0.09F, 0.09F},
                                          {0.24F, 0.145F, 0.17F, 0.05F},
                                          {0.11F, 0.19F, 0.215F, 0.015F},
                                          {-0.03F, 0.195F, 0.21F, 0.01F},
                                          {-0.17F, 0.18F, 0.175F, 0.03F},
                                          {-0.27F, 0.235F, 0.185F, 0.05F},
                                          {-0.37F, 0.35F, 0.22F, 0.05F},
                                          {-0.5F, 0.40F, 0.25F, 0.04F},
                                          {-0.72F, 0.37F, 0.27F, 0.03F},
                                          {-0.98F, 0.33F, 0.28F, 0.02F},
                                          {-1.26F, 0.3F, 0.27F, 0.02F},
                                          {-1.52F, 0.26F, 0.235F, 0.03F},
                                          {-1.74F, 0.2F, 0.18F, 0.05F},
                                          {-1.95F, 0.13F, 0.12F, 0.08F}}};
    constexpr uint32_t columns = 26;
    std::array<float, columns> torn{};
    for (uint32_t i = 0; i < columns; ++i) {
        torn[i] = (i % 2 == 0 ? dice.between(0.85F, 1.22F) : dice.between(0.4F, 0.85F));
    }
    const float phase = dice.between(0.0F, full_turn);
    constexpr float waist_y = -0.72F;
    for (const Ring& ring : rings) {
        const float low = glm::smoothstep(-0.4F, -1.3F, ring.y);
        const float below = std::max(waist_y - ring.y, 0.0F);
        for (uint32_t i = 0; i < columns; ++i) {
            const float angle = full_turn * static_cast<float>(i) / columns;
            const float folds =
                1.0F + low * (0.16F * std::sin(5.0F * angle + phase) + 0.1F * std::sin(9.0F * angle));
            const float y = ring.y + below * (1.0F - torn[i]);
            const glm::vec3 place(folds * ring.wide * std::sin(angle), y,
                                  folds * ring.deep * std::cos(angle) - ring.back);
            add_vertex(part, place, {0.4F * angle, y}, hold_at(0, -y));
        }
        if (&ring != rings.data()) {
            add_band(part, static_cast<uint32_t>(part.positions.size()) - 2 * columns, columns);
        }
    }
}

/// A sleeve that is wide at its torn end, or a ribbon that ends in a point: so wide and deep at its root and
/// end.
void add_strand(Primitive& part, int number, const glm::vec2& root_m, const glm::vec2& end_m, Dice& dice)
{
    const Strand& strand = strands()[static_cast<size_t>(number)];
    const glm::vec3 right = glm::normalize(glm::cross(strand.hangs, glm::vec3(0.0F, 0.3F, 1.0F)));
    const glm::vec3 front = glm::cross(right, strand.hangs);
    constexpr uint32_t columns = 8;
    std::array<float, columns> torn{};
    for (uint32_t i = 0; i < columns; ++i) {
        torn[i] = i % 2 == 0 ? dice.between(0.9F, 1.0F) : dice.between(0.55F, 0.85F);
    }
    const int rows = 2 * strand.joints;
    const float whole_m = strand.length_m * static_cast<float>(strand.joints);
    for (int row = 0; row <= rows; ++row) {
        const float share = static_cast<float>(row) / static_cast<float>(rows);
        const glm::vec2 size = glm::mix(root_m, end_m, share);
        for (uint32_t i = 0; i < columns; ++i) {
            const float angle = full_turn * static_cast<float>(i) / columns;
            const float down_m =
                whole_m * share * (share > 0.5F ? glm::mix(1.0F, torn[i], 2.0F * share - 1.0F) : 1.0F);
            const float uneven =
                1.0F + 0.2F * std::sin(11.0F * share + 2.0F * angle + static_cast<float>(number));
            const glm::vec3 place =
                strand.root_m + down_m * strand.hangs +
                uneven * (size.x * std::cos(angle) * right + size.y * std::sin(angle) * front);
            add_vertex(part, place, {0.4F * angle, -down_m}, hold_at(number, down_m));
        }
        if (row > 0) {
            add_band(part, static_cast<uint32_t>(part.positions.size()) - 2 * columns, columns);
        }
    }
}

void add_eyes(Primitive& part)
{
    const Primitive ball = estampe::shapes::sphere(1.0F, 14, 8);
    for (const size_t eye : {size_t{0}, size_t{1}}) {
        const size_t joint = rest_joints().size() - 2 + eye;
        const float slant = eye == 0 ? -0.42F : 0.42F;
        glm::mat4 placed = glm::translate(glm::mat4(1.0F), rest_joints()[joint]);
        placed = glm::rotate(placed, slant, {0.0F, 0.0F, 1.0F});
        placed = glm::scale(placed, {0.062F, 0.03F, 0.03F});
        const size_t before = part.positions.size();
        estampe::shapes::append(part, ball, placed);
        part.joints_0.resize(part.positions.size());
        part.weights_0.resize(part.positions.size(), {1.0F, 0.0F, 0.0F, 0.0F});
        for (size_t i = before; i < part.positions.size(); ++i) {
            part.joints_0[i] = {static_cast<uint16_t>(joint), 0, 0, 0};
        }
    }
}

} // namespace

const std::vector<glm::vec3>& rest_joints()
{
    static const std::vector<glm::vec3> all = [] {
        std::vector<glm::vec3> joints;
        for (const Strand& strand : strands()) {
            for (int k = 0; k <= strand.joints; ++k) {
                joints.push_back(strand.root_m + static_cast<float>(k) * strand.length_m * strand.hangs);
            }
        }
        joints.emplace_back(-0.082F, 0.055F, 0.195F);
        joints.emplace_back(0.082F, 0.055F, 0.195F);
        return joints;
    }();
    return all;
}

size_t first_joint(int strand)
{
    size_t first = 0;
    for (int i = 0; i < strand; ++i) {
        first += static_cast<size_t>(strands()[static_cast<size_t>(i)].joints) + 1;
    }
    return first;
}

estampe::Mesh build_demon(Dice dice, estampe::Index ink, estampe::Index pale)
{
    Primitive body;
    body.material = ink;
    add_cloak(body, dice);
    for (const int sleeve : {1, 2}) {
        add_strand(body, sleeve, {0.1F, 0.09F}, {0.15F, 0.07F}, dice);
    }
    for (const int ribbon : {3, 4, 5}) {
        add_strand(body, ribbon, {0.15F, 0.03F}, {0.015F, 0.008F}, dice);
    }
    find_normals(body);
    Primitive eyes;
    eyes.material = pale;
    add_eyes(eyes);
    return {.name = "demon", .primitives = {std::move(body), std::move(eyes)}};
}

} // namespace temple
