// SPDX-License-Identifier: MIT
#include "demons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <estampe/shapes.hpp>

#include "demon.hpp"

namespace temple {
namespace {

using estampe::Primitive;

constexpr float full_turn = 2.0F * std::numbers::pi_v<float>;

/// Returns the joints of a demon's body in the rest pose, relative to the head: the joints of one strand
/// after another, each from the head down, then the two eyes.
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

/// Returns the index of a strand's first joint in the list of rest_joints().
size_t first_joint(int strand)
{
    size_t first = 0;
    for (int i = 0; i < strand; ++i) {
        first += static_cast<size_t>(strands()[static_cast<size_t>(i)].joints) + 1;
    }
    return first;
}

/// Joints that move a vertex of a demon: two joints, and the weight of the second joint.
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

/// Adds a band of triangles between two rows of vertices. The second row of vertices is stored directly after
/// the first row. The band is closed to a ring.
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

/// Returns the joint weights of a vertex on a strand, by its distance from the strand's start.
Hold hold_at(int strand, float down_m)
{
    const Strand& hung = strands()[static_cast<size_t>(strand)];
    const float along = glm::clamp(down_m / hung.length_m, 0.0F, static_cast<float>(hung.joints));
    const auto whole = std::min(static_cast<size_t>(along), static_cast<size_t>(hung.joints) - 1);
    const size_t first = first_joint(strand) + whole;
    return {first, first + 1, along - static_cast<float>(whole)};
}

/// Adds the demon's hood, shoulders and a cloak with a torn hem.
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

/// Adds a demon's sleeve with a wide, torn end, or a ribbon that ends in a point. `root_m` and `end_m` are
/// the width and depth at the upper and at the lower end.
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

/// Builds the mesh of a demon: a hooded shape with a torn hem, sleeves and ribbons of the material `ink`, and
/// two eyes of `pale`, skinned to rest_joints(). Its front is +z, and its head is at the origin.
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

using estampe::Index;

constexpr size_t most_cells = 6;
constexpr int forms = 3; ///< Number of demon meshes with different torn edges

/// A joint of a demon's strand from which smoke rises.
struct Wisp {
    int strand;
    int joint;
};

constexpr std::array<Wisp, 7> wisps{{{0, 3}, {0, 5}, {1, 4}, {2, 4}, {3, 4}, {4, 3}, {0, 1}}};

const size_t joint_count = rest_joints().size();

Haunt room_haunt(const Plan& plan, size_t room, float size)
{
    constexpr float wall_m = 0.6F;
    const float apart_m = wall_m + size * Demon::half_width_m;
    Haunt haunt{.low_m = plan.rooms[room].low_m() + apart_m,
                .high_m = plan.rooms[room].high_m() - apart_m,
                .pillars = {},
                .room = static_cast<int>(room),
                .is_cell = plan.rooms[room].kind == RoomKind::cell,
                .size = size};
    for (const PlacedColumn& column : plan.columns) {
        if (column.room == static_cast<int>(room)) {
            haunt.pillars.emplace_back(column.place_m,
                                       1.42F * foot_half_m(column.column) + size * Demon::half_width_m);
        }
    }
    return haunt;
}

/// Returns the ground of a demon on the sand between `low` and `high`, without the places of columns, drums,
/// the statue and flags.
Haunt sand_haunt(const Site& site, const glm::vec2& low, const glm::vec2& high, float size)
{
    Haunt haunt{.low_m = low, .high_m = high, .pillars = {}, .is_on_floor = false, .size = size};
    const float wide_m = size * Demon::half_width_m;
    for (const StandingColumn& column : site.columns) {
        haunt.pillars.emplace_back(column.place_m, 1.42F * foot_half_m(column.column) + wide_m);
    }
    for (const glm::vec3& drum : site.drums) {
        haunt.pillars.emplace_back(drum.x, drum.y, 1.9F + wide_m);
    }
    haunt.pillars.emplace_back(-5.4F, -4.0F, 1.6F + wide_m); // The statue counts as a pillar as well
    for (const Sheet& sheet : site.sheets) {
        haunt.pillars.emplace_back(sheet.corner_m.x, sheet.corner_m.z, 0.3F + wide_m);
    }
    return haunt;
}

glm::dquat facing(const Demon& demon)
{
    return glm::angleAxis(static_cast<double>(demon.yaw_rad()), glm::dvec3(0.0, 1.0, 0.0));
}

glm::dquat nodding(const Demon& demon)
{
    return glm::angleAxis(static_cast<double>(demon.pitch_rad()), glm::dvec3(1.0, 0.0, 0.0));
}

} // namespace

std::vector<Haunt> find_haunts(const Plan& plan, const Site& site)
{
    std::vector<Haunt> haunts;
    const auto is_shut = [&](size_t room) {
        return std::ranges::any_of(plan.doors, [&](const Door& door) {
            return door.is_barred && (door.a == static_cast<int>(room) || door.b == static_cast<int>(room));
        });
    };
    for (const bool wants_shut : {true, false}) {
        for (size_t room = 0; room < plan.rooms.size() && haunts.size() < most_cells; ++room) {
            if (plan.rooms[room].kind == RoomKind::cell && is_shut(room) == wants_shut) {
                haunts.push_back(room_haunt(plan, room, 1.0F));
            }
        }
    }
    haunts.push_back(room_haunt(plan, static_cast<size_t>(plan.last_room), 1.5F));
    haunts.push_back(sand_haunt(site, {-15.5F, -6.0F}, {-7.5F, 8.0F}, 1.15F));
    haunts.push_back(sand_haunt(site, {1.5F, -13.0F}, {8.0F, 4.0F}, 1.0F));
    haunts.push_back(sand_haunt(site, {-3.6F, 50.0F}, {3.6F, 66.0F}, 1.1F));
    const glm::vec2 giant = site.colossus_m;
    haunts.push_back(sand_haunt(site, giant + glm::vec2(-7.0F, 18.0F), giant + glm::vec2(6.0F, 25.0F), 1.0F));
    haunts.push_back(sand_haunt(site, {-68.0F, 88.0F}, {-56.0F, 102.0F}, 1.1F));
    return haunts;
}

Demons::Demons(const Plan& plan, const Site& site, const estampe::Terrain& desert, uint64_t seed)
    : seed_(seed)
{
    const auto on_sand = [desert](const glm::vec2& place) {
        return static_cast<float>(desert.sample(place.x, place.y).height_m);
    };
    const auto on_floor = [](const glm::vec2&) { return floor_m; };
    for (const Haunt& haunt : find_haunts(plan, site)) {
        const Dice dice(seed, 200 + all_.size());
        all_.emplace_back(
            haunt, haunt.is_on_floor ? std::function<float(const glm::vec2&)>(on_floor) : on_sand, dice);
    }
}

void Demons::step(double seconds, const glm::dvec3& walker_m, const glm::vec2& wind_m_per_s)
{
    owed_s_ += std::max(seconds, 0.0);
    // The tolerance makes sure that a simulation step is done when it is due, despite rounding errors in the
    // sum of times.
    for (; owed_s_ > Demon::step_s - 1e-9; owed_s_ -= Demon::step_s) {
        for (Demon& demon : all_) {
            demon.step(glm::vec3(walker_m), wind_m_per_s);
        }
    }
}

void Demons::add_to(estampe::Scene& scene) const
{
    const auto ink = static_cast<Index>(scene.materials.size());
    const Index pale = ink + 1;
    scene.materials.push_back(
        {.name = "demon", .base_color = {0.006F, 0.006F, 0.009F, 1.0F}, .metallic = 0.0F});
    scene.materials.back().double_sided = true;
    scene.materials.back().unlit = true;
    scene.materials.push_back(
        {.name = "demon's eye", .base_color = {0.93F, 0.9F, 0.72F, 1.0F}, .metallic = 0.0F});
    scene.materials.back().unlit = true;
    const auto first_mesh = static_cast<Index>(scene.meshes.size());
    for (int form = 0; form < forms; ++form) {
        scene.meshes.push_back(build_demon(Dice(seed_, 300 + static_cast<uint64_t>(form)), ink, pale));
    }
    std::vector<glm::mat4> joint_from_bind;
    for (const glm::vec3& joint : rest_joints()) {
        joint_from_bind.push_back(glm::translate(glm::mat4(1.0F), -joint));
    }
    const auto first = static_cast<Index>(scene.nodes.size());
    for (size_t i = 0; i < all_.size(); ++i) {
        const std::string number = std::to_string(i);
        const auto root = static_cast<Index>(scene.nodes.size());
        const auto add = [&](const std::string& name, Index parent) -> estampe::Node& {
            const auto index = static_cast<Index>(scene.nodes.size());
            estampe::Node& node = scene.nodes.emplace_back();
            node.name = name;
            node.parent = parent;
            if (parent != estampe::no_index) {
                scene.nodes[parent].children.push_back(index);
            }
            return node;
        };
        scene.roots.push_back(root);
        add("demon " + number, estampe::no_index);
        estampe::Skin skin{.name = "demon " + number, .joints = {}, .joint_from_bind = joint_from_bind};
        for (size_t joint = 0; joint < joint_count; ++joint) {
            // Eyes turn with the head.
            const bool is_eye = joint + 2 >= joint_count;
            skin.joints.push_back(static_cast<Index>(scene.nodes.size()));
            add("joint", is_eye ? root + 1 : root);
        }
        for (const Wisp& wisp : wisps) {
            add("wisp " + number,
                root + 1 + static_cast<Index>(first_joint(wisp.strand)) + static_cast<Index>(wisp.joint));
        }
        add("stain " + number, root);
        estampe::Node& shown = add("body of demon " + number, root);
        shown.mesh = first_mesh + static_cast<Index>(i % forms);
        shown.skin = static_cast<Index>(scene.skins.size());
        scene.skins.push_back(std::move(skin));
    }
    for (const estampe::NodePlace& place : places(first)) {
        scene.nodes[place.node].transform = place.transform;
    }
}

std::vector<estampe::NodePlace> Demons::places(Index first,
                                               const std::function<bool(const Demon&)>& is_hidden) const
{
    std::vector<estampe::NodePlace> places;
    Index node = first;
    const auto put = [&](const glm::dvec3& place, const glm::dquat& turned, const glm::dvec3& scale) {
        places.push_back({node++, {.translation = place, .rotation = turned, .scale = scale}});
    };
    constexpr glm::dquat straight(1.0, 0.0, 0.0, 0.0);
    for (const Demon& demon : all_) {
        const Index root = node;
        const auto size = static_cast<double>(demon.haunt().size);
        const bool is_gone = demon.mood() == Mood::gone || (is_hidden && is_hidden(demon));
        const auto left = static_cast<double>(demon.body());
        // A demon that dissolves becomes thinner and sinks.
        const double thin = std::max(std::sqrt(std::max(left, 0.0)), 1e-3);
        const glm::dvec3 head(demon.head());
        const glm::dquat turned = facing(demon);
        put(head, turned, glm::dvec3(is_gone ? 1e-3 * size : size));
        for (int strand = 0; strand < strand_count; ++strand) {
            for (const glm::vec3& joint : demon.joints(strand)) {
                const glm::dvec3 local = glm::conjugate(turned) * (glm::dvec3(joint) - head) / size;
                const bool is_head = node == root + 1;
                const glm::dquat nod = is_head ? nodding(demon) : straight;
                put(local, nod, glm::dvec3(thin));
            }
        }
        for (const size_t eye : {joint_count - 2, joint_count - 1}) {
            const auto open = static_cast<double>(demon.eyes());
            put(glm::dvec3(rest_joints()[eye]), straight, {0.6 + 0.4 * open, std::max(open, 0.02), 1.0});
        }
        // The emitters of smoke point upwards, but each in a slightly different direction, so that no two
        // streams look alike.
        for (size_t i = 0; i < wisps.size(); ++i) {
            const double lean = wisps[i].strand == 0 ? 0.5 : 1.1;
            const glm::dquat aside = glm::angleAxis(2.4 * static_cast<double>(i), glm::dvec3(0.0, 1.0, 0.0)) *
                                     glm::angleAxis(-lean, glm::dvec3(1.0, 0.0, 0.0));
            put(glm::dvec3(0.0), aside, glm::dvec3(is_gone ? 0.0 : (0.5 + 0.5 * left) / thin));
        }
        const double ground_m = -static_cast<double>(Demon::head_m) * (1.0 - 0.55 * (1.0 - left));
        put({0.0, ground_m + 0.1, 0.0}, straight,
            glm::dvec3(is_gone ? 0.0 : static_cast<double>(demon.stain_m()) / size));
        put(glm::dvec3(0.0), straight, glm::dvec3(1.0));
    }
    return places;
}

std::vector<Hollow> Demons::hollows() const
{
    std::vector<Hollow> hollows;
    for (const Demon& demon : all_) {
        if (!demon.haunt().is_on_floor) {
            hollows.push_back(
                {demon.place_m(), 0.42F * demon.haunt().size * demon.body(), 1.5F * demon.haunt().size});
        }
    }
    return hollows;
}

} // namespace temple
