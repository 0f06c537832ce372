// SPDX-License-Identifier: MIT
// Compares height graphs on the GPU, interpreted and compiled, with the processor; and tests vertex
// positions.
#include <unordered_map>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "shaders/scene.glsl.h"
#include "support/gpu_device.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/terrain/graph/program.hpp"
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

/// All results of one dispatch.
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

/// Vertices of one mesh, computed again and again.
class Walk {
public:
    explicit Walk(const Terrain& terrain)
        : buffers_(test::shared_device(), terrain, {.first_vertex = 0, .stroke_unit_m = 1.0}),
          posed_(upload<shared::PosedVertex>(terrain)), before_(upload<shared::PosedVertex>(terrain)),
          strokes_(upload<glm::vec3>(terrain))
    {
    }

    std::vector<shared::PosedVertex> at(const TerrainMoment& moment)
    {
        EXPECT_TRUE(buffers_.prepare(test::shared_device(), moment));
        gpu::Graph graph;
        const auto posed =
            buffers_.add_vertices(graph,
                                  {.vertices = gpu::import_whole(graph, "posed", posed_),
                                   .before = gpu::import_whole(graph, "before", before_),
                                   .stroke_coordinates = gpu::import_whole(graph, "strokes", strokes_)},
                                  buffers_.add_texels(graph));
        return test::run_and_read_as<shared::PosedVertex>(graph, posed.vertices);
    }

private:
    template <class T>
    static gpu::Buffer upload(const Terrain& terrain)
    {
        const size_t count = mesh_method(terrain.description().meshing)->topology().vertices.size();
        return gpu::upload_buffer(test::shared_device(), "walk", std::vector<T>(count));
    }

    TerrainBuffers buffers_;
    gpu::Buffer posed_;
    gpu::Buffer before_;
    gpu::Buffer strokes_;
};

/// Both methods on the GPU agree with the processor within 1e-5 of the height, for every node.
TEST(HeightGraphGpu, AgreesWithTheProcessor)
{
    const TerrainMeshing meshing{.method = TerrainMesh::grid, .cell_m = 0.25F, .cells = 32};
    for (const auto& [name, toml] : test::all_graphs()) {
        // A form around a point is precise only near that point.
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
            // On an edge, the slopes of the two sides differ.
            EXPECT_LE(crooked, 2) << name;
        }
    }
}

/// Vertices of neighbouring rings at one place are bit-identical. A vertex outside of all blend zones does
/// not move when the eye moves.
TEST(RingsGpu, LieOnOneGroundAndStandStill)
{
    const TerrainMeshing meshing{.cell_m = 0.5F, .cells = 32, .reach_m = 50.0F};
    const Terrain terrain = small_terrain(test::all_graphs()[0].second, meshing);
    const auto method = mesh_method(meshing);
    const auto topology = method->topology();
    Walk walk(terrain);
    std::unordered_map<uint64_t, float> known;                // key: level and place
    const auto key = [](uint32_t level, const glm::vec3& p) { // places are whole multiples of half a metre
        return uint64_t{level} << 60U |
               uint64_t{static_cast<uint32_t>(static_cast<int32_t>(2.0F * p.x)) & 0x3FFFFFFFU} << 30U |
               (static_cast<uint32_t>(static_cast<int32_t>(2.0F * p.z)) & 0x3FFFFFFFU);
    };
    size_t met_again = 0;
    for (int step = 0; step < 1000; ++step) {
        const double turn_rad = 0.00628 * step; // one full turn
        const TerrainMoment moment{.eye = {.eye_m = {1000.0 + 40.0 * std::sin(turn_rad) + 0.002 * step,
                                                     -480.0 - 40.0 * std::cos(turn_rad)}},
                                   .anchor_m = far_anchor_m};
        const std::vector<shared::PosedVertex> vertices = walk.at(moment);
        const auto levels = method->place(moment.eye, {far_anchor_m.x, far_anchor_m.z});
        std::unordered_map<uint64_t, float> height_at;
        for (size_t i = 0; i < vertices.size(); ++i) {
            const glm::vec3 p = vertices[i].position;
            const auto [here, is_first] = height_at.try_emplace(key(0, p), p.y);
            ASSERT_EQ(here->second, p.y) << p.x << " " << p.z;
            const uint32_t number = topology.vertices[i] >> 28U;
            const shared::TerrainLevel& level = levels[number];
            const glm::vec2 from_eye =
                glm::abs((glm::vec2(p.x, p.z) - level.origin_m) / level.cell_m - level.eye_cells);
            if (std::max(from_eye.x, from_eye.y) <= level.fade_from) {
                const auto [found, is_new] = known.try_emplace(key(number, p), p.y);
                ASSERT_EQ(found->second, p.y) << "asked: within 1e-4 m";
                met_again += is_new ? 0U : 1U;
            }
        }
    }
    EXPECT_GT(met_again, 500000U);
}

/// A planet's ground falls away along a circle.
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
