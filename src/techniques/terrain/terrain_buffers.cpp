// SPDX-License-Identifier: MIT
// A terrain on the device. Compiles the terrain's height graph to a shader, and poses the terrain's vertices.
#include "techniques/terrain/terrain_buffers.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "output/child.hpp"
#include "shaders/sand_texels_comp.hpp"
#include "shaders/terrain_heights_comp.hpp"
#include "shaders/terrain_heights_text.hpp"
#include "shaders/terrain_vertices_comp.hpp"
#include "shaders/terrain_vertices_text.hpp"
#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {
namespace {

std::string place_of(const Instruction& i)
{
    if (i.warp.x == shared::height_no_register) {
        return fmt::format("place_at({}u, local_m.x, local_m.y)", i.place);
    }
    return fmt::format("place_warped({}u, local_m.x, local_m.y, r{}, r{})", i.place, i.warp.x, i.warp.y);
}

std::string leaf_of(const Instruction& i)
{
    const char* name = nullptr;
    switch (i.op) {
    case shared::height_coordinate_u:
        return fmt::format("coordinate_u({})", place_of(i));
    case shared::height_coordinate_v:
        return fmt::format("coordinate_v({})", place_of(i));
    case shared::height_wave:
        return fmt::format("leaf_sine({}, spacing_m)", place_of(i));
    case shared::height_noise:
        name = "noise";
        break;
    case shared::height_fbm:
        name = "fbm";
        break;
    case shared::height_ridged:
        name = "ridged";
        break;
    case shared::height_cellular:
        name = "cellular";
        break;
    case shared::height_texture:
        name = "texture";
        break;
    default:
        name = "dunes";
    }
    return fmt::format("leaf_{}({}, {}u, spacing_m)", name, place_of(i), i.parameter);
}

std::string value_of(const Instruction& i)
{
    const uint32_t a = i.inputs.x;
    const uint32_t b = i.inputs.y;
    const uint32_t c = i.inputs.z;
    const auto call = [&](const char* name) { return fmt::format("{}(r{})", name, a); };
    const auto call_two = [&](const char* name) { return fmt::format("{}(r{}, r{})", name, a, b); };
    const auto call_three = [&](const char* name) { return fmt::format("{}(r{}, r{}, r{})", name, a, b, c); };
    switch (i.op) {
    case shared::height_constant:
        return fmt::format("dual(height_number({}u))", i.parameter);
    case shared::height_add:
        return fmt::format("r{} + r{}", a, b);
    case shared::height_subtract:
        return fmt::format("r{} - r{}", a, b);
    case shared::height_multiply:
        return call_two("dual_mul");
    case shared::height_divide:
        return call_two("dual_div");
    case shared::height_minimum:
        return call_two("dual_min");
    case shared::height_maximum:
        return call_two("dual_max");
    case shared::height_lerp:
        return call_three("dual_lerp");
    case shared::height_smoothstep:
        return call_three("dual_smoothstep");
    case shared::height_power:
        return fmt::format("dual_pow(r{}, height_number({}u))", a, i.parameter);
    case shared::height_curve:
        return fmt::format("dual_curve(r{}, {}u, {}u)", a, i.parameter, i.count);
    case shared::height_sine:
        return call("dual_sin");
    case shared::height_cosine:
        return call("dual_cos");
    case shared::height_absolute:
        return call("dual_abs");
    case shared::height_root:
        return call("dual_sqrt");
    case shared::height_radius:
        return call_two("dual_radius");
    default:
        return call_two("dual_angle");
    }
}

/// The SPIR-V words of a compiled shader, and the shader object that points to the words. A Compiled must
/// therefore not move in memory.
struct Compiled {
    std::string name;
    std::vector<uint32_t> words;
    gpu::Shader shader{};
};

std::vector<uint32_t> spirv_of(const std::string& text, const std::string& name)
{
    const AtomicFile words = AtomicFile::file(std::filesystem::temp_directory_path() / (name + ".spv"));
    output::Child compiler(
        {"glslc", "--target-env=vulkan1.3", "-O", "-fshader-stage=compute", "-o", words.path().string(), "-"},
        "install glslc");
    const bool is_read = compiler.write(std::as_bytes(std::span(text)));
    if (!compiler.finish() || !is_read) {
        throw Error(fmt::format("glslc refuses the height graph: {}", compiler.complaint()));
    }
    const std::vector<std::byte> bytes = read_file(words.path());
    std::vector<uint32_t> result(bytes.size() / sizeof(uint32_t));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(uint32_t));
    return result;
}

/// Writes a program as the GLSL function `vec4 height_at(vec2 local_m, float spacing_m)`. Numbers are read
/// from the parameters, so that programs that differ only in numbers have the same text.
std::string height_glsl(const Program& program)
{
    std::string text = fmt::format("uint first_parameter()\n{{\n    return {}u;\n}}\n\n",
                                   shared::height_words_a_place * program.places.size());
    text += "vec4 height_at(vec2 local_m, float spacing_m)\n{\n    vec4 r0";
    for (uint32_t i = 1; i < shared::height_register_count; ++i) {
        text += fmt::format(", r{}", i);
    }
    text += ";\n";
    for (const Instruction& i : program.instructions) {
        text += fmt::format("    r{} = {};\n", i.target,
                            i.op >= shared::height_coordinate_u ? leaf_of(i) : value_of(i));
    }
    return text + fmt::format("    return r{};\n}}\n", program.instructions.back().target);
}

/// Inserts a program into a shader's text at HEIGHT_PROGRAM, then compiles and optimises the text with glslc.
/// Results are cached by text until the process ends. Thread-safe. Throws Error if glslc is missing or
/// rejects the text. Cost of a new text: 0.2 to 0.5 s.
const gpu::Shader& compiled_with(const Program& program, const std::string& shader_name,
                                 const std::string& shader_text)
{
    static std::mutex mutex;
    static std::map<std::string, std::unique_ptr<Compiled>> known;
    const std::string marker = "HEIGHT_PROGRAM";
    std::string text = shader_text;
    text.replace(text.find(marker), marker.size(), height_glsl(program));
    {
        const std::lock_guard lock(mutex);
        if (const auto found = known.find(text); found != known.end()) {
            return found->second->shader;
        }
    }
    auto made = std::make_unique<Compiled>();
    made->name = shader_name;
    made->words = spirv_of(text, shader_name);
    made->shader = {made->name.c_str(), made->words};
    const std::lock_guard lock(mutex);
    return known.try_emplace(std::move(text), std::move(made)).first->second->shader;
}

/// Number of sand steps that the graph of a picture may simulate. If more steps are needed, add_catching_up()
/// simulates them before the picture.
constexpr uint32_t steps_a_frame = 4;

template <class T>
gpu::Buffer mapped_buffer(gpu::Device& device, const char* name, const std::vector<T>& items)
{
    gpu::Buffer buffer(device, name, std::max<size_t>(items.size(), 1) * sizeof(T), gpu::MemoryUse::upload);
    std::ranges::copy(std::as_bytes(std::span(items)), buffer.mapped().begin());
    return buffer;
}

bool same(const std::vector<shared::TerrainLevel>& a, const std::vector<shared::TerrainLevel>& b)
{
    return std::ranges::equal(a, b, [](const shared::TerrainLevel& one, const shared::TerrainLevel& other) {
        return one.origin_m == other.origin_m && one.eye_cells == other.eye_cells &&
               one.hole_shift == other.hole_shift;
    });
}

CompiledShaders shaders_of(const Terrain& terrain)
{
    try {
        return {.vertices = &compiled_with(terrain.program(), "terrain_vertices_written",
                                           shaders::terrain_vertices_text),
                .heights = &compiled_with(terrain.program(), "terrain_heights_written",
                                          shaders::terrain_heights_text)};
    } catch (const Error& error) {
        return {.problem = error.what()};
    }
}

} // namespace

TerrainBuffers::TerrainBuffers(gpu::Device& device, const Terrain& terrain, const TerrainTarget& target,
                               const ObjectTriangles& object)
    : terrain_(terrain)
{
    set_mesh(device, target, object);
    set_graph(device, terrain);
}

void TerrainBuffers::set_mesh(gpu::Device& device, const TerrainTarget& target, const ObjectTriangles& object)
{
    auto method = mesh_method(terrain_.description().meshing, object);
    const MeshTopology mesh = method->topology();
    gpu::Buffer vertices = gpu::upload_buffer(device, "terrain vertices", mesh.vertices);
    places_ = gpu::upload_buffer(device, "terrain places",
                                 std::vector<glm::vec3>(mesh.places.begin(), mesh.places.end()));
    vertices_ = std::move(vertices);
    method_ = std::move(method);
    target_ = target;
    vertex_count_ = static_cast<uint32_t>(mesh.vertices.size());
    has_places_ = !mesh.places.empty();
    words_now_.clear();
}

void TerrainBuffers::set_graph(gpu::Device& device, const Terrain& terrain)
{
    const std::vector<float>& texels = terrain.program().texels;
    texels_ = gpu::upload_buffer(device, "terrain texels", texels.empty() ? std::vector<float>(4) : texels);
    if (!terrain.program().has_form_of(terrain_.program())) {
        compiled_.reset();
    }
    terrain_ = terrain;
    words_now_.clear();
    take_sand(device);
    set_source(source_);
}

/// Creates the simulated sand that the height graph asks for. Keeps the existing sand if the settings are
/// unchanged.
void TerrainBuffers::take_sand(gpu::Device& device)
{
    const auto& textures = terrain_.program().textures;
    const auto found =
        std::ranges::find_if(textures, [](const HeightTexture& t) { return t.sand.has_value(); });
    is_sand_stale_ = found != textures.end();
    if (!is_sand_stale_) {
        sand_source_.reset();
        sand_.reset();
        return;
    }
    first_sand_texel_ = found->first_texel;
    if (sand_source_ != found->sand || sand_->side() != found->columns) {
        sand_source_ = found->sand;
        sand_style_ = {.cell_m = static_cast<float>(sand_source_->cell_m),
                       .slab_m = static_cast<float>(0.1 * sand_source_->cell_m),
                       .depth_m = static_cast<float>(sand_source_->depth_m),
                       .speedup_per_m = static_cast<float>(0.06 / sand_source_->cell_m),
                       .seed = static_cast<int>(sand_source_->seed)};
        sand_ = std::make_unique<SlabField>(device, sand_style_, found->columns);
    }
}

bool TerrainBuffers::is_behind() const
{
    return sand_ && sand_moment_ > static_cast<double>(sand_->steps() + steps_a_frame);
}

void TerrainBuffers::add_catching_up(gpu::Graph& graph)
{
    const auto missing = static_cast<uint32_t>(sand_moment_ - static_cast<double>(sand_->steps()));
    const gpu::ImageId passing =
        sand_->add_steps(graph, sand_style_, std::min(missing, SlabField::most_steps(sand_style_)));
    graph.custom("sand").touch(passing, gpu::Access::compute_sampled).keep();
}

gpu::BufferId TerrainBuffers::add_texels(gpu::Graph& graph)
{
    gpu::BufferId texels = gpu::import_whole(graph, "terrain texels", texels_);
    if (!sand_ || !is_sand_stale_) {
        return texels;
    }
    is_sand_stale_ = false;
    const gpu::ImageId heights = sand_->add_moment(graph, sand_style_, sand_moment_, steps_a_frame);
    auto pass = graph.compute("sand/texels", shaders::sand_texels_comp);
    pass.sample(heights);
    texels = pass.modify(texels);
    pass.push(shared::SandConstants{.side = sand_->side(), .first_texel = first_sand_texel_})
        .dispatch_over(sand_->side(), sand_->side());
    return texels;
}

void TerrainBuffers::set_source(HeightSource source)
{
    source_ = source;
    // A running compilation is not waited for. finish_compiling() later checks to which terrain its result
    // belongs.
    if (source == HeightSource::compiled_meanwhile && !compiled_ && !compiling_.valid()) {
        begin_compiling();
    }
}

void TerrainBuffers::begin_compiling()
{
    compiling_of_ = terrain_;
    compiling_ = std::async(std::launch::async, shaders_of, terrain_);
}

/// Starts to use the compiled shaders if the compiler has finished.
void TerrainBuffers::finish_compiling()
{
    if (!compiling_.valid() || compiling_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return;
    }
    CompiledShaders made = compiling_.get();
    if (compiled_) {
        return;
    }
    if (compiling_of_->program().has_form_of(terrain_.program())) {
        compiled_ = std::move(made);
        words_now_.clear();
    } else if (source_ == HeightSource::compiled_meanwhile) {
        begin_compiling();
    }
}

bool TerrainBuffers::is_compiling()
{
    finish_compiling();
    return source_ == HeightSource::compiled_meanwhile && !compiled_;
}

const std::string& TerrainBuffers::problem() const
{
    static const std::string none;
    return compiled_ ? compiled_->problem : none;
}

bool TerrainBuffers::prepare(gpu::Device& device, const TerrainMoment& moment)
{
    const TerrainMeshing& meshing = terrain_.description().meshing;
    const glm::dvec2 anchor_m(moment.anchor_m.x, moment.anchor_m.z);
    const std::vector<shared::TerrainLevel> levels = method_->place(moment.eye, anchor_m);
    ProgramWords program = program_words(terrain_.program(), anchor_m,
                                         meshing.update == TerrainUpdate::still ? 0.0 : moment.time_s);
    finish_compiling();
    if (sand_) {
        const double time_s = meshing.update == TerrainUpdate::still ? 0.0 : moment.time_s;
        const double steps = sand_source_->start_steps + sand_source_->steps_per_s * std::max(time_s, 0.0);
        is_sand_stale_ = is_sand_stale_ || steps != sand_moment_;
        sand_moment_ = steps;
        // If the moment lies in the past, the simulation starts again, because it cannot run backwards.
        if (steps + 1.0 < static_cast<double>(sand_->steps())) {
            sand_ = std::make_unique<SlabField>(device, sand_style_, sand_->side());
        }
        form_ += is_sand_stale_ ? 1 : 0;
    }
    if (!moment.before_s && !is_sand_stale_ && program.words == words_now_ && same(levels, levels_now_) &&
        meshing.update != TerrainUpdate::always) {
        return false;
    }
    const shared::TerrainGlobals globals{.eye_m = glm::vec2(moment.eye.eye_m - anchor_m),
                                         .anchor_y_m = static_cast<float>(moment.anchor_m.y),
                                         .stroke_unit_m = static_cast<float>(target_.stroke_unit_m),
                                         .planet_radius_m = meshing.planet_radius_m,
                                         .before_s = static_cast<float>(moment.before_s.value_or(0.0)),
                                         .vertex_count = vertex_count_,
                                         .first_vertex = target_.first_vertex,
                                         .first_parameter = program.first_parameter,
                                         .first_instruction = program.first_instruction,
                                         .instruction_count =
                                             static_cast<uint32_t>(terrain_.program().instructions.size())};
    keeps_before_ = moment.before_s.has_value();
    globals_ = mapped_buffer(device, "terrain", std::vector{globals});
    levels_ = mapped_buffer(device, "terrain levels", levels);
    std::vector<uint32_t> uniform_words = program.words;
    uniform_words.resize(shared::height_words_most);
    words_ = mapped_buffer(device, "terrain program", uniform_words);
    form_ += program.words == words_now_ ? 0 : 1;
    words_now_ = std::move(program.words);
    levels_now_ = levels;
    return true;
}

const gpu::Shader& TerrainBuffers::shader(Task task)
{
    if (source_ == HeightSource::compiled && !compiled_) {
        const bool is_begun = compiling_.valid() && compiling_of_->program().has_form_of(terrain_.program());
        compiled_ = is_begun ? compiling_.get() : shaders_of(terrain_);
    }
    const gpu::Shader* own = nullptr;
    if (source_ != HeightSource::interpreted && compiled_) {
        own = task == Task::vertices ? compiled_->vertices : compiled_->heights;
    }
    if (own != nullptr) {
        return *own;
    }
    return task == Task::vertices ? shaders::terrain_vertices_comp : shaders::terrain_heights_comp;
}

TerrainBuffers::Posed TerrainBuffers::add_vertices(gpu::Graph& graph, const Posed& meshes,
                                                   gpu::BufferId texels)
{
    auto pass = graph.compute("terrain", shader(Task::vertices));
    pass.uniform(gpu::import_whole(graph, "terrain", globals_))
        .read(gpu::import_whole(graph, "terrain levels", levels_))
        .read(gpu::import_whole(graph, "terrain vertices", vertices_))
        .uniform(gpu::import_whole(graph, "terrain program", words_))
        .sample(texels, gpu::Format::r32f);
    const Posed posed{.vertices = pass.modify(meshes.vertices),
                      .before = pass.modify(meshes.before),
                      .stroke_coordinates = pass.modify(meshes.stroke_coordinates)};
    pass.read(gpu::import_whole(graph, "terrain places", places_));
    pass.variant((has_places_ ? shared::terrain_has_places : 0U) |
                 (keeps_before_ ? shared::terrain_keeps_before : 0U));
    pass.dispatch_items(vertex_count_);
    return posed;
}

gpu::ImageId TerrainBuffers::add_heights(gpu::Graph& graph, const HeightFields& fields, glm::uvec2 size,
                                         gpu::BufferId texels, const shared::FieldSector& wanted)
{
    const auto count = static_cast<uint32_t>(fields.size());
    shared::TerrainFieldConstants constants{.size = size, .wanted = wanted};
    std::ranges::copy(fields, constants.fields);
    auto pass = graph.compute("terrain/heights", shader(Task::heights));
    pass.uniform(gpu::import_whole(graph, "terrain", globals_))
        .uniform(gpu::import_whole(graph, "terrain program", words_))
        .sample(texels, gpu::Format::r32f);
    const gpu::ImageId height = pass.write(graph.image(
        "terrain/heights", {.width = size.x, .height = count * size.y, .format = gpu::Format::r32f}));
    // Estimated time in microseconds for the longest chain of noise octaves. Octaves run one after another,
    // so even a few vertices take the estimated time.
    constexpr uint32_t point_us = 45;
    pass.push(constants).estimated_duration_us(point_us).dispatch_over_page(size.x, size.y, count);
    return height;
}

} // namespace estampe::terrain
