// SPDX-License-Identifier: MIT
// libFuzzer target: whatever the places of vertices and nodes, what is made of a scene before it is drawn can
// be made: poses, views, meshes, lines, form and the charts of a lightmap. The input is read as numbers of a
// glTF file, so that every scene is one that the importer gives.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "scene/charts/charts.hpp"
#include "scene/importers.hpp"
#include "scene/static_triangles.hpp"
#include "scene/view_analysis/view_analysis.hpp"
#include "techniques/contour/chains/mesh/feature_chains.hpp"
#include "techniques/form/form.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace {

using namespace estampe;

/// Numbers out of the input; zeros behind its end.
class Input {
public:
    explicit Input(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    [[nodiscard]] bool is_empty() const { return bytes_.empty(); }

    uint8_t byte()
    {
        const uint8_t value = bytes_.empty() ? uint8_t{0} : bytes_.front();
        bytes_ = bytes_.subspan(bytes_.empty() ? 0 : 1);
        return value;
    }

    /// Mostly small numbers, so that vertices meet; now and then one that is hard to reckon with.
    float number()
    {
        constexpr std::array<float, 16> hard{1e30F,   -1e30F, 3.4e38F, -3.4e38F, 1e-30F, 1e-45F,
                                             1e19F,   -1e19F, 1.0001F, 1e-6F,    1e6F,   16777217.0F,
                                             0.3333F, 1e-38F, -0.0F,   1e10F};
        const uint8_t code = byte();
        if (code < 224) {
            return 0.5F * static_cast<float>(code % 16) - 4.0F;
        }
        if (code < 240) {
            return hard[code - 224U];
        }
        uint32_t bits = 0;
        for (int i = 0; i < 4; ++i) {
            bits = bits << 8U | byte();
        }
        float value = 0.0F;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }

    /// As JSON; that has no word for what is not finite.
    std::string json()
    {
        const float value = number();
        return std::isfinite(value) ? fmt::format("{}", value) : "0";
    }

private:
    std::span<const uint8_t> bytes_;
};

template <typename Number>
void put(std::vector<std::byte>& bytes, Number value)
{
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
}

/// A file of two nodes with one mesh, the first moving: vertices and triangles from the input.
std::vector<std::byte> make_file(Input& input)
{
    const uint32_t vertices = 3 + input.byte() % 30U;
    const uint32_t triangles = 1 + input.byte() % 60U;
    const uint8_t flags = input.byte();
    std::array<std::string, 10> place;
    for (std::string& number : place) {
        number = (flags & 1U) != 0 ? input.json() : "";
    }
    std::vector<std::byte> bin;
    for (const float time : {0.0F, 1.0F}) {
        put(bin, time);
    }
    for (int i = 0; i < 6; ++i) {
        put(bin, input.number());
    }
    for (uint32_t i = 0; i < 5 * vertices; ++i) { // places, then texture coordinates
        put(bin, input.number());
    }
    for (uint32_t i = 0; i < 3 * triangles; ++i) {
        put(bin, static_cast<uint32_t>(input.byte() % vertices));
    }
    const std::string moved = (flags & 1U) != 0
                                  ? fmt::format(R"(,"translation":[{},{},{}],"scale":[{},{},{}])", place[0],
                                                place[1], place[2], place[3], place[4], place[5])
                                  : "";
    const char* const material =
        (flags & 2U) != 0 ? R"({"alphaMode":"BLEND","doubleSided":true})" : R"({"doubleSided":true})";
    const std::string text = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,1]}}],)"
        R"("nodes":[{{"mesh":0{}}},{{"mesh":0,"translation":[1,0,0]}}],"materials":[{}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":2{}}},"indices":4,"material":0,"mode":{}}}]}}],)"
        R"("animations":[{{"channels":[{{"sampler":0,"target":{{"node":0,"path":"{}"}}}}],)"
        R"("samplers":[{{"input":0,"output":1}}]}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"}},)"
        R"({{"bufferView":0,"byteOffset":8,"componentType":5126,"count":2,"type":"VEC3"}},)"
        R"({{"bufferView":0,"byteOffset":32,"componentType":5126,"count":{},"type":"VEC3"}},)"
        R"({{"bufferView":0,"byteOffset":{},"componentType":5126,"count":{},"type":"VEC2"}},)"
        R"({{"bufferView":0,"byteOffset":{},"componentType":5125,"count":{},"type":"SCALAR"}}],)"
        R"("bufferViews":[{{"buffer":0,"byteLength":{}}}],"buffers":[{{"byteLength":{}}}]}})",
        moved, material, (flags & 4U) != 0 ? R"(,"TEXCOORD_0":3)" : "",
        (flags & 8U) != 0 ? (flags >> 4U) % 7 : 4, (flags & 128U) != 0 ? "scale" : "translation", vertices,
        32 + 12 * vertices, vertices, 32 + 20 * vertices, 3 * triangles, bin.size(), bin.size());
    std::vector<std::byte> file;
    const auto padded = static_cast<uint32_t>((text.size() + 3) / 4 * 4);
    for (const uint32_t word :
         {0x46546C67U, 2U, static_cast<uint32_t>(28 + padded + bin.size()), padded, 0x4E4F534AU}) {
        put(file, word);
    }
    for (const char letter : text) {
        put(file, letter);
    }
    file.resize(20 + padded, std::byte{' '});
    put(file, static_cast<uint32_t>(bin.size()));
    put(file, 0x004E4942U);
    file.insert(file.end(), bin.begin(), bin.end());
    return file;
}

void expect(bool holds)
{
    if (!holds) {
        std::abort();
    }
}

bool is_finite(const glm::dvec3& point)
{
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// One of nine ways to look, or none in particular: each takes longer than all else.
void look_at(const Scene& scene, size_t way)
{
    constexpr std::array times_s{0.0, 0.37, -1e30};
    constexpr std::array aspects{1.0 / 16384.0, 1.5, 16384.0};
    if (way == times_s.size() * aspects.size()) {
        (void)analyze_view(scene);
        return;
    }
    const ScenePose pose = pose_scene(scene, times_s[way % times_s.size()]);
    const Camera camera = framing_camera(scene, pose, aspects[way / times_s.size()]);
    expect(is_finite(camera.eye) && is_finite(camera.target) && camera.eye != camera.target);
}

void make_lines(const pose::MeshData& meshes)
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    for (uint32_t v = 0; v < meshes.draw_of_vertex.size(); ++v) {
        const shared::DrawRecord& draw = meshes.draws[meshes.draw_of_vertex[v]];
        const shared::RestVertex& rest =
            meshes.rest_vertices[draw.first_rest_vertex + v - draw.first_posed_vertex];
        positions.push_back(rest.position);
        normals.push_back(pose::unpack_normal(rest.normal));
    }
    std::vector<uint32_t> bodies;
    for (const glm::uvec4& triangle : meshes.triangles) {
        bodies.push_back(triangle.w & shared::triangle_draw_mask);
    }
    const contour::EdgeMesh edges = contour::build_edge_mesh({.triangles = meshes.triangles,
                                                              .positions = meshes.stroke_coordinates,
                                                              .mesh_positions = positions,
                                                              .mesh_normals = normals,
                                                              .bodies = bodies,
                                                              .materials = bodies,
                                                              .edge_marks = meshes.edge_marks});
    contour::FeatureChains chains = contour::string_features(edges, meshes.stroke_coordinates, {});
    const std::vector<float> sizes(meshes.draw_of_vertex.size(), 1.0F);
    const std::vector<uint8_t> clockwise(meshes.triangles.size(), uint8_t{0});
    const contour::RestSurface surface{edges, meshes.stroke_coordinates, sizes, clockwise};
    contour::add_ridges(surface, contour::find_bending(surface), {.ridges = true, .valleys = true}, chains);
}

void follow(const Primitive& primitive)
{
    const form::FormField field = form::follow_form(primitive.positions, primitive.indices, {});
    expect(field.corners.size() == primitive.indices.size() / 3);
}

void lay_charts(const Scene& scene)
{
    const StaticTriangles triangles = static_triangles(scene);
    (void)geometry_fingerprint(triangles);
    std::vector<charts::Chart> cut = charts::cut_charts(triangles.positions);
    if (std::optional<charts::Chart> own = charts::own_chart(triangles.positions, triangles.uvs[0])) {
        cut = {std::move(*own)};
    }
    (void)charts::covered_texels(charts::pack_charts(cut, triangles.count(), 64));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    Input input({data, size});
    try {
        Scene scene = load_gltf_bytes(make_file(input), "fuzz.glb");
        look_at(scene, size == 0 ? 0 : data[size - 1] % 10U);
        for (const Primitive& primitive : scene.meshes.front().primitives) {
            if (primitive.topology == Topology::triangles) {
                follow(primitive);
            }
        }
        scene.materials.emplace_back();
        pose::MeshData meshes = pose::build_meshes(scene, static_cast<Index>(scene.materials.size() - 1));
        const pose::PoseData before = pose::pose_meshes(meshes, scene, pose_scene(scene, 0.0));
        const pose::PoseData now = pose::pose_meshes(meshes, scene, pose_scene(scene, 0.7));
        (void)pose::turn_triangles(meshes, now);
        (void)pose::moved_places(meshes, before, now);
        make_lines(meshes);
        lay_charts(scene);
    } catch (const Error&) {
        return 0;
    }
    return 0;
}
