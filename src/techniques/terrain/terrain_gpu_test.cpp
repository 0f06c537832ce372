// SPDX-License-Identifier: MIT
// What the GPU makes of height graphs, by either of its ways, against the processor; and where vertices
// stand.
#include <gtest/gtest.h>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/mesh.glsl.h"
#include "support/gpu_device.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/terrain/graph/evaluate.hpp"
#include "techniques/terrain/graph/test_graphs.hpp"
#include "techniques/terrain/terrain_buffers.hpp"

namespace estampe::terrain {
namespace {

constexpr glm::dvec3 far_anchor_m{1024.0, 3.0, -512.0};

Terrain small_terrain(const std::string& toml, const TerrainMeshing& meshing)
{
    TerrainDescription description = parse_terrain(toml, "test.toml");
    description.meshing = meshing;
    return Terrain(description);
}

/// Everything that one dispatch makes.
struct Made {
    std::vector<shared::PosedVertex> vertices;
    std::vector<shared::PosedVertex> before;
    std::vector<glm::vec3> stroke_coordinates;
};

Made pose(const Terrain& terrain, const TerrainMoment& moment, HeightSource source)
{
    gpu::Device& device = test::shared_device();
    const size_t count = mesh_method(terrain.description().meshing)->topology().vertices.size();
    TerrainBuffers buffers(device, terrain, {.first_vertex = 0, .stroke_unit_m = 2.0});
    buffers.set_source(source);
    EXPECT_TRUE(buffers.prepare(device, moment));
    TerrainMoment resting = moment;
    resting.before_s.reset();
    EXPECT_FALSE(buffers.prepare(device, resting)) << "nothing has moved";
    EXPECT_EQ(buffers.prepare(device, moment), moment.before_s.has_value());
    gpu::Buffer vertices = gpu::upload_buffer(device, "posed", std::vector<shared::PosedVertex>(count));
    gpu::Buffer before = gpu::upload_buffer(device, "before", std::vector<shared::PosedVertex>(count));
    gpu::Buffer strokes = gpu::upload_buffer(device, "strokes", std::vector<glm::vec3>(count));
    gpu::Graph graph;
    const auto posed =
        buffers.add_vertices(graph,
                             {.vertices = gpu::import_whole(graph, "posed", vertices),
                              .before = gpu::import_whole(graph, "before", before),
                              .stroke_coordinates = gpu::import_whole(graph, "strokes", strokes)},
                             buffers.add_texels(graph));
    const std::array wanted{posed.vertices, posed.before, posed.stroke_coordinates};
    const auto bytes = test::run_and_read(graph, wanted);
    return {test::items_of<shared::PosedVertex>(bytes[0]), test::items_of<shared::PosedVertex>(bytes[1]),
            test::items_of<glm::vec3>(bytes[2])};
}

/// Both ways on the GPU and the processor agree within 1e-5 of the height, for every node there is.
TEST(HeightGraphGpu, AgreesWithTheProcessor)
{
    const TerrainMeshing meshing{.method = TerrainMesh::grid, .cell_m = 0.25F, .cells = 32};
    for (const auto& [name, toml] : test::all_graphs()) {
        // What goes round a point keeps its precision near it alone.
        const glm::dvec3 anchor_m = name == "polar" ? glm::dvec3(0.0) : far_anchor_m;
        const TerrainMoment moment{.eye = {.eye_m = {anchor_m.x + 6.0, anchor_m.z + 12.0}},
                                   .anchor_m = anchor_m,
                                   .time_s = 12.5,
                                   .before_s = 0.25};
        const Terrain terrain = small_terrain(toml, meshing);
        const auto levels = mesh_method(meshing)->place(moment.eye, {anchor_m.x, anchor_m.z});
        const auto topology = mesh_method(meshing)->topology();
        const auto places = place_words(terrain.program(), {anchor_m.x, anchor_m.z}, moment.time_s);
        for (const HeightSource source : {HeightSource::compiled, HeightSource::interpreted}) {
            const Made made = pose(terrain, moment, source);
            int wrong = 0, crooked = 0;
            for (size_t i = 0; i < made.vertices.size(); ++i) {
                const glm::vec2 place = vertex_place(topology.vertices[i], levels);
                const glm::dvec4 exact = evaluate(terrain.program(), places, place, 0.25);
                const glm::dvec3 at(made.vertices[i].position);
                ASSERT_EQ(made.vertices[i].position.x, place.x);
                ASSERT_EQ(made.vertices[i].position.z, place.y);
                wrong +=
                    std::abs(at.y + anchor_m.y - exact.x) > 1e-5 * std::max(4.0, std::abs(exact.x)) ? 1 : 0;
                const glm::dvec3 normal = glm::normalize(glm::dvec3(-exact.y, 1.0, -exact.z));
                const glm::dvec3 packed(pose::unpack_normal(made.vertices[i].normal));
                crooked += glm::length(normal - packed) > 2e-4 ? 1 : 0;
                EXPECT_NEAR(static_cast<double>(made.before[i].position.y), at.y - 0.25 * exact.w,
                            1e-4 * std::max(1.0, std::abs(exact.w)));
                EXPECT_EQ(made.stroke_coordinates[i], made.vertices[i].position / 2.0F);
            }
            EXPECT_EQ(wrong, 0) << name
                                << (source == HeightSource::compiled ? ", compiled" : ", interpreted");
            // Where an edge runs through, the sides differ.
            EXPECT_LE(crooked, 2) << name;
        }
    }
}

/// Vertices of neighbouring rings that stand in one place are one point, bit for bit, and a vertex that is in
/// no zone of transition stands still while the eye goes by.
TEST(RingsGpu, LieOnOneGroundAndStandStill)
{
    const TerrainMeshing meshing{.cell_m = 0.5F, .cells = 32, .reach_m = 100.0F};
    const Terrain terrain = small_terrain(test::all_graphs()[0].second, meshing);
    const auto method = mesh_method(meshing);
    const auto topology = method->topology();
    std::map<std::tuple<uint32_t, float, float>, float> known;
    for (int step = 0; step < 24; ++step) {
        const TerrainMoment moment{.eye = {.eye_m = {1000.0 + 0.83 * step, -480.0 - 0.39 * step}},
                                   .anchor_m = far_anchor_m};
        const Made made = pose(terrain, moment, HeightSource::compiled);
        const auto levels = method->place(moment.eye, {far_anchor_m.x, far_anchor_m.z});
        std::map<std::pair<float, float>, std::set<float>> heights_at;
        for (size_t i = 0; i < made.vertices.size(); ++i) {
            const glm::vec3 p = made.vertices[i].position;
            heights_at[{p.x, p.z}].insert(p.y);
            const shared::TerrainLevel& level = levels[topology.vertices[i] >> 28U];
            const glm::vec2 from_eye =
                glm::abs((glm::vec2(p.x, p.z) - level.origin_m) / level.cell_m - level.eye_cells);
            if (std::max(from_eye.x, from_eye.y) <= level.fade_from) {
                const auto [found, is_new] = known.try_emplace({topology.vertices[i] >> 28U, p.x, p.z}, p.y);
                ASSERT_NEAR(found->second, p.y, 1e-4F);
                ASSERT_TRUE(is_new || found->second == p.y);
            }
        }
        for (const auto& [place, heights] : heights_at) {
            ASSERT_EQ(heights.size(), 1U) << place.first << " " << place.second;
        }
    }
}

/// A planet's ground falls away as a circle does.
TEST(TerrainGpu, ClosesRoundItself)
{
    const TerrainMeshing meshing{
        .cell_m = 16.0F, .cells = 32, .reach_m = 2000.0F, .planet_radius_m = 1000.0F};
    const Terrain terrain = small_terrain("[terrain]\nheight = 5\n", meshing);
    const Made made =
        pose(terrain, {.eye = {.eye_m = {1024.0, -512.0}}, .anchor_m = far_anchor_m}, HeightSource::compiled);
    for (const shared::PosedVertex& vertex : made.vertices) {
        const glm::dvec3 from_middle =
            glm::dvec3(vertex.position) + glm::dvec3(0.0, far_anchor_m.y + 1000.0, 0.0);
        EXPECT_NEAR(glm::length(from_middle), 1005.0, 1e-2);
        const glm::dvec3 normal(pose::unpack_normal(vertex.normal));
        EXPECT_GT(glm::dot(normal, glm::normalize(from_middle)), 0.99999);
    }
}

} // namespace
} // namespace estampe::terrain
