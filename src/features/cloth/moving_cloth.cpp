// SPDX-License-Identifier: MIT
#include "features/cloth/moving_cloth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "shaders/scene.glsl.h"

namespace estampe::features {
namespace {

constexpr double usual_step_s = 1.0 / 120.0;
// Largest number of simulation steps between two poses. Between two poses, held particles move linearly.
constexpr uint32_t steps_between_poses = 5;

/// Merges vertices at the same position to one particle, so that cloth sheets stay connected along UV seams.
cloth::DrawnSheet welded(const pose::MeshData& layout, const shared::DrawRecord& draw,
                         const std::vector<float>& held, cloth::Sheet& sheet)
{
    std::map<std::tuple<float, float, float>, uint32_t> particles;
    cloth::DrawnSheet drawn{.first_vertex = draw.first_posed_vertex};
    const auto unit_m = static_cast<float>(layout.stroke_unit_m);
    for (uint32_t i = 0; i < draw.vertex_count; ++i) {
        const glm::vec3 place = unit_m * layout.stroke_coordinates[draw.first_posed_vertex + i];
        const auto [found, is_new] =
            particles.try_emplace({place.x, place.y, place.z}, static_cast<uint32_t>(sheet.rest_m.size()));
        if (is_new) {
            sheet.rest_m.push_back(place);
            sheet.held.push_back(0.0F);
        }
        float& hold = sheet.held[found->second];
        hold = std::max(hold, i < held.size() ? held[i] : 0.0F);
        drawn.particle_of_vertex.push_back(found->second);
    }
    return drawn;
}

cloth::SolidKind solid_kind(ClothCollider collider)
{
    switch (collider) {
    case ClothCollider::box:
        return cloth::SolidKind::box;
    case ClothCollider::cylinder:
        return cloth::SolidKind::cylinder;
    case ClothCollider::capsule:
        return cloth::SolidKind::capsule;
    default:
        return cloth::SolidKind::ellipsoid;
    }
}

/// Returns the smallest solid of this kind around a mesh. A capsule's ends stay within the mesh's box.
cloth::Solid solid_about(const Mesh& mesh, ClothCollider collider)
{
    Bounds bounds;
    for (const Primitive& primitive : mesh.primitives) {
        for (const glm::vec3& position : primitive.positions) {
            bounds.extend(position);
        }
    }
    cloth::Solid solid{.kind = solid_kind(collider)};
    if (bounds.empty()) {
        return solid;
    }
    const glm::vec3 half(0.5 * (bounds.max - bounds.min));
    solid.centre_m = glm::vec3(bounds.center());
    solid.half_m = half;
    if (collider == ClothCollider::cylinder || collider == ClothCollider::capsule) {
        const float radius_m = std::max(half.x, half.z);
        const float ends_m = collider == ClothCollider::capsule ? radius_m : 0.0F;
        solid.half_m = {radius_m, std::max(half.y - ends_m, 0.0F), radius_m};
    }
    return solid;
}

} // namespace

namespace {

/// Returns the axis-aligned box around a transformed box.
Bounds box_about(const Bounds& bounds, const glm::mat4& place)
{
    Bounds box;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 upper((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
        const glm::dvec3 point = glm::mix(bounds.min, bounds.max, upper);
        box.extend(glm::dvec3(glm::dmat4(place) * glm::dvec4(point, 1.0)));
    }
    return box;
}

} // namespace

bool MovingCloth::is_in(const Scene& scene)
{
    return std::ranges::any_of(scene.nodes, [&](const Node& node) {
        return node.mesh < scene.meshes.size() &&
               std::ranges::any_of(scene.meshes[node.mesh].primitives, [&](const Primitive& primitive) {
                   return cloth_of(scene, node, primitive) != nullptr;
               });
    });
}

MovingCloth::Cut MovingCloth::cut(const Scene& scene, const pose::MeshData& layout)
{
    Cut cut;
    std::map<uint32_t, size_t> sheet_of_draw;
    const ScenePose rest = pose_scene(scene, 0.0, no_index);
    std::vector<bool> is_mirrored;
    for (uint32_t i = 0; i < layout.sources.size(); ++i) {
        const pose::DrawSource& source = layout.sources[i];
        const Node& node = scene.nodes[source.node];
        const Primitive& primitive = scene.meshes[node.mesh].primitives[source.primitive];
        const Cloth* const cloth = cloth_of(scene, node, primitive);
        if (cloth == nullptr || primitive.indices.empty()) {
            continue;
        }
        // A primitive with the cloth's back material is the back of the primitive before it.
        if (primitive.material == cloth->back_material) {
            const auto front = std::ranges::find_if(cut.draws, [&](uint32_t draw) {
                const pose::DrawSource& other = layout.sources[draw];
                return other.node == source.node && other.primitive + 1 == source.primitive &&
                       other.instance == source.instance;
            });
            if (front != cut.draws.end()) {
                const auto sheet = static_cast<size_t>(front - cut.draws.begin());
                cut.drawn[sheet].first_back_vertex = layout.draws[i].first_posed_vertex;
                sheet_of_draw[i] = sheet;
                continue;
            }
        }
        sheet_of_draw[i] = cut.sheets.size();
        cut.draws.push_back(i);
        cloth::Sheet& sheet = cut.sheets.emplace_back();
        sheet.cloth = *cloth;
        cut.drawn.push_back(welded(layout, layout.draws[i], primitive.held, sheet));
        is_mirrored.push_back(glm::determinant(glm::dmat3(rest.world_from_node[source.node])) < 0.0);
    }
    for (uint32_t i = 0; i < layout.triangles.size(); ++i) {
        const glm::uvec4& triangle = layout.triangles[i];
        const auto found = sheet_of_draw.find(triangle.w & shared::triangle_draw_mask);
        if (found == sheet_of_draw.end()) {
            continue;
        }
        cloth::DrawnSheet& drawn = cut.drawn[found->second];
        const bool is_back = drawn.first_back_vertex && triangle.x >= *drawn.first_back_vertex &&
                             triangle.x - *drawn.first_back_vertex < drawn.particle_of_vertex.size();
        const glm::uvec3 own =
            glm::uvec3(triangle) - (is_back ? *drawn.first_back_vertex : drawn.first_vertex);
        glm::uvec3 particles(drawn.particle_of_vertex[own.x], drawn.particle_of_vertex[own.y],
                             drawn.particle_of_vertex[own.z]);
        if (is_mirrored[found->second]) {
            std::swap(particles.y, particles.z);
        }
        if (particles.x == particles.y || particles.y == particles.z || particles.z == particles.x) {
            continue;
        }
        cloth::Sheet& sheet = cut.sheets[found->second];
        if (sheet.cloth.tear > 0.0F) {
            drawn.faces.push_back({.triangle = i, .vertices = triangle, .particles = particles});
        }
        if (!is_back) {
            sheet.triangles.push_back(particles);
        }
    }
    return cut;
}

MovingCloth::MovingCloth(gpu::Device& device, Cut&& cut)
    : sheets_(device, cut.sheets, cut.drawn), draws_(std::move(cut.draws)),
      all_hang_(std::ranges::all_of(cut.sheets, cloth::hangs))
{
}

MovingCloth::MovingCloth(gpu::Device& device, const Scene& scene, const pose::MeshData& layout)
    : MovingCloth(device, cut(scene, layout))
{
    bones_ = bone_capsules(scene);
    grids_ = SolidGrids(scene);
    sheets_.set_grids(device, grids_.grids());
    for (const uint32_t draw : draws_) {
        const pose::DrawSource& source = layout.sources[draw];
        reaches_.push_back(source.local_bounds);
        cut_from_.emplace_back(source.node, source.primitive, source.instance);
    }
}

void MovingCloth::go_on_from(MovingCloth& other)
{
    const std::vector<gpu::Buffer*> own = sheets_.state();
    const std::vector<gpu::Buffer*> others = other.sheets_.state();
    const auto is_as_large = [](const gpu::Buffer* a, const gpu::Buffer* b) {
        return a->size_bytes() == b->size_bytes();
    };
    if (!other.time_s_ || cut_from_ != other.cut_from_ || !std::ranges::equal(own, others, is_as_large)) {
        return;
    }
    std::vector<gpu::Buffer> state;
    state.reserve(others.size());
    for (gpu::Buffer* const buffer : others) {
        state.push_back(std::move(*buffer));
    }
    recall(*other.time_s_, std::move(state));
}

bool MovingCloth::tear_triangles(pose::MeshData& layout, std::span<const glm::uvec2> torn) const
{
    bool is_any = false;
    for (const cloth::BrittleFace& face : sheets_.brittle_faces()) {
        const glm::uvec3 wanted = cloth::is_torn(face, torn) ? glm::uvec3(face.vertices.x) : face.vertices;
        glm::uvec4& triangle = layout.triangles[face.triangle];
        is_any = is_any || glm::uvec3(triangle) != wanted;
        triangle = glm::uvec4(wanted, triangle.w);
    }
    return is_any;
}

std::vector<glm::mat4> MovingCloth::places_of_draws(const pose::PoseData& pose) const
{
    std::vector<glm::mat4> places;
    for (const uint32_t draw : draws_) {
        const shared::DrawRecord& record = pose.draws[draw];
        places.push_back(record.first_skin_vertex == shared::no_skin ? record.anchor_from_object
                                                                     : pose.joints[record.first_joint]);
    }
    return places;
}

std::vector<SheetPlace> MovingCloth::sheet_places(const pose::PoseData& pose) const
{
    std::vector<SheetPlace> sheets;
    const std::vector<glm::mat4> places = places_of_draws(pose);
    const bool may_go = !all_hang_ || std::ranges::any_of(draws_, [&](uint32_t draw) {
        return pose.draws[draw].first_skin_vertex != shared::no_skin;
    });
    for (size_t i = 0; i < places.size(); ++i) {
        SheetPlace& sheet = sheets.emplace_back(SheetPlace{.box = box_about(reaches_[i], places[i])});
        if (!may_go) {
            // A hanging cloth sheet stays within the length of its diagonal from its held particles, and
            // stretches only a little.
            Bounds larger = reaches_[i];
            larger.extend(reaches_[i].min - reaches_[i].radius());
            larger.extend(reaches_[i].max + reaches_[i].radius());
            sheet.stays_in = box_about(larger, places[i]);
        }
    }
    return sheets;
}

std::vector<cloth::SheetReach> MovingCloth::stays_in(std::span<const SheetPlace> now)
{
    std::vector<cloth::SheetReach> boxes;
    for (const SheetPlace& sheet : now) {
        if (!sheet.stays_in) {
            return {};
        }
        boxes.push_back({.min_m = glm::vec3(sheet.stays_in->min), .max_m = glm::vec3(sheet.stays_in->max)});
    }
    std::vector<cloth::SheetReach> both = boxes;
    both.insert(both.end(), stayed_in_.begin(), stayed_in_.end());
    stayed_in_ = std::move(boxes);
    return both;
}

std::vector<Bounds> MovingCloth::sweep(const pose::PoseData& pose)
{
    std::vector<Bounds> now;
    for (const SheetPlace& sheet : sheet_places(pose)) {
        now.push_back(sheet.stays_in.value_or(pose::everywhere()));
    }
    std::vector<Bounds> swept = now;
    swept.insert(swept.end(), swept_before_.begin(), swept_before_.end());
    swept_before_ = std::move(now);
    return swept;
}

std::optional<ClothRun> MovingCloth::plan(const RenderSettings& settings, const StyleTables& style,
                                          std::optional<double> before_s) const
{
    constexpr double longest_gap_s = 10.0;
    const bool is_same_still = is_still_ && style.wind.from != wind::WindSource::smoke &&
                               settings.continuity == Continuity::still && !before_s &&
                               time_s_ == settings.time_s && animation_ == settings.animation &&
                               wind_ == style.wind && style_ == style.cloth;
    if (is_same_still) {
        return std::nullopt;
    }
    const bool goes_on = settings.continuity == Continuity::follows && time_s_ &&
                         *time_s_ <= settings.time_s && settings.time_s - *time_s_ < longest_gap_s;
    ClothRun run{.starts_anew = !goes_on, .is_taken_up = goes_on && is_taken_up_, .to_s = settings.time_s};
    run.from_s = goes_on ? *time_s_ : settings.time_s - style.cloth.settle_s;
    if (before_s) {
        run.snapshot_s = std::clamp(*before_s, run.from_s, run.to_s);
    }
    return run;
}

void MovingCloth::done(const RenderSettings& settings, const StyleTables& style, double time_s)
{
    time_s_ = time_s;
    is_still_ = settings.continuity == Continuity::still;
    animation_ = settings.animation;
    wind_ = style.wind;
    style_ = style.cloth;
    is_taken_up_ = false;
    has_moved = true;
}

cloth::Surroundings MovingCloth::surroundings(double time_s, const StyleTables& style,
                                              const RenderSettings& settings, const glm::dvec3& anchor) const
{
    cloth::Surroundings result{.time_s = time_s,
                               .wind = style.wind,
                               .origin_m = anchor,
                               .effort = style.cloth.effort,
                               .rest_m_per_s = 1e-3F * style.cloth.rest_mm_per_s};
    if (style.wind.blown_m >= 0.0F) {
        result.ahead_m = static_cast<double>(style.wind.blown_m) -
                         static_cast<double>(style.wind.speed_m_per_s) * settings.time_s;
    }
    return result;
}

std::vector<ClothSteps> MovingCloth::steps_between(double from_s, double to_s, const Scene& scene,
                                                   const StyleTables& style, const RenderSettings& settings,
                                                   const glm::dvec3& anchor) const
{
    std::vector<ClothSteps> result;
    if (!(to_s > from_s)) {
        return result;
    }
    const auto step_count = std::max(static_cast<uint32_t>(std::lround((to_s - from_s) / usual_step_s)), 1U);
    const double step_s = (to_s - from_s) / step_count;
    for (uint32_t done = 0; done < step_count;) {
        const double begin_s = from_s + done * step_s;
        cloth::Surroundings around = surroundings(begin_s, style, settings, anchor);
        around.step_s = static_cast<float>(step_s);
        const uint32_t most = sheets_.most_steps(around);
        const uint32_t at_once = scene.animations.empty() ? most : std::min(most, steps_between_poses);
        const uint32_t count = std::min(step_count - done, at_once);
        done += count;
        result.push_back(
            {.from_s = begin_s, .to_s = from_s + done * step_s, .count = count, .surroundings = around});
    }
    // The last step ends at exactly `to_s`, because the next picture compares the end of the simulation with
    // its own time.
    result.back().to_s = to_s;
    return result;
}

void MovingCloth::add_steps(gpu::Graph& graph, cloth::Cloths::Handles& handles, const ClothSteps& steps,
                            const pose::PoseData& pose, const glm::dvec3& anchor,
                            gpu::BufferId posed_vertices)
{
    const std::vector<glm::mat4> carried = carries(pose, anchor, steps.to_s - steps.from_s);
    if (!carried.empty()) {
        forget_before();
    }
    if (steps.takes_snapshot) {
        sheets_.add_snapshot(graph, handles);
    }
    sheets_.add_targets(graph, handles, posed_vertices);
    add_bodies(graph, handles, pose, posed_vertices);
    if (!carried.empty()) {
        sheets_.add_carry(graph, handles, carried);
    }
    sheets_.add_steps(graph, handles, steps.surroundings, steps.count);
}

void MovingCloth::place_solids(gpu::Device& device, const Scene& scene, const ClothPose& pose,
                               const pose::MeshData& layout, cloth::ClothBodies bodies)
{
    const std::vector<SheetPlace> sheets = sheet_places(pose.draws);
    if (grids_.follow_ground(scene, sheets, layout.anchor, pose.time_s)) {
        sheets_.set_grids(device, grids_.grids());
    }
    const glm::dmat4 anchor_from_world = glm::translate(glm::dmat4(1.0), -layout.anchor);
    std::vector<cloth::Solid> solids;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.collider == ClothCollider::none || node.mesh >= scene.meshes.size()) {
            continue;
        }
        const glm::dmat4 place = anchor_from_world * pose.nodes.world_from_node[i];
        const std::vector<glm::mat4> one{glm::mat4(1.0F)};
        for (const glm::mat4& instance : node.instances.empty() ? one : node.instances) {
            const glm::dmat4 own = place * glm::dmat4(instance);
            if (node.collider != ClothCollider::mesh) {
                solids.push_back(cloth::placed(solid_about(scene.meshes[node.mesh], node.collider), own));
            } else if (const auto solid = grids_.placed_mesh(node.mesh, own)) {
                solids.push_back(*solid);
            }
        }
    }
    const bool were_seen = std::exchange(are_seen_, bodies == cloth::ClothBodies::depth);
    if (are_seen_) {
        if (!were_seen) {
            tell_bodies(device, scene, layout);
        }
        for (uint32_t i = 0; i < bodies_->size(); ++i) {
            solids.push_back(placed_body(bodies_->at(i), layout, pose.draws, i));
        }
    } else {
        for (const BoneCapsule& bone : bones_) {
            solids.push_back(placed_bone(bone, pose.nodes, layout.anchor));
        }
    }
    if (const auto ground = grids_.ground()) {
        solids.push_back(*ground);
    }
    if (!scene.terrain && !layout.bounds.empty()) {
        const auto floor_m = static_cast<float>(layout.bounds.min.y - layout.anchor.y);
        solids.push_back(cloth::below({0.0F, floor_m, 0.0F}, {0.0F, 1.0F, 0.0F}));
    }
    sheets_.set_reach(stays_in(sheets));
    sheets_.set_solids(device, solids);
}

void MovingCloth::tell_bodies(gpu::Device& device, const Scene& scene, const pose::MeshData& layout)
{
    if (!bodies_) {
        bodies_ = seen_bodies(scene, layout);
    }
    std::vector<cloth::Body> meshes;
    for (const SeenBody& body : *bodies_) {
        meshes.push_back(body.mesh);
    }
    sheets_.set_bodies(device, meshes);
}

void MovingCloth::add_bodies(gpu::Graph& graph, cloth::Cloths::Handles& handles, const pose::PoseData& pose,
                             gpu::BufferId posed_vertices)
{
    if (!are_seen_) {
        joints_seen_.clear();
        return;
    }
    if (joints_seen_.empty() || joints_seen_ != pose.joints || morphs_seen_ != pose.morph_weights) {
        joints_seen_ = pose.joints;
        morphs_seen_ = pose.morph_weights;
        sheets_.add_bodies(graph, handles, posed_vertices);
    }
}

std::vector<glm::mat4> MovingCloth::carries(const pose::PoseData& pose, const glm::dvec3& anchor,
                                            double time_s)
{
    constexpr double quick_m_per_s = 25.0; // A node that moves faster than this is treated as having jumped
    constexpr double jump_m = 1.0;
    std::vector<glm::mat4> places = places_of_draws(pose);
    std::vector<glm::mat4> carries;
    if (places_before_.size() == places.size()) {
        const glm::dmat4 shift = glm::translate(glm::dmat4(1.0), anchor_before_ - anchor);
        bool is_any = anchor != anchor_before_;
        for (size_t i = 0; i < places.size(); ++i) {
            const glm::dmat4 before = shift * glm::dmat4(places_before_[i]);
            const glm::dmat4 now(places[i]);
            const bool jumps =
                glm::length(glm::dvec3(now[3] - before[3])) > jump_m + quick_m_per_s * time_s &&
                std::abs(glm::determinant(before)) > 0.0;
            carries.emplace_back(jumps ? now * glm::inverse(before) * shift : shift);
            is_any = is_any || jumps;
        }
        if (!is_any) {
            carries.clear();
        }
    }
    places_before_ = std::move(places);
    anchor_before_ = anchor;
    return carries;
}

} // namespace estampe::features
