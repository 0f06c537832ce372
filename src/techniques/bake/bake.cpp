// SPDX-License-Identifier: MIT
#include "techniques/bake/bake.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/file.hpp"
#include "core/luminance.hpp"
#include "scene/charts/charts.hpp"
#include "techniques/bake/fingerprint.hpp"
#include "techniques/bake/spread.hpp"
#include "techniques/bake/tracer.hpp"

namespace estampe::bake {
namespace {

constexpr uint32_t paths_a_visit = 8; // of one texel, before the next texel's turn
constexpr uint64_t texels_a_block = 512;
constexpr uint64_t blocks_at_once = 32; // between two looks at the clock
constexpr float most_backs =
    0.6F; // a texel from which more paths meet the back of something lies inside of it

/// What the paths of a texel have brought so far.
struct Sum {
    glm::vec3 light{0.0F};
    float square = 0.0F; ///< of brightness
    float backs = 0.0F;
};

static_assert(sizeof(Sum) == 20);

/// What a file of unfinished work begins with.
struct ProgressHeader {
    std::array<char, 16> mark{"estampe bake 1\n"};
    uint64_t fingerprint = 0;
    uint64_t next_block = 0;
    uint64_t texel_count = 0;
};

/// Charts of the triangles that take light, drawn by drawn.
charts::Atlas make_atlas(const StaticTriangles& triangles, const Surfaces& surfaces, uint32_t size)
{
    std::vector<charts::Chart> cut;
    for (size_t i = 0; i < triangles.draws.size(); ++i) {
        const StaticDraw& draw = triangles.draws[i];
        if (draw.triangle_count == 0 || !surfaces.receives(draw.first_triangle)) {
            continue;
        }
        const size_t first = 3 * static_cast<size_t>(draw.first_triangle);
        const size_t count = 3 * static_cast<size_t>(draw.triangle_count);
        const std::span<const glm::vec3> corners(&triangles.positions[first], count);
        std::optional<charts::Chart> own;
        if (triangles.has_uv_1[i]) {
            own = charts::own_chart(corners, std::span<const glm::vec2>(&triangles.uvs[1][first], count));
        }
        for (charts::Chart& chart :
             own ? std::vector<charts::Chart>{std::move(*own)} : charts::cut_charts(corners)) {
            for (uint32_t& triangle : chart.triangles) {
                triangle += draw.first_triangle;
            }
            cut.push_back(std::move(chart));
        }
    }
    if (cut.empty()) {
        throw Error("nothing that takes light stands still", {}, "a lightmap is for meshes that do not move");
    }
    return charts::pack_charts(cut, triangles.count(), size);
}

/// The n-th of points that fill a square evenly whatever their number: Roberts, "The Unreasonable
/// Effectiveness of Quasirandom Sequences", 2018.
glm::vec2 even_point(uint32_t number, const glm::dvec2& shift)
{
    const glm::dvec2 step(0.7548776662466927, 0.5698402909980532);
    return glm::vec2(glm::fract(shift + static_cast<double>(number) * step));
}

uint32_t bit_of(LampKind kind)
{
    const bool is_spot = kind == LampKind::spot || kind == LampKind::pyramid;
    return kind == LampKind::directional ? baked_directional : is_spot ? baked_spot : baked_point;
}

} // namespace

struct Bake::State {
    State(const Scene& scene, const BakeSettings& wanted)
        : settings(wanted), triangles(static_triangles(scene)), surfaces(scene, triangles),
          atlas(make_atlas(triangles, surfaces, wanted.size)), texels(charts::covered_texels(atlas)),
          tracer(triangles, surfaces, settings), sums(texels.size()),
          fingerprint(work_fingerprint(scene, triangles, wanted))
    {
    }

    [[nodiscard]] uint64_t blocks_a_round() const
    {
        return (texels.size() + texels_a_block - 1) / texels_a_block;
    }

    [[nodiscard]] uint64_t block_count() const
    {
        return blocks_a_round() * ((settings.samples + paths_a_visit - 1) / paths_a_visit);
    }

    void work_on(uint64_t block);
    [[nodiscard]] std::vector<Estimate> estimates() const;

    BakeSettings settings;
    StaticTriangles triangles;
    Surfaces surfaces;
    charts::Atlas atlas;
    std::vector<charts::Texel> texels;
    Tracer tracer;
    std::vector<Sum> sums;
    uint64_t fingerprint = 0;
    uint64_t next_block = 0;
};

void Bake::State::work_on(uint64_t block)
{
    const auto first_path = static_cast<uint32_t>(block / blocks_a_round()) * paths_a_visit;
    const uint32_t last_path = std::min(first_path + paths_a_visit, settings.samples);
    const uint64_t first = block % blocks_a_round() * texels_a_block;
    for (uint64_t i = first; i < std::min<uint64_t>(first + texels_a_block, texels.size()); ++i) {
        const uint64_t own = Hash::mixed(Hash::mixed(settings.seed) + texels[i].place);
        Random for_shift(own);
        const double shift_x = for_shift.next();
        const glm::dvec2 shift(shift_x, for_shift.next());
        for (uint32_t path = first_path; path < last_path; ++path) {
            Random random(Hash::mixed(own + path + 1));
            const Arrival arrival = tracer.follow(texels[i], even_point(path, shift), random);
            const float level = luminance(arrival.light);
            sums[i].light += arrival.light;
            sums[i].square += level * level;
            sums[i].backs += arrival.saw_a_back ? 1.0F : 0.0F;
        }
    }
}

std::vector<Estimate> Bake::State::estimates() const
{
    std::vector<Estimate> result(texels.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        const uint64_t rounds =
            next_block / blocks_a_round() + (i / texels_a_block < next_block % blocks_a_round() ? 1 : 0);
        const auto paths =
            static_cast<float>(std::clamp<uint64_t>(rounds * paths_a_visit, 1, settings.samples));
        Estimate& estimate = result[i];
        estimate.light = sums[i].light / paths;
        const float level = luminance(estimate.light);
        estimate.variance = std::max(sums[i].square / paths - level * level, 0.0F) / paths;
        estimate.place = surfaces.place(texels[i].triangle, texels[i].weights);
        estimate.normal = surfaces.plane_normal(texels[i].triangle);
        estimate.known = sums[i].backs <= most_backs * paths;
    }
    return result;
}

Bake::Bake(const Scene& scene, const BakeSettings& settings)
    : state_(std::make_unique<State>(scene, settings))
{
}

Bake::~Bake() = default;

bool Bake::work(double seconds)
{
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    State& state = *state_;
    while (state.next_block < state.block_count()) {
        // The blocks of one group hold different texels, so that no two threads meet and each texel adds its
        // paths in their order.
        const uint64_t round_end = (state.next_block / state.blocks_a_round() + 1) * state.blocks_a_round();
        const uint64_t group_end = std::min(state.next_block + blocks_at_once, round_end);
        tbb::parallel_for(state.next_block, group_end, [&](uint64_t block) { state.work_on(block); });
        state.next_block = group_end;
        if (Clock::now() >= end) {
            break;
        }
    }
    return state.next_block < state.block_count();
}

double Bake::done() const
{
    return static_cast<double>(state_->next_block) / static_cast<double>(state_->block_count());
}

bool Bake::load_progress(const std::filesystem::path& path)
{
    State& state = *state_;
    std::error_code problem;
    ProgressHeader header;
    const ProgressHeader expected;
    const uint64_t size_bytes = sizeof header + state.sums.size() * sizeof(Sum);
    if (!std::filesystem::is_regular_file(path, problem) ||
        std::filesystem::file_size(path, problem) != size_bytes) {
        return false;
    }
    const std::vector<std::byte> bytes = read_file(path, size_bytes);
    if (bytes.size() != size_bytes) {
        return false;
    }
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.mark != expected.mark || header.fingerprint != state.fingerprint ||
        header.texel_count != state.texels.size() || header.next_block > state.block_count()) {
        return false;
    }
    std::memcpy(state.sums.data(), bytes.data() + sizeof header, bytes.size() - sizeof header);
    state.next_block = header.next_block;
    return true;
}

void Bake::save_progress(const std::filesystem::path& path) const
{
    const ProgressHeader header{.fingerprint = state_->fingerprint,
                                .next_block = state_->next_block,
                                .texel_count = state_->texels.size()};
    std::vector<std::byte> bytes(sizeof header + state_->sums.size() * sizeof(Sum));
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memcpy(bytes.data() + sizeof header, state_->sums.data(), bytes.size() - sizeof header);
    write_file_atomically(path, bytes);
}

Lightmap Bake::map() const
{
    const State& state = *state_;
    const std::vector<Estimate> estimates = state.estimates();
    std::vector<glm::vec3> light;
    if (state.settings.smooth) {
        light = smoothed(state.texels, estimates, state.settings.size);
    } else {
        for (const Estimate& estimate : estimates) {
            light.push_back(estimate.light);
        }
    }
    Lightmap map{.light = spread(state.texels, estimates, light, state.settings.size),
                 .geometry = geometry_fingerprint(state.triangles),
                 .exposure = state.settings.exposure,
                 .settings = fmt::format("{} samples, {} bounces, seed {}", state.settings.samples,
                                         state.settings.bounces, state.settings.seed)};
    for (const Lamp& lamp : state.settings.lamps) {
        map.baked_lights |= lamp.baked ? bit_of(lamp.kind) : 0U;
    }
    for (const glm::vec2& corner : state.atlas.corners) {
        map.corners.push_back(glm::clamp(corner / static_cast<float>(state.settings.size), 0.0F, 1.0F));
    }
    return map;
}

size_t Bake::texel_count() const
{
    return state_->texels.size();
}

float Bake::texels_per_m() const
{
    return state_->atlas.texels_per_m;
}

} // namespace estampe::bake
