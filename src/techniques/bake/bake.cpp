// SPDX-License-Identifier: MIT
// Bakes a lightmap: the fingerprint of its inputs, the rounds of light paths, and the smoothing and layout of
// the texels' light.
#include "techniques/bake/bake.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <estampe/error.hpp>
#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>

#include "core/color.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "scene/charts/charts.hpp"
#include "scene/static_triangles.hpp"
#include "techniques/bake/canvas.hpp"
#include "techniques/bake/tracer.hpp"

namespace estampe::bake {
namespace {

void add_texture(Hash& hash, const TextureRef& reference)
{
    hash.add(reference.texture);
    hash.add(reference.uv_set);
    hash.add(reference.uv_transform);
}

void add_links(Hash& hash, const LightLinks& links)
{
    hash.add(links.lit_by);
    hash.add(links.casts_for);
    hash.add(links.receives_shadows);
}

void add_material(Hash& hash, const Material& material)
{
    hash.add(material.base_color);
    add_texture(hash, material.base_color_texture);
    hash.add(material.emissive);
    add_texture(hash, material.emissive_texture);
    hash.add(material.alpha_mode);
    hash.add(material.alpha_cutoff);
    hash.add(material.double_sided);
    hash.add(material.unlit);
    add_links(hash, material.links);
}

void add_lamp(Hash& hash, const Lamp& lamp)
{
    hash.add(lamp.kind);
    hash.add(lamp.position);
    hash.add(lamp.direction);
    hash.add(lamp.color);
    hash.add(lamp.range_m);
    hash.add(lamp.cone_scale);
    hash.add(lamp.cone_offset);
    hash.add(lamp.side);
    hash.add(lamp.unit_volume);
    hash.add(lamp.groups);
    hash.add(lamp.casters);
    hash.add(lamp.baked);
}

/// Fingerprint of all inputs of a lightmap: positions, normals, materials, textures and settings.
uint64_t work_fingerprint(const Scene& scene, const StaticTriangles& triangles, const BakeSettings& settings)
{
    Hash hash;
    for (const StaticDraw& draw : triangles.draws) {
        hash.add(draw.triangle_count);
        hash.add(draw.material);
        add_links(hash, scene.nodes[draw.node].links);
    }
    hash.add_all(triangles.positions);
    hash.add_all(triangles.normals);
    hash.add_all(triangles.uvs[0]);
    hash.add_all(triangles.uvs[1]);
    hash.add_all(triangles.colors);
    for (const Material& material : scene.materials) {
        add_material(hash, material);
    }
    for (const Texture& texture : scene.textures) {
        hash.add_all(texture.image.rgba);
        hash.add(texture.image.width);
        hash.add(texture.wrap_u);
        hash.add(texture.wrap_v);
    }
    hash.add(settings.size);
    hash.add(settings.samples);
    hash.add(settings.bounces);
    hash.add(settings.seed);
    hash.add(settings.sky);
    hash.add(settings.ground);
    hash.add(settings.exposure);
    for (const Lamp& lamp : settings.lamps) {
        add_lamp(hash, lamp);
    }
    return hash.value();
}

/// The light of one lightmap texel, as estimated from its paths.
struct Estimate {
    glm::vec3 light{0.0F};
    float variance = 0.0F; ///< variance of the mean brightness over all paths
    glm::vec3 place{0.0F};
    glm::vec3 normal{0.0F};
    bool known = true; ///< false if the texel lies inside a solid object
};

constexpr int filter_reach = 3;
constexpr uint32_t nobody = 0xffffffffU;

/// Weight of texel `b` in the filtered value of texel `a`. `b` is `step` texels away.
float agreement(const Estimate& a, const Estimate& b, const glm::ivec2& step)
{
    const float cosine = glm::dot(a.normal, b.normal);
    const glm::vec3 way = b.place - a.place;
    const float off_plane = glm::dot(way, a.normal);
    const float steps_2 = static_cast<float>(glm::dot(glm::vec2(step), glm::vec2(step)));
    if (!b.known || cosine < 0.9F || off_plane * off_plane > 0.02F * glm::dot(way, way)) {
        return 0.0F;
    }
    const float difference = luminance(a.light) - luminance(b.light);
    const float noise_2 = 4.0F * (a.variance + b.variance) + 1e-12F;
    return std::exp(-steps_2 / 6.0F - difference * difference / noise_2);
}

/// Averages each lightmap texel with similar texels of the surface, up to three texels away: a bilateral
/// filter after Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform", 2010, at one scale. Cost: 49
/// lookups per texel.
std::vector<glm::vec3> smoothed(std::span<const charts::Texel> texels, std::span<const Estimate> estimates,
                                uint32_t size)
{
    std::vector<uint32_t> texel_at(static_cast<size_t>(size) * size, nobody);
    for (uint32_t i = 0; i < texels.size(); ++i) {
        texel_at[texels[i].place] = i;
    }
    std::vector<glm::vec3> result(texels.size());
    const auto smooth_one = [&](size_t i) {
        const auto x = static_cast<int>(texels[i].place % size);
        const auto y = static_cast<int>(texels[i].place / size);
        glm::vec3 sum = estimates[i].light;
        float weight_sum = 1.0F;
        for (int v = -filter_reach; v <= filter_reach; ++v) {
            for (int u = -filter_reach; u <= filter_reach; ++u) {
                const glm::ivec2 at(x + u, y + v);
                const bool inside = at.x >= 0 && at.y >= 0 && at.x < static_cast<int>(size) &&
                                    at.y < static_cast<int>(size) && (u != 0 || v != 0);
                const uint32_t other =
                    inside ? texel_at[static_cast<size_t>(at.y) * size + static_cast<size_t>(at.x)] : nobody;
                if (other != nobody) {
                    const float weight = agreement(estimates[i], estimates[other], {u, v});
                    sum += weight * estimates[other].light;
                    weight_sum += weight;
                }
            }
        }
        result[i] = sum / weight_sum;
    };
    tbb::parallel_for(tbb::blocked_range<size_t>(0, texels.size(), 1024),
                      [&](const tbb::blocked_range<size_t>& range) {
                          for (size_t i = range.begin(); i != range.end(); ++i) {
                              smooth_one(i);
                          }
                      });
    return result;
}

/// Writes the lightmap texels into an image, fills unknown texels with the mean of their neighbours, and
/// extends the edges of charts into their gutters.
LightImage spread(std::span<const charts::Texel> texels, std::span<const Estimate> estimates,
                  std::span<const glm::vec3> light, uint32_t size)
{
    Canvas canvas(size);
    std::vector<uint32_t> open;
    for (size_t i = 0; i < texels.size(); ++i) {
        canvas.light[texels[i].place] = estimates[i].known ? light[i] : glm::vec3(0.0F);
        canvas.known[texels[i].place] = estimates[i].known;
        if (!estimates[i].known) {
            open.push_back(texels[i].place);
        }
    }
    for (std::vector<uint32_t> filled(1); !open.empty() && !filled.empty();) {
        filled = fill_beside(canvas, open);
        std::erase_if(open, [&](uint32_t place) { return canvas.known[place]; });
    }
    std::vector<uint32_t> edge;
    for (const charts::Texel& texel : texels) {
        edge.push_back(texel.place);
    }
    for (uint32_t ring = 0; ring < charts::gutter; ++ring) {
        edge = fill_beside(canvas, unknown_beside(canvas, edge));
    }
    return {.width = size, .height = size, .texels = std::move(canvas.light)};
}

// Number of paths that a thread traces for one texel before it goes to the next.
constexpr uint32_t paths_a_visit = 8;
constexpr uint64_t texels_a_block = 512;
constexpr uint64_t blocks_at_once = 32; // number of blocks of work between two checks of the clock
// A texel lies inside an object if the share of its paths that meet a back face is larger than this limit.
constexpr float most_backs = 0.6F;

/// Sums over all paths of a texel so far.
struct Sum {
    glm::vec3 light{0.0F};
    float square = 0.0F; ///< sum of squared brightness of the paths
    float backs = 0.0F;
};

static_assert(sizeof(Sum) == 20);

/// Header of a file that stores an unfinished bake.
struct ProgressHeader {
    std::array<char, 16> mark{"estampe bake 1\n"};
    uint64_t fingerprint = 0;
    uint64_t next_block = 0;
    uint64_t texel_count = 0;
};

/// Cuts the triangles that receive light into charts, draw call by draw call, and packs the charts into a
/// map.
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

/// Point `number` of a sequence of any length that fills the unit square evenly: Roberts, "The Unreasonable
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
        // The blocks of one round hold different texels, so no two threads share a texel, and each texel adds
        // its paths in order.
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
