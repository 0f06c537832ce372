// SPDX-License-Identifier: MIT
// Memory layout of sheets on the device.
#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>

#include <estampe/error.hpp>

#include "gpu/resources.hpp"
#include "techniques/cloth/cloth.hpp"

namespace estampe::cloth {
namespace {

uint32_t whole_groups(size_t count)
{
    constexpr uint32_t group = shared::cloth_group;
    return (static_cast<uint32_t>(count) + group - 1) / group;
}

/// Appends the lists of one sheet, with padding, to the lists of all sheets.
template <class Item>
uint32_t append(std::vector<Item>& all, const Lists<Item>& lists, uint32_t count, uint32_t stride)
{
    const auto first = static_cast<uint32_t>(all.size());
    for (uint32_t k = 0; k < lists.width; ++k) {
        const auto row = lists.items.begin() + static_cast<ptrdiff_t>(k) * count;
        all.insert(all.end(), row, row + count);
        all.resize(all.size() + stride - count);
    }
    return first;
}

} // namespace

bool is_torn(const BrittleFace& face, std::span<const glm::uvec2> torn)
{
    return std::ranges::any_of(face.sides, [&](const glm::uvec2& side) {
        return (torn[side.x][static_cast<int>(side.y / 32)] >> (side.y % 32) & 1U) != 0;
    });
}

void Cloths::find_brittle_faces(const Structure& structure, const DrawnSheet& drawn)
{
    for (const DrawnFace& face : drawn.faces) {
        BrittleFace& brittle =
            brittle_faces_.emplace_back(BrittleFace{.triangle = face.triangle, .vertices = face.vertices});
        for (int k = 0; k < 3; ++k) {
            const uint32_t from = face.particles[k];
            brittle.sides.at(static_cast<size_t>(k)) = {
                particle_count_ + from, link_bit(structure, from, face.particles[(k + 1) % 3])};
        }
    }
}

std::vector<gpu::Buffer*> Cloths::state()
{
    std::vector<gpu::Buffer*> buffers{&places_, &speeds_};
    if (may_tear_) {
        buffers.push_back(&torn_);
    }
    return buffers;
}

void Cloths::recall(std::vector<gpu::Buffer> state)
{
    places_ = std::move(state.at(0));
    speeds_ = std::move(state.at(1));
    if (may_tear_) {
        torn_ = std::move(state.at(2));
    }
    forget_before();
}

void Cloths::lay_out(gpu::Device& device, std::span<const Sheet> sheets, std::span<const DrawnSheet> drawn)
{
    std::vector<shared::ClothLink> links;
    std::vector<glm::uvec2> faces;
    std::vector<Tether> tethers;
    std::vector<glm::vec4> places;
    std::vector<glm::vec4> pushes;
    std::vector<glm::vec4> rest;
    std::vector<uint32_t> by_colour;
    for (size_t number = 0; number < sheets.size(); ++number) {
        const Sheet& sheet = sheets[number];
        const Structure structure = build_structure(sheet);
        const auto count = static_cast<uint32_t>(sheet.rest_m.size());
        const uint32_t stride = whole_groups(count) * shared::cloth_group;
        const GridForm grid = structure.grid.value_or(GridForm{});
        const Cloth& cloth = sheet.cloth;
        records_.push_back({.first = particle_count_,
                            .count = count,
                            .stride = stride,
                            .columns = grid.columns,
                            .rows = grid.rows,
                            .link_width = structure.links.width,
                            .first_link = append(links, structure.links, count, stride),
                            .face_width = structure.faces.width,
                            .first_face = append(faces, structure.faces, count, stride),
                            .tether_width = structure.tethers.width,
                            .first_tether = append(tethers, structure.tethers, count, stride),
                            .spacing_x_m = grid.spacing_m.x,
                            .spacing_y_m = grid.spacing_m.y,
                            .softness = structure.softness,
                            .fold = cloth.fold,
                            .mass_kg_m2 = cloth.density_kg_m2,
                            .drag = cloth.drag,
                            .lift = cloth.lift,
                            .damping_per_s = cloth.damping_per_s,
                            .friction = cloth.friction,
                            .thickness_m = cloth.thickness_m,
                            .winding = grid.winding,
                            .self_m = cloth.self_m,
                            .tear = cloth.tear});
        may_tear_ = may_tear_ || cloth.tear > 0.0F;
        if (number < drawn.size()) {
            find_brittle_faces(structure, drawn[number]);
        }
        auto& colours = colours_.emplace_back();
        for (const std::vector<uint32_t>& colour : structure.colours) {
            colours.emplace_back(by_colour.size(), colour.size());
            by_colour.insert(by_colour.end(), colour.begin(), colour.end());
            by_colour.resize(size_t{whole_groups(by_colour.size())} * shared::cloth_group,
                             shared::cloth_no_vertex);
        }
        rigidities_n_m_.push_back(cloth.bending_n_m);
        bending_rates_s2_.push_back(structure.bending_rate_s2);
        solvers_.push_back(cloth.solver);
        for (uint32_t i = 0; i < stride; ++i) {
            const float held =
                i < count && !sheet.held.empty() ? glm::clamp(sheet.held[i], 0.0F, 1.0F) : 0.0F;
            const float inverse_mass = i < count && held < 1.0F ? 1.0F / structure.masses_kg[i] : 0.0F;
            const float shares = i < count ? structure.link_shares[i] : 0.0F;
            places.emplace_back(i < count ? sheet.rest_m[i] : glm::vec3(0.0F), inverse_mass);
            rest.push_back(places.back());
            pushes.emplace_back(0.0F, 0.0F, 0.0F, inverse_mass * shares);
            held_.push_back(held);
            has_half_held_ = has_half_held_ || (held > 0.0F && held < 1.0F);
        }
        particle_count_ += stride;
    }
    links_ = gpu::upload_buffer(device, "cloth links", links);
    faces_ = gpu::upload_buffer(device, "cloth faces", faces);
    tethers_ = gpu::upload_buffer(device, "cloth tethers", tethers);
    by_colour_ = gpu::upload_buffer(device, "cloth by colour", by_colour);
    const bool keeps_from_itself =
        std::ranges::any_of(records_, [](const shared::ClothSheet& sheet) { return sheet.self_m > 0.0F; });
    rest_ =
        gpu::upload_buffer(device, "cloth at rest", keeps_from_itself ? rest : std::vector(1, glm::vec4()));
    near_ = gpu::Buffer(device, "cloth near", sizeof(glm::uvec4) * (keeps_from_itself ? particle_count_ : 1),
                        gpu::MemoryUse::device);
    places_ = gpu::upload_buffer(device, "cloth places", places);
    places_before_ = gpu::upload_buffer(device, "cloth places before", places);
    pushes_ = gpu::upload_buffer(device, "cloth pushes", pushes);
    speeds_ = gpu::upload_buffer(device, "cloth speeds", std::vector<glm::vec4>(particle_count_));
    torn_ =
        gpu::upload_buffer(device, "cloth torn", std::vector<glm::uvec2>(may_tear_ ? particle_count_ : 2));
    for (gpu::Buffer& predicted : predicted_) {
        predicted = gpu::Buffer(device, "cloth predicted", places_.size_bytes(), gpu::MemoryUse::device);
    }
    const size_t record_count = std::max<size_t>(records_.size(), shared::cloth_few_sheets);
    sheets_ = gpu::Buffer(device, "cloth sheets", record_count * sizeof(shared::ClothSheet),
                          gpu::MemoryUse::upload);
    carries_ =
        gpu::Buffer(device, "cloth carries", records_.size() * sizeof(glm::mat4), gpu::MemoryUse::upload);
}

uint32_t Cloths::variant_of(size_t sheet) const
{
    return solver_of(sheet).bits | (records_[sheet].columns > 0 ? shared::cloth_bit_grid : 0U) |
           (records_[sheet].self_m > 0.0F ? shared::cloth_bit_self : 0U) |
           (records_[sheet].tear > 0.0F ? shared::cloth_bit_tear : 0U);
}

bool Cloths::is_small(size_t sheet) const
{
    return solver_of(sheet).takes_small_sheets && (variant_of(sheet) & ~shared::cloth_bit_grid) == 0 &&
           records_[sheet].count <= shared::cloth_small_sheet &&
           records_[sheet].columns <= shared::cloth_small_group; // a thread's particles are in one column
}

void Cloths::group_sheets(gpu::Device& device)
{
    // For each group of threads, its sheet and its first particle; for small sheets only the sheet.
    std::vector<uint32_t> groups;
    const auto append_in_order = [&](uint32_t sheet) {
        for (uint32_t first = 0; first < records_[sheet].count; first += shared::cloth_group) {
            groups.insert(groups.end(), {sheet, first});
        }
    };
    const auto append_large = [&](uint32_t sheet) {
        const shared::ClothSheet& record = records_[sheet];
        if (record.columns == 0) {
            append_in_order(sheet);
        }
        for (uint32_t row = 0; row < record.rows; row += shared::cloth_tile_side) {
            for (uint32_t column = 0; column < record.columns; column += shared::cloth_tile_side) {
                groups.insert(groups.end(), {sheet, row * record.columns + column});
            }
        }
    };
    const auto sheet_count = static_cast<uint32_t>(records_.size());
    // Sheets by (is large, variant, solver); large sheets come first.
    std::map<std::tuple<bool, uint32_t, const Solver*>, std::vector<uint32_t>> alike;
    for (uint32_t sheet = 0; sheet < sheet_count; ++sheet) {
        append_in_order(sheet);
        alike[{is_small(sheet), variant_of(sheet), &solver_of(sheet)}].push_back(sheet);
    }
    all_groups_ = static_cast<uint32_t>(groups.size() / 2);
    kinds_.clear();
    for (const auto& [key, members] : alike) {
        const auto& [is_small, variant, solver] = key;
        Kind kind{.solver = solver, .variant = variant, .is_small = is_small};
        kind.first_group = static_cast<uint32_t>(kind.is_small ? groups.size() : groups.size() / 2);
        for (const uint32_t sheet : members) {
            kind.most_particles = std::max(kind.most_particles, records_[sheet].count);
            if (kind.is_small) {
                groups.push_back(sheet);
            } else {
                append_large(sheet);
            }
        }
        if (!kind.is_small && members.size() == 1) {
            kind.lone = members.front();
        }
        kind.group_count = static_cast<uint32_t>(groups.size()) / (kind.is_small ? 1 : 2) - kind.first_group;
        if (kind.solver->sweeps > 0) {
            append_colours(kind, groups);
        }
        kind.run = gpu::Buffer(device, "cloth run", sizeof(shared::ClothRun), gpu::MemoryUse::upload);
        kinds_.push_back(std::move(kind));
    }
    sheet_of_group_ = gpu::upload_buffer(device, "cloth groups", groups);
}

void Cloths::lay_out_vertices(gpu::Device& device, std::span<const DrawnSheet> drawn)
{
    std::vector<shared::ClothHold> holds;
    for (const float held : held_) {
        holds.push_back({.vertex = shared::cloth_no_vertex, .share = held});
    }
    std::vector<shared::ClothVertex> vertices;
    std::vector<uint32_t> groups;
    constexpr uint32_t grid = shared::cloth_bit_grid;
    constexpr uint32_t tear = shared::cloth_bit_tear;
    for (const uint32_t variant : {0U, grid, tear, grid | tear}) {
        Kind kind{.variant = variant, .first_group = static_cast<uint32_t>(groups.size())};
        for (size_t sheet = 0; sheet < drawn.size(); ++sheet) {
            const auto& particles = drawn[sheet].particle_of_vertex;
            if ((variant_of(sheet) & (grid | tear)) != variant) {
                continue;
            }
            for (uint32_t i = 0; i < particles.size(); ++i) {
                vertices.push_back({.vertex = drawn[sheet].first_vertex + i, .particle = particles[i]});
                holds[records_[sheet].first + particles[i]].vertex = drawn[sheet].first_vertex + i;
            }
            for (uint32_t i = 0; drawn[sheet].first_back_vertex && i < particles.size(); ++i) {
                vertices.push_back({.vertex = *drawn[sheet].first_back_vertex + i,
                                    .particle = particles[i] | shared::cloth_on_back});
            }
            const uint32_t group_count =
                whole_groups(particles.size() * (drawn[sheet].first_back_vertex ? 2 : 1));
            groups.insert(groups.end(), group_count, static_cast<uint32_t>(sheet));
            vertices.resize(groups.size() * shared::cloth_group, {.vertex = shared::cloth_no_vertex});
            kind.group_count += group_count;
        }
        if (kind.group_count > 0) {
            vertex_kinds_.push_back(std::move(kind));
        }
    }
    holds_ = gpu::upload_buffer(device, "cloth holds", holds);
    vertices_ = gpu::upload_buffer(device, "cloth vertices", vertices);
    sheet_of_vertex_group_ = gpu::upload_buffer(device, "cloth vertex groups", groups);
}

Cloths::Cloths(gpu::Device& device, std::span<const Sheet> sheets, std::span<const DrawnSheet> drawn)
{
    lay_out(device, sheets, drawn);
    set_wide(device, device.execution().shares_by_groups());
    group_sheets(device);
    lay_out_vertices(device, drawn);
    std::vector<glm::vec4> targets;
    for (size_t i = 0; i < sheets.size(); ++i) {
        for (uint32_t k = 0; k < records_[i].stride; ++k) {
            const glm::vec3 place = k < records_[i].count ? sheets[i].rest_m[k] : glm::vec3(0.0F);
            targets.emplace_back(place, held_[targets.size()]);
        }
    }
    for (gpu::Buffer& buffer : targets_) {
        buffer = gpu::upload_buffer(device, "cloth targets", targets);
    }
    set_grids(device, {});
    set_bodies(device, {});
    set_flows(device, {});
    set_solids(device, {});
    rouses_all_ = false;
}

void Cloths::set_solver(gpu::Device& device, std::optional<ClothSolver> solver)
{
    if (solver_ != solver) {
        solver_ = solver;
        rouses_all_ = true;
        group_sheets(device);
    }
}

void Cloths::set_wide(const gpu::Device& device, bool is_wide)
{
    const VkPhysicalDeviceLimits& limits = device.limits();
    const uint32_t most_threads =
        std::min(limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0]);
    is_wide_ = is_wide && shared::cloth_wide_group <= most_threads;
}

void Cloths::set_solids(gpu::Device& device, std::span<const Solid> solids)
{
    solids_before_ = std::move(solids_);
    solids_.clear();
    const auto first_of = [&](const Solid& solid) {
        if (solid.kind == SolidKind::seen) {
            return bodies_.at(solid.grid).first;
        }
        return solid.grid < first_of_grid_.size() ? first_of_grid_[solid.grid] : 0;
    };
    for (const Solid& solid : solids) {
        solids_.push_back(as_shared(solid, first_of(solid)));
    }
    if (solids_before_.size() != solids_.size()) {
        solids_before_ = solids_;
        rouses_all_ = true;
    }
    for (size_t i = 0; i < solids.size(); ++i) {
        turn_alike(solids_before_[i], solids_[i]);
        // The solid's grid now covers a different part of the ground, so the change of heights is no motion.
        if (solids[i].kind == SolidKind::heights) {
            solids_before_[i] = solids_[i];
        }
    }
    const uint64_t size_bytes = 2 * std::max<size_t>(solids_.size(), 1) * sizeof(shared::ClothCollider);
    if (colliders_.empty() || colliders_.size_bytes() < size_bytes) {
        colliders_ = gpu::Buffer(device, "cloth colliders", size_bytes, gpu::MemoryUse::upload);
    }
}

void Cloths::set_grids(gpu::Device& device, std::span<const SolidGrid> grids)
{
    std::vector<float> numbers;
    first_of_grid_.clear();
    for (const SolidGrid& grid : grids) {
        first_of_grid_.push_back(static_cast<uint32_t>(numbers.size()));
        for (int axis = 0; axis < 3; ++axis) {
            numbers.push_back(static_cast<float>(grid.nodes[axis]));
        }
        for (int axis = 0; axis < 3; ++axis) {
            numbers.push_back(grid.half_m[axis]);
        }
        numbers.insert(numbers.end(), grid.values_m.begin(), grid.values_m.end());
    }
    if (numbers.size() > UINT32_MAX >> shared::cloth_kind_bits) {
        throw Error("grids for cloth to run into have too many numbers");
    }
    numbers.resize(std::max<size_t>(numbers.size(), 4));
    grids_ = gpu::upload_buffer(device, "cloth grids", numbers);
    rouses_all_ = true;
}

void Cloths::set_flows(gpu::Device& device, std::span<const Flow> flows)
{
    if (flows.size() > shared::cloth_most_flows) {
        throw std::logic_error("more boxes of air than cloth knows of");
    }
    flows_.clear();
    uint32_t cell_count = 0;
    for (const Flow& flow : flows) {
        flows_.push_back(
            {.cells_from_place = flow.cells_from_place, .cells = flow.cells, .first = cell_count});
        cell_count += flow.cells.x * flow.cells.y * flow.cells.z;
    }
    const uint64_t size_bytes = sizeof(glm::vec4) * std::max(cell_count, 1U);
    if (flow_speeds_.empty() || flow_speeds_.size_bytes() < size_bytes) {
        flow_speeds_ =
            gpu::upload_buffer(device, "cloth flows", std::vector<glm::vec4>(std::max(cell_count, 1U)));
    }
}

void Cloths::set_targets(gpu::Device& device, std::span<const glm::vec3> places_m)
{
    std::vector<glm::vec4> targets(particle_count_, glm::vec4(0.0F));
    size_t next = 0;
    for (const shared::ClothSheet& record : records_) {
        for (uint32_t i = 0; i < record.count; ++i) {
            targets[record.first + i] = glm::vec4(places_m[next++], held_[record.first + i]);
        }
    }
    std::swap(targets_[0], targets_[1]);
    targets_[1] = gpu::upload_buffer(device, "cloth targets", targets);
    targets_move_ = has_targets_;
    has_targets_ = true;
}

} // namespace estampe::cloth
