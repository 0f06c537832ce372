// SPDX-License-Identifier: MIT
// Plans the ink of a picture on the CPU, stores the ink between pictures, and adds the passes.
#include "techniques/ink/ink.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "gpu/resources.hpp"
#include "shaders/ink_corners_comp.hpp"
#include "shaders/ink_lay_comp.hpp"
#include "shaders/ink_measure_comp.hpp"
#include "shaders/ink_source_comp.hpp"
#include "shaders/ink_step_comp.hpp"
#include "shaders/ink_stream_comp.hpp"
#include "techniques/ink/flow/flow.hpp"

namespace estampe::ink {
namespace {

constexpr double longest_gap_s = 1.0;
constexpr double most_fresh_steps = 96.0;
constexpr uint32_t most_face_cells = 1024;
constexpr float most_cells = 4e6F;
constexpr uint32_t unmeasured = 2;
constexpr uint32_t steps_between_measures = 4;

/// Share of the ink that is left after `seconds`. After the time `life_s`, a share of 1/e is left, about 37
/// percent.
float left_after(double seconds, float life_s)
{
    return static_cast<float>(std::exp(-seconds / static_cast<double>(life_s)));
}

uint32_t source_of(Source source)
{
    return source == Source::light    ? shared::ink_from_light
           : source == Source::things ? 0U
                                      : shared::ink_from_strokes;
}

/// Sets the waves and the wind that move the ink.
void set_flow(shared::InkGlobals& globals, const InkStyle& style, const Page& page, const View& view,
              const Waves& waves)
{
    for (size_t i = 0; i < waves.size(); ++i) {
        globals.waves[i] = waves.at(i).wave;
    }
    globals.wind_mm_per_s = wind_mm_per_s(style);
    const glm::vec3 right = glm::cross(view.forward, view.up);
    const glm::vec3 blows = globals.wind_mm_per_s.x * right - globals.wind_mm_per_s.y * view.up;
    globals.wind_axis = page.rad_per_mm * glm::cross(view.forward, blows);
    globals.map_mm_per_s = style.flow_mm_per_s;
}

void set_cover(shared::InkGlobals& globals, const InkStyle& style)
{
    globals.thin = glm::mix(0.004F, 0.06F, style.sharpness);
    globals.full = glm::mix(0.9F, 0.16F, style.sharpness);
    globals.opacity = style.opacity;
    globals.edge = style.edge;
    globals.budget = style.budget;
    globals.color = style.color;
    globals.thin_color = style.thin_color;
}

shared::InkGlobals globals_of(const InkStyle& style, const Page& page, const Grid& grid, const View& view,
                              const std::vector<shared::InkZone>& zones)
{
    const bool stays_on_page = style.follow == Follow::page;
    const bool is_on_surface = style.follow == Follow::surface;
    const glm::vec2 page_px(page.size_px);
    shared::InkGlobals globals{.before_from_clip = stays_on_page ? glm::mat4(1.0F) : view.before_from_clip,
                               .face_side = grid.face_side,
                               .zone_count = static_cast<uint32_t>(zones.size()),
                               .grid_size = grid.size,
                               .page_px = page.size_px,
                               .measured_px = page.size_px,
                               .margin_cells = grid.margin_cells,
                               .cells_per_px = grid.cells_per_px,
                               .mm_per_cell = grid.mm_per_cell,
                               .px_per_mm = page.pixels_per_mm,
                               .plane_depth = style.follow == Follow::advance ? view.plane_depth : 0.0F,
                               .drag = is_on_surface ? 1.0F : style.drag,
                               .page_mm = page.size_mm(),
                               .window_min_px = page.window_min_mm * page.pixels_per_mm,
                               .window_max_px = page.window_max_mm * page.pixels_per_mm,
                               .threshold = style.threshold,
                               .spot_mm = std::min(style.spot_mm, 0.5F * style.spacing_mm),
                               .spacing_mm = style.spacing_mm,
                               .seed = static_cast<uint32_t>(style.seed)};
    globals.clip_min_px = style.spills ? glm::vec2(-1.0F) : globals.window_min_px;
    globals.clip_max_px = style.spills ? page_px + 1.0F : globals.window_max_px;
    std::ranges::copy(zones, globals.zones);
    set_cover(globals, style);
    return globals;
}

shared::InkStep step_of(const InkStyle& style, const Waves& waves, const std::vector<shared::InkZone>& zones,
                        double time_s, double seconds)
{
    const float left = left_after(seconds, style.life_s);
    shared::InkStep step{.seconds = static_cast<float>(seconds),
                         .left = left,
                         .stain_left = left_after(seconds, style.stain_s),
                         .soak = style.soak * (1.0F - left),
                         .given = 1.0F - std::exp(-style.amount_per_s * static_cast<float>(seconds)),
                         .keeps = 1.0F};
    const auto phases = phases_at(waves, time_s);
    std::ranges::copy(phases, step.phases);
    for (size_t i = 0; i < zones.size(); ++i) {
        step.zone_streams[i] = stream_at(waves, phases, wind_mm_per_s(style), zones[i].middle_mm);
    }
    return step;
}

uint32_t first_variant_of(const InkStyle& style, const Grid& grid, const Time& time, const View& view)
{
    if (grid.face_side > 0) {
        return 0; // ink cells around the eye have fixed directions in the scene, so no motion moves the cells
    }
    const bool is_on_surface = style.follow == Follow::surface;
    const bool has_motion = view.has_motion && (is_on_surface || style.drag > 0.0F);
    const bool is_moved = !time.is_fresh && (has_motion || (view.is_moved && style.follow != Follow::page));
    return (is_moved ? shared::ink_is_moved : 0U) |
           (is_moved && is_on_surface ? shared::ink_on_surface : 0U) |
           (is_moved && has_motion ? shared::ink_has_motion : 0U) |
           (is_on_surface ? shared::ink_keeps_depth : 0U);
}

/// Rounds a number of cells up to a multiple of four, because the step shader reads rows four cells at a
/// time. The extra cells lie beyond the page's right edge.
uint32_t whole_fours(uint32_t cells)
{
    return (cells + 3) / 4 * 4;
}

} // namespace

Grid grid_of(const InkStyle& style, const Page& page)
{
    const glm::vec2 page_mm = page.size_mm();
    const float widest_mm =
        std::max({style.cell_mm, 1.0F / page.pixels_per_mm, std::sqrt(page_mm.x * page_mm.y / most_cells)});
    if (style.follow == Follow::around && page.rad_per_mm > 0.0F) {
        const float side = std::ceil(2.0F / (page.rad_per_mm * widest_mm));
        Grid grid{.cells_per_px = 1.0F / (widest_mm * page.pixels_per_mm),
                  .face_side = std::clamp(static_cast<uint32_t>(side), 16U, most_face_cells)};
        const uint32_t rows = grid.face_side + 2 * shared::ink_gutter;
        grid.size = {whole_fours(rows), 6 * rows};
        grid.mm_per_cell = 2.0F / (page.rad_per_mm * static_cast<float>(grid.face_side));
        return grid;
    }
    const bool is_larger = style.follow == Follow::turn || style.follow == Follow::advance;
    Grid grid{.cells_per_px = 1.0F / (widest_mm * page.pixels_per_mm), .mm_per_cell = widest_mm};
    const glm::vec2 cells = glm::ceil(glm::vec2(page.size_px) * grid.cells_per_px);
    grid.margin_cells = is_larger ? glm::ceil(0.5F * (style.oversize - 1.0F) * cells) : glm::vec2(0.0F);
    grid.size = glm::uvec2(cells + 2.0F * grid.margin_cells);
    grid.size.x = whole_fours(grid.size.x);
    return grid;
}

Time time_of(const InkStyle& style, double time_s, std::optional<double> before_s)
{
    const double gap_s = before_s ? time_s - *before_s : -1.0;
    const bool goes_on = gap_s >= 0.0 && gap_s <= longest_gap_s;
    const double length_s = goes_on ? gap_s : static_cast<double>(style.age_s);
    const double steps = std::ceil(length_s * static_cast<double>(style.steps_per_s) - 1e-6);
    return {.from_s = time_s - length_s,
            .to_s = time_s,
            .steps = static_cast<uint32_t>(std::clamp(steps, goes_on ? 0.0 : 1.0, most_fresh_steps)),
            .is_fresh = !goes_on};
}

Plan plan_of(const InkStyle& style, const Page& page, const Time& time, const View& view,
             const std::vector<shared::InkZone>& zones)
{
    Plan plan{.grid = grid_of(style, page), .time = time};
    const bool is_around = plan.grid.face_side > 0;
    const std::vector<shared::InkZone> flat_zones = is_around ? std::vector<shared::InkZone>() : zones;
    InkStyle swirling = style;
    swirling.swirl_mm_per_s *= 1.0F - style.solved;
    const Waves waves = is_around ? sphere_waves(style, 1.0F / page.rad_per_mm) : page_waves(swirling);
    plan.globals = globals_of(style, page, plan.grid, view, flat_zones);
    set_flow(plan.globals, style, page, view, waves);
    const double lives = time.to_s / static_cast<double>(style.spot_s);
    plan.spots = {.share = static_cast<float>(lives - std::floor(lives)),
                  .round = static_cast<uint32_t>(static_cast<int64_t>(std::floor(lives)))};
    plan.variant = source_of(style.source) | (is_around ? shared::ink_is_around : 0U) |
                   (!is_around && !style.flow_map.empty() ? shared::ink_has_map : 0U) |
                   (!flat_zones.empty() ? shared::ink_has_zones : 0U) |
                   (style.follow == Follow::surface ? shared::ink_spots_on_things : 0U);
    plan.first_variant = first_variant_of(style, plan.grid, time, view);
    // If only the camera or the scene moved, one step of zero duration moves the ink along.
    const bool is_moved = (plan.first_variant & shared::ink_is_moved) != 0;
    const uint32_t count = std::max(time.steps, is_moved ? 1U : 0U);
    const double seconds = count > 0 ? (time.to_s - time.from_s) / count : 0.0;
    const uint32_t every = time.is_fresh ? steps_between_measures : 1;
    for (uint32_t i = 0; i < count; ++i) {
        plan.steps.push_back(step_of(style, waves, flat_zones, time.from_s + (i + 1) * seconds, seconds));
        plan.steps.back().keeps = time.is_fresh && i == 0 ? 0.0F : 1.0F;
        plan.steps.back().sum_now = (count - 1 - i) % every == 0 ? 0 : unmeasured;
    }
    return plan;
}

Plan shown_on(const Plan& plan, const Page& page)
{
    Plan shown = plan;
    shown.steps.clear();
    shared::InkGlobals& globals = shown.globals;
    const float finer = page.pixels_per_mm / globals.px_per_mm;
    globals.page_px = page.size_px;
    globals.px_per_mm = page.pixels_per_mm;
    globals.cells_per_px /= finer;
    for (glm::vec2* const place_px :
         {&globals.window_min_px, &globals.window_max_px, &globals.clip_min_px, &globals.clip_max_px}) {
        *place_px *= finer;
    }
    return shown;
}

void add_stream(Plan& plan, std::vector<float> stream)
{
    if (plan.grid.face_side > 0) {
        return;
    }
    constexpr uint32_t side = shared::ink_map_side;
    const auto nearest = [&](glm::vec2 place_mm) {
        const glm::vec2 node = glm::round(place_mm / plan.globals.page_mm * static_cast<float>(side - 1));
        const glm::uvec2 at(glm::clamp(node, 0.0F, static_cast<float>(side - 1)));
        return stream.at(at.y * side + at.x);
    };
    for (shared::InkStep& step : plan.steps) {
        for (uint32_t i = 0; i < plan.globals.zone_count; ++i) {
            step.zone_streams[i] += nearest(plan.globals.zones[i].middle_mm);
        }
    }
    plan.variant |= shared::ink_has_map;
    plan.globals.map_mm_per_s = 1.0F;
    plan.stream = std::move(stream);
}

void add_blast(Plan& plan, const PageBlast& blast)
{
    const uint32_t number = plan.globals.blast_count;
    if (plan.grid.face_side > 0 || number == shared::most_ink_blasts) {
        return;
    }
    double time_s = plan.time.from_s;
    bool moves_ink = false;
    for (shared::InkStep& step : plan.steps) {
        const float before = blast.cubed_radius_mm3(time_s);
        time_s += static_cast<double>(step.seconds);
        step.blast_cubes_mm3[number] = {before, blast.cubed_radius_mm3(time_s)};
        moves_ink = moves_ink || step.blast_cubes_mm3[number].y > before;
    }
    if (moves_ink) {
        plan.globals.blasts_mm[number] = blast.middle_mm;
        plan.globals.blast_count = number + 1;
        plan.variant |= shared::ink_has_blasts;
    }
}

namespace {

constexpr uint64_t sums_bytes = 16; // smallest size of the buffer of sums

template <class T>
gpu::Buffer mapped_buffer(gpu::Device& device, const char* name, std::span<const T> items)
{
    gpu::Buffer buffer(device, name, std::max<size_t>(items.size_bytes(), sizeof(glm::vec4)),
                       gpu::MemoryUse::upload);
    std::ranges::copy(std::as_bytes(items), buffer.mapped().begin());
    return buffer;
}

} // namespace

std::array<uint64_t, 3> Memory::kept_bytes(const Grid& grid)
{
    const uint64_t count = grid.cell_count();
    // Ink in a cube around the eye stores no depths.
    return {sizeof(uint32_t) * count, sizeof(float) * (grid.face_side > 0 ? 4 : count), sums_bytes};
}

void Memory::make_room(gpu::Device& device, const Grid& grid)
{
    const auto bytes = kept_bytes(grid);
    for (gpu::Buffer& cells : cells_) {
        cells = gpu::Buffer(device, "ink cells", bytes[0], gpu::MemoryUse::device);
    }
    for (gpu::Buffer& depths : depths_) {
        depths = gpu::Buffer(device, "ink depths", bytes[1], gpu::MemoryUse::device);
    }
    grid_ = grid;
    forget();
}

void Memory::ensure(gpu::Device& device, const InkStyle& style, const Plan& plan)
{
    if (grid_ != plan.grid || cells_.front().empty()) {
        make_room(device, plan.grid);
    }
    if (plan.time.is_fresh || sums_.empty()) {
        sums_ = gpu::upload_buffer(device, "ink sums", std::vector<std::byte>(sums_bytes));
        sum_now_ = 0;
    }
    show(device, plan);
    mask_ = mapped_buffer(device, "ink mask", std::span<const uint32_t>(plan.mask));
    zone_shapes_ = mapped_buffer(device, "ink zones", std::span<const float>(plan.zone_shapes));
    const bool has_map = (plan.variant & shared::ink_has_map) != 0;
    const bool has_picture = has_map && !style.flow_map.empty();
    if (has_picture && (map_file_ != style.flow_map || map_page_mm_ != plan.globals.page_mm)) {
        map_stream_ = stream_of_flow(read_flow(style.flow_map, style.scope), plan.globals.page_mm);
        map_file_ = style.flow_map;
        map_page_mm_ = plan.globals.page_mm;
        holds_picture_ = false;
    }
    if (!plan.stream.empty()) {
        std::vector<float> stream = plan.stream;
        for (size_t i = 0; has_picture && i < stream.size(); ++i) {
            stream[i] += style.flow_mm_per_s * map_stream_[i];
        }
        map_ = gpu::upload_buffer(device, "ink flow map", stream);
        holds_picture_ = false;
    } else if (map_.empty() || (has_picture && !holds_picture_)) {
        map_ = gpu::upload_buffer(device, "ink flow map", has_picture ? map_stream_ : std::vector<float>(4));
        holds_picture_ = has_picture;
    }
}

void Memory::show(gpu::Device& device, const Plan& plan)
{
    globals_ = mapped_buffer(device, "ink", std::span(&plan.globals, 1));
}

void Memory::end_picture(const Plan& plan)
{
    time_s_ = plan.time.to_s;
}

std::optional<Memory::Kept> Memory::kept() const
{
    return time_s_ ? std::optional(Kept{grid_, *time_s_, sum_now_}) : std::nullopt;
}

std::array<gpu::Buffer*, 3> Memory::kept_buffers()
{
    return {&cells_.at(newest_), &depths_.at(newest_depth_), &sums_};
}

void Memory::recall(gpu::Device& device, const Kept& kept, std::array<gpu::Buffer, 3> buffers)
{
    make_room(device, kept.grid);
    cells_.at(newest_) = std::move(buffers[0]);
    depths_.at(newest_depth_) = std::move(buffers[1]);
    sums_ = std::move(buffers[2]);
    sum_now_ = kept.sum_now;
    time_s_ = kept.time_s;
}

/// The ink passes of one picture, and their results.
class Passes {
public:
    Passes(gpu::Graph& graph, Memory& memory, const Plan& plan)
        : graph_(graph), memory_(memory), plan_(plan),
          globals_(gpu::import_whole(graph, "ink", memory.globals_)),
          cells_{gpu::import_whole(graph, "ink/even", memory.cells_[0]),
                 gpu::import_whole(graph, "ink/odd", memory.cells_[1])},
          sums_(gpu::import_whole(graph, "ink/sums", memory.sums_))
    {
    }

    void add_steps(const Inputs& in)
    {
        const gpu::BufferId source = add_corners(add_source(in));
        for (size_t i = 0; i < plan_.steps.size(); ++i) {
            shared::InkStep step = plan_.steps[i];
            step.sum_before = memory_.sum_now_;
            step.sum_now = step.sum_now < 2 ? 1 - memory_.sum_now_ : step.sum_now;
            add_step(in, source, step, i == 0 ? plan_.first_variant : 0);
            if (step.sum_now < 2) {
                memory_.sum_now_ = step.sum_now;
                add_measure(in.frame);
            }
        }
    }

    [[nodiscard]] Flowing flowing() const
    {
        return {.globals = globals_,
                .cells = cells_.at(memory_.newest_),
                .sums = sums_,
                .sum_now = memory_.sum_now_,
                .variant = plan_.variant & shared::ink_is_around};
    }

private:
    gpu::BufferId add_source(const Inputs& in)
    {
        auto pass = graph_.compute("ink/source", shaders::ink_source_comp);
        pass.uniform(in.frame).uniform(globals_);
        pass.sample(in.hatch, gpu::Sampling::linear).sample(in.lines, gpu::Sampling::linear);
        pass.sample(in.light, gpu::Sampling::linear).sample(in.draw);
        pass.sample(gpu::import_whole(graph_, "ink/mask", memory_.mask_), gpu::Format::r32ui);
        pass.sample(cells_.at(memory_.newest_), gpu::Format::r32ui)
            .sample(in.coordinate)
            .sample(in.footprint)
            .sample(in.depth)
            .sample(gpu::import_whole(graph_, "ink/zones", memory_.zone_shapes_), gpu::Format::r32f);
        const glm::uvec2 size = plan_.grid.size;
        const gpu::BufferId source = pass.write(
            graph_.buffer("ink/source", {.size_bytes = sizeof(uint32_t) * uint64_t{size.x} * size.y}));
        const uint32_t strip =
            (plan_.variant & shared::ink_in_strips) != 0 ? uint32_t{shared::ink_strip} : 1U;
        pass.push(plan_.spots)
            .variant(plan_.variant | (plan_.mask.empty() ? 0U : shared::ink_has_mask))
            .dispatch_over(size.x, (size.y + strip - 1) / strip);
        return source;
    }

    /// Packs each cell's source with those of its neighbours.
    gpu::BufferId add_corners(gpu::BufferId source)
    {
        const glm::uvec2 size = plan_.grid.size;
        auto pass = graph_.compute("ink/corners", shaders::ink_corners_comp);
        pass.uniform(globals_).sample(source, gpu::Format::r32ui);
        const gpu::BufferId corners = pass.write(
            graph_.buffer("ink/corners", {.size_bytes = sizeof(uint32_t) * uint64_t{size.x} * size.y}));
        pass.dispatch_over(size.x, size.y);
        return corners;
    }

    /// For ink in a cube around the eye, the step shader computes the flow per cell, and no pass stores the
    /// flow.
    gpu::BufferId add_stream(const shared::InkStep& step)
    {
        const gpu::BufferId map = gpu::import_whole(graph_, "ink/flow map", memory_.map_);
        if (plan_.grid.face_side > 0) {
            return map;
        }
        const glm::uvec2 nodes = plan_.grid.size / shared::ink_node_cells + 4U;
        auto pass = graph_.compute("ink/stream", shaders::ink_stream_comp);
        pass.uniform(globals_).sample(map, gpu::Format::r32f).sample(map, gpu::Format::r32f);
        pass.sample(gpu::import_whole(graph_, "ink/zones", memory_.zone_shapes_), gpu::Format::r32f);
        const gpu::BufferId stream = pass.write(
            graph_.buffer("ink/stream", {.size_bytes = sizeof(float) * uint64_t{nodes.x} * nodes.y}));
        pass.push(step).variant(plan_.variant).dispatch_over(nodes.x, nodes.y);
        return stream;
    }

    void add_step(const Inputs& in, gpu::BufferId source, const shared::InkStep& step, uint32_t more)
    {
        const uint32_t before = memory_.newest_;
        const uint32_t now = 1 - before;
        const uint32_t depth_now = 1 - memory_.newest_depth_;
        const bool keeps_depth = (more & shared::ink_keeps_depth) != 0;
        const gpu::BufferId stream = add_stream(step);
        auto pass = graph_.compute("ink/step", shaders::ink_step_comp);
        pass.uniform(globals_)
            .sample(cells_.at(before), gpu::Format::r32ui)
            .sample(cells_.at(before), gpu::Format::rgba32ui)
            .sample(source, gpu::Format::r32ui);
        pass.sample(stream, gpu::Format::r32f).sample(in.depth);
        // Only the first step reads and writes depths; later steps get a placeholder.
        pass.sample(keeps_depth ? depths(memory_.newest_depth_)
                                : gpu::import_whole(graph_, "ink/flow map", memory_.map_),
                    gpu::Format::r32f);
        pass.sample(in.motion.value_or(in.depth));
        sums_ = pass.modify(sums_);
        cells_.at(now) = pass.write(cells_.at(now));
        std::ignore =
            pass.write(keeps_depth ? depths(depth_now)
                                   : graph_.buffer("ink/no depth", {.size_bytes = sizeof(glm::vec4)}));
        pass.push(step).variant(plan_.variant | more);
        pass.dispatch_over(plan_.grid.size.x, plan_.grid.size.y);
        memory_.newest_ = now;
        memory_.newest_depth_ = keeps_depth ? depth_now : memory_.newest_depth_;
    }

    void add_measure(gpu::BufferId frame)
    {
        auto pass = graph_.compute("ink/measure", shaders::ink_measure_comp);
        pass.uniform(frame).uniform(globals_).sample(cells_.at(memory_.newest_), gpu::Format::r32ui);
        sums_ = pass.modify(sums_);
        const glm::uvec2 measured = (plan_.globals.measured_px + 1U) / 2U;
        pass.push(shared::InkMeasure{.sum_now = memory_.sum_now_})
            .variant(plan_.variant & shared::ink_is_around)
            .dispatch_over(measured.x, (measured.y + shared::ink_block - 1) / shared::ink_block);
    }

    gpu::BufferId depths(uint32_t which)
    {
        return gpu::import_whole(graph_, which == 0 ? "ink/depth even" : "ink/depth odd",
                                 memory_.depths_.at(which));
    }

    gpu::Graph& graph_;
    Memory& memory_;
    const Plan& plan_;
    gpu::BufferId globals_;
    std::array<gpu::BufferId, 2> cells_;
    gpu::BufferId sums_;
};

Flowing add_steps(gpu::Graph& graph, Memory& memory, const Plan& plan, const Inputs& in)
{
    Passes passes(graph, memory, plan);
    if (!plan.steps.empty()) {
        passes.add_steps(in);
    }
    return passes.flowing();
}

Flowing add_standing(gpu::Graph& graph, Memory& memory, const Plan& plan)
{
    return Passes(graph, memory, plan).flowing();
}

gpu::ImageId add_layer(gpu::Graph& graph, const Flowing& ink, gpu::BufferId frame, glm::uvec2 size_px)
{
    auto pass = graph.compute("ink/lay", shaders::ink_lay_comp);
    pass.uniform(frame).uniform(ink.globals).sample(ink.cells, gpu::Format::r32ui).read(ink.sums);
    const gpu::ImageId layer = pass.write(
        graph.image("ink/layer", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba8}));
    pass.push(shared::InkMeasure{.sum_now = ink.sum_now}).variant(ink.variant);
    pass.dispatch_over_page(size_px.x, size_px.y);
    return layer;
}

} // namespace estampe::ink
