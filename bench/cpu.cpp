// SPDX-License-Identifier: MIT
// Measures CPU work before and between frames, for growing amounts: importing a scene, building its meshes,
// matching edges, posing, drawing a tonal art map, and reading styles.
// estampe_bench_cpu --benchmark_filter=Import

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <estampe/scene.hpp>
#include <estampe/shapes.hpp>
#include <estampe/style.hpp>
#include <estampe/tonal_art_map.hpp>

#include "features/lines/lines.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

/// A ball of about this number of triangles.
Primitive ball(double triangles)
{
    const auto rings = static_cast<uint32_t>(std::lround(std::sqrt(triangles / 4.0)));
    return shapes::sphere(1.0F, 2 * rings, rings);
}

Scene scene_of(double triangles)
{
    Scene scene{.materials = {Material{}}};
    scene.meshes.push_back({.primitives = {ball(triangles)}});
    scene.nodes.push_back({.name = "ball", .mesh = 0});
    scene.roots = {0};
    return scene;
}

void append(std::string& bytes, const void* data, size_t size)
{
    bytes.append(static_cast<const char*>(data), size);
}

/// The ball as a binary glTF file that holds positions and indices.
std::filesystem::path glb_of(const Primitive& primitive)
{
    const size_t places_bytes = primitive.positions.size() * sizeof(primitive.positions[0]);
    const size_t indices_bytes = primitive.indices.size() * sizeof(uint32_t);
    nlohmann::json json{{"asset", {{"version", "2.0"}}},
                        {"buffers", {{{"byteLength", places_bytes + indices_bytes}}}},
                        {"bufferViews",
                         {{{"buffer", 0}, {"byteLength", places_bytes}},
                          {{"buffer", 0}, {"byteOffset", places_bytes}, {"byteLength", indices_bytes}}}},
                        {"accessors",
                         {{{"bufferView", 0},
                           {"componentType", 5126},
                           {"count", primitive.positions.size()},
                           {"type", "VEC3"},
                           {"min", {-1, -1, -1}},
                           {"max", {1, 1, 1}}},
                          {{"bufferView", 1},
                           {"componentType", 5125},
                           {"count", primitive.indices.size()},
                           {"type", "SCALAR"}}}},
                        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
                        {"nodes", {{{"mesh", 0}}}},
                        {"scenes", {{{"nodes", {0}}}}},
                        {"scene", 0}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::array<uint32_t, 3> header{
        0x46546C67U, 2U, static_cast<uint32_t>(28 + text.size() + places_bytes + indices_bytes)};
    const std::array<uint32_t, 2> json_chunk{static_cast<uint32_t>(text.size()), 0x4E4F534AU};
    const std::array<uint32_t, 2> data_chunk{static_cast<uint32_t>(places_bytes + indices_bytes),
                                             0x004E4942U};
    std::string bytes;
    append(bytes, header.data(), sizeof header);
    append(bytes, json_chunk.data(), sizeof json_chunk);
    bytes += text;
    append(bytes, data_chunk.data(), sizeof data_chunk);
    append(bytes, primitive.positions.data(), places_bytes);
    append(bytes, primitive.indices.data(), indices_bytes);
    auto path = std::filesystem::temp_directory_path() / "estampe_bench_cpu.glb";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

/// The arguments are numbers of triangles. The fitted complexity is also in triangles.
void by_triangles(benchmark::internal::Benchmark* bench)
{
    bench->RangeMultiplier(10)->Range(10000, 1000000)->Unit(benchmark::kMillisecond)->Complexity();
}

void count_triangles(benchmark::State& state)
{
    state.SetComplexityN(state.range(0));
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

void import_glb(benchmark::State& state)
{
    const std::filesystem::path path = glb_of(ball(static_cast<double>(state.range(0))));
    for (auto _ : state) {
        benchmark::DoNotOptimize(load_scene(path));
    }
    count_triangles(state);
    std::filesystem::remove(path);
}

BENCHMARK(import_glb)->Apply(by_triangles);

void lay_out_meshes(benchmark::State& state)
{
    const Scene scene = scene_of(static_cast<double>(state.range(0)));
    for (auto _ : state) {
        benchmark::DoNotOptimize(pose::build_meshes(scene, 0));
    }
    count_triangles(state);
}

BENCHMARK(lay_out_meshes)->Apply(by_triangles);

void find_adjacency(benchmark::State& state)
{
    const pose::MeshData layout = pose::build_meshes(scene_of(static_cast<double>(state.range(0))), 0);
    for (auto _ : state) {
        benchmark::DoNotOptimize(features::edge_mesh_of(layout));
    }
    count_triangles(state);
}

BENCHMARK(find_adjacency)->Apply(by_triangles);

/// Adds nodes in a tree in which each parent has ten children.
void pose_nodes(benchmark::State& state)
{
    Scene scene = scene_of(100);
    for (Index i = 1; i < static_cast<Index>(state.range(0)); ++i) {
        Node node{.parent = (i - 1) / 10};
        node.mesh = 0;
        node.transform.translation.x = 0.1;
        scene.nodes[node.parent].children.push_back(i);
        scene.nodes.push_back(node);
    }
    for (auto _ : state) {
        benchmark::DoNotOptimize(pose_scene(scene, 0.5));
    }
    state.SetComplexityN(state.range(0));
}

BENCHMARK(pose_nodes)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond)->Complexity();

void draw_map(benchmark::State& state)
{
    Style style;
    style.set("tam.size_px=" + std::to_string(state.range(0)));
    for (auto _ : state) {
        benchmark::DoNotOptimize(draw_tonal_art_map(style));
    }
    state.SetComplexityN(state.range(0) * state.range(0));
}

BENCHMARK(draw_map)->RangeMultiplier(2)->Range(128, 512)->Unit(benchmark::kMillisecond)->Complexity();

void read_style(benchmark::State& state)
{
    const std::vector<std::string> presets = Style::presets();
    for (auto _ : state) {
        for (const std::string& preset : presets) {
            benchmark::DoNotOptimize(Style::load(preset));
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(presets.size()));
}

BENCHMARK(read_style)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
