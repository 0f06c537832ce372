// SPDX-License-Identifier: MIT
#include "lab/series.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <estampe/shapes.hpp>

#include "common/measuring.hpp"
#include "gpu/pass_costs.hpp"

namespace estampe::lab {
namespace {

/// Side of the field's floor.
constexpr double field_m = 40.0;

Index add_mesh(Scene& scene, Primitive primitive)
{
    scene.meshes.push_back({.primitives = {std::move(primitive)}});
    return static_cast<Index>(scene.meshes.size() - 1);
}

/// Adds a node that has no parent.
void add_root(Scene& scene, Node node)
{
    scene.roots.push_back(static_cast<Index>(scene.nodes.size()));
    scene.nodes.push_back(std::move(node));
}

} // namespace

Scene field_of_balls(double triangles)
{
    constexpr int balls_a_side = 8;
    constexpr int balls = balls_a_side * balls_a_side;
    // A ball of 2 n by n faces has 4 n^2 triangles.
    const auto rings = static_cast<uint32_t>(std::lround(std::max(std::sqrt(triangles / balls / 4.0), 3.0)));
    Scene scene;
    scene.materials.push_back({.name = "chalk"});
    const Index floor =
        add_mesh(scene, shapes::plane(static_cast<float>(field_m), static_cast<float>(field_m), 32));
    const Index ball = add_mesh(scene, shapes::sphere(1.2F, 2 * rings, rings));
    add_root(scene, {.name = "floor", .mesh = floor});
    for (int i = 0; i < balls; ++i) {
        const int row = i / balls_a_side;
        const int column = i % balls_a_side;
        const double x = (column - 3.5) * field_m / balls_a_side;
        const double z = (row - 3.5) * field_m / balls_a_side;
        add_root(scene, {.name = "ball", .transform = {.translation = {x, 1.2, z}}, .mesh = ball});
    }
    scene.lights.push_back({.type = LightType::ambient, .intensity = 0.1F});
    add_root(scene, {.light = 0});
    return scene;
}

Camera view_of_field()
{
    return {.eye = {0.0, 22.0, 34.0}, .target = {0.0, 0.0, 2.0}, .vertical_fov_rad = 0.8};
}

void add_lights(Scene& scene, uint32_t count, uint32_t shadowed)
{
    std::mt19937 random(11);
    const auto between = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const double reach_m =
        std::clamp(std::sqrt(3.0 * field_m * field_m / (glm::pi<double>() * count)), 1.5, 12.0);
    for (uint32_t i = 0; i < count; ++i) {
        const bool casts = i < shadowed;
        const bool is_spot = casts ? i % 2 == 0 : i % 3 == 0;
        Light light{.type = is_spot ? LightType::spot : LightType::point,
                    .color = glm::vec3(between(0.5, 1.0), between(0.5, 1.0), between(0.5, 1.0)),
                    .intensity = static_cast<float>(0.4 * reach_m * reach_m),
                    .range_m = static_cast<float>(reach_m),
                    .inner_cone_rad = 0.3F,
                    .outer_cone_rad = 0.7F};
        light.casters = casts ? all_groups : Groups{0};
        const glm::dvec3 place(between(-0.5, 0.5) * field_m, between(0.2, 0.6) * reach_m + 1.0,
                               between(-0.5, 0.5) * field_m);
        const glm::dquat down = glm::angleAxis(-glm::half_pi<double>(), glm::dvec3(1.0, 0.0, 0.0));
        add_root(scene, {.transform = {.translation = place, .rotation = down},
                         .light = static_cast<Index>(scene.lights.size())});
        scene.lights.push_back(light);
    }
}

void animate_shadowed(Scene& scene, uint32_t shadowed)
{
    Animation circle{.name = "circle", .duration_s = 1.0F};
    const size_t first = scene.nodes.size() - (scene.lights.size() - 1);
    for (uint32_t i = 0; i < shadowed; ++i) {
        const auto node = static_cast<Index>(first + i);
        const glm::vec3 middle(scene.nodes[node].transform.translation);
        AnimationChannel channel{.node = node, .path = AnimatedPath::translation};
        for (int k = 0; k <= 8; ++k) {
            const float angle = glm::two_pi<float>() * static_cast<float>(k) / 8.0F;
            channel.times_s.push_back(static_cast<float>(k) / 8.0F);
            channel.values.insert(channel.values.end(), {middle.x + 0.3F * std::cos(angle), middle.y,
                                                         middle.z + 0.3F * std::sin(angle)});
        }
        circle.channels.push_back(std::move(channel));
    }
    scene.animations.push_back(std::move(circle));
}

namespace {

constexpr double usual_triangles = 70e3;

BenchPicture field(double triangles, uint32_t width, uint32_t height)
{
    return {.scene = field_of_balls(triangles),
            .camera = view_of_field(),
            .style = {},
            .width = width,
            .height = height};
}

/// A picture of this many pixels, with the aspect ratio 16:9.
BenchPicture of_pixels(double pixels, uint32_t /*width*/, uint32_t /*height*/)
{
    const auto height = static_cast<uint32_t>(std::lround(std::sqrt(pixels * 9.0 / 16.0)));
    return field(usual_triangles, height * 16 / 9, height);
}

BenchPicture of_triangles(double triangles, uint32_t width, uint32_t height)
{
    return field(triangles, width, height);
}

BenchPicture of_lamps(double lamps, uint32_t width, uint32_t height)
{
    BenchPicture picture = field(usual_triangles, width, height);
    add_lights(picture.scene, static_cast<uint32_t>(lamps), 0);
    return picture;
}

BenchPicture of_shadows(double lamps, uint32_t width, uint32_t height)
{
    BenchPicture picture = field(usual_triangles, width, height);
    add_lights(picture.scene, static_cast<uint32_t>(lamps), static_cast<uint32_t>(lamps));
    animate_shadowed(picture.scene, static_cast<uint32_t>(lamps));
    picture.style.set("shadow.local_size=512");
    picture.moves = true;
    return picture;
}

/// A page that is entirely in shade, hatched. The more strokes per centimetre, the thinner the strokes.
BenchPicture of_strokes(double strokes_per_cm, uint32_t width, uint32_t height)
{
    BenchPicture picture = field(usual_triangles, width, height);
    picture.style.set("tone.exposure=0.3");
    picture.style.set(fmt::format("hatch.width_mm={}", 5.0 / strokes_per_cm));
    return picture;
}

BenchPicture of_cloth(double particles, uint32_t width, uint32_t height)
{
    const auto side = static_cast<uint32_t>(std::lround(std::sqrt(particles)));
    BenchPicture picture = field(1.0, width, height);
    Primitive sheet =
        cloth_sheet(side, side, {-8.0F, 16.0F, 0.0F}, {16.0F, 0.0F, 0.0F}, {0.0F, -14.0F, 0.0F});
    sheet.held.assign(size_t{side} * side, 0.0F);
    std::fill_n(sheet.held.begin(), side, 1.0F);
    picture.scene.meshes.push_back({.primitives = {std::move(sheet)}});
    add_root(
        picture.scene,
        {.name = "sheet", .mesh = static_cast<Index>(picture.scene.meshes.size() - 1), .cloth = Cloth{}});
    picture.style.set("wind.speed_m_per_s=6");
    picture.moves = true;
    return picture;
}

BenchPicture of_smoke(double cells, uint32_t width, uint32_t height)
{
    BenchPicture picture = field(1.0, width, height);
    add_root(picture.scene, {.name = "smoke", .transform = {.scale = {16.0, 16.0, 16.0}}});
    picture.style.set("smoke.enabled=true");
    picture.style.set("smoke.age_s=0");
    picture.style.set(fmt::format("smoke.cells={}", std::lround(std::cbrt(cells))));
    picture.moves = true;
    return picture;
}

BenchPicture of_ground(double cells, uint32_t width, uint32_t height)
{
    BenchPicture picture{.style = {}, .width = width, .height = height, .moves = true};
    picture.scene.materials.push_back({.name = "chalk"});
    picture.scene.terrain = Terrain(parse_terrain(
        fmt::format("[terrain]\nheight = '6 * fbm(600, octaves = 2) + dunes(85, 10, celerity = 0.5)'\n"
                    "[mesh]\ncells = {}\nupdate = 'always'\n",
                    std::lround(std::sqrt(cells))),
        "bench.toml"));
    picture.camera = terrain_camera(*picture.scene.terrain, 0.0);
    return picture;
}

BenchPicture of_ink(double pixels, uint32_t width, uint32_t height)
{
    BenchPicture picture = of_pixels(pixels, width, height);
    picture.style = Style::load("flowing-ink");
    picture.moves = true;
    return picture;
}

BenchPicture of_particles(double per_s, uint32_t width, uint32_t height)
{
    BenchPicture picture = field(1.0, width, height);
    add_root(picture.scene, {.name = "emitter"});
    picture.style.set("particles.life_s=10");
    picture.style.set(fmt::format("particles.per_s={}", per_s));
    picture.moves = true;
    return picture;
}

} // namespace

const std::vector<Series>& all_series()
{
    constexpr double any = 1e30;
    static const std::vector<Series> series{
        {"pixels",
         "A whole frame of 70 k triangles, by its size",
         "pixels",
         {57600, 230400, 921600, 2073600, 8294400},
         1e6,
         of_pixels},
        {"triangles",
         "A whole frame, by what it shows",
         "triangles",
         {1e4, 1e5, 1e6, 1e7},
         1e6,
         of_triangles},
        {"lamps", "Lamps and spots without shadows", "lamps", {1, 10, 100, 1000}, any, of_lamps},
        {"shadows", "Lamps and spots that move and throw shadows", "lamps", {1, 2, 4, 8, 16}, 4, of_shadows},
        {"strokes",
         "A page all in shade, by finer strokes",
         "strokes a centimetre",
         {5, 10, 20, 40},
         any,
         of_strokes},
        {"cloth", "A sheet in the wind", "particles", {1024, 4096, 16384, 65536, 262144}, 4096, of_cloth},
        {"smoke",
         "Smoke, a step a frame, and its drawing",
         "cells",
         {4096, 32768, 262144, 2097152},
         32768,
         of_smoke},
        {"ground",
         "Dunes found anew in every frame",
         "cells of a ring",
         {4096, 16384, 65536, 262144},
         65536,
         of_ground},
        {"ink",
         "A whole frame with ink that flows, by its size",
         "pixels",
         {57600, 230400, 921600, 2073600, 8294400},
         230400,
         of_ink},
        {"particles",
         "An emitter, its particles alive for 10 s",
         "particles a second",
         {2, 20, 200},
         20,
         of_particles},
    };
    return series;
}

namespace {

/// Draws one picture repeatedly.
class Drawn {
public:
    Drawn(const RendererOptions& device, BenchPicture picture)
        : picture_(std::move(picture)), renderer_(device)
    {
        renderer_.set_scene(picture_.scene);
        draw(); // the first frame compiles shaders and uploads the scene
    }

    /// Discards the times of the frames drawn so far.
    void forget()
    {
        passes_.forget();
        gpu_ms_.clear();
        wall_ms_.clear();
    }

    void draw(bool by_passes = false)
    {
        RenderSettings settings{.width = picture_.width, .height = picture_.height};
        settings.time_passes = by_passes;
        if (picture_.moves) {
            settings.time_s = frame_ / 60.0;
            settings.continuity = frame_ == 0 ? Continuity::starts : Continuity::follows;
        }
        ++frame_;
        const bench::WallClock clock;
        static_cast<void>(renderer_.render(picture_.camera, picture_.style, settings));
        const double wall_ms = clock.ms();
        if (by_passes) {
            passes_.add(renderer_.timings());
        } else {
            wall_ms_.push_back(wall_ms);
            gpu_ms_.push_back(renderer_.gpu_ms());
        }
    }

    [[nodiscard]] BenchPoint point(double amount) const
    {
        return {.amount = amount,
                .gpu_ms = spread_of(gpu_ms_),
                .wall_ms = spread_of(wall_ms_),
                .memory_bytes = renderer_.device_memory_bytes(),
                .techniques = techniques()};
    }

    [[nodiscard]] const std::vector<double>& costs() const
    {
        return renderer_.device().software ? wall_ms_ : gpu_ms_;
    }

    [[nodiscard]] const DeviceInfo& device() const { return renderer_.device(); }

private:
    [[nodiscard]] std::vector<TechniqueCost> techniques() const
    {
        std::map<std::string, double> sums_ms;
        for (const PassTiming& pass : passes_.medians()) {
            sums_ms[pass.name.substr(0, pass.name.find('/'))] += pass.gpu_ms;
        }
        std::vector<TechniqueCost> costs;
        costs.reserve(sums_ms.size());
        for (const auto& [name, gpu_ms] : sums_ms) {
            costs.push_back({name, gpu_ms});
        }
        std::ranges::stable_sort(costs, std::ranges::greater{}, &TechniqueCost::gpu_ms);
        return costs;
    }

    BenchPicture picture_;
    Renderer renderer_;
    gpu::PassHistory passes_;
    std::vector<double> gpu_ms_;
    std::vector<double> wall_ms_;
    int frame_ = 0;
};

/// A GPU raises its clock rate only after some time under load. The passes are timed last, because timing
/// passes makes a frame slower.
void draw_in_turn(Drawn& base, Drawn* other, uint32_t frames)
{
    const uint32_t warm_up = base.device().software ? 1 : 12;
    for (uint32_t frame = 0; frame < warm_up + frames; ++frame) {
        if (frame == warm_up) {
            base.forget();
            if (other != nullptr) {
                other->forget();
            }
        }
        base.draw();
        if (other != nullptr) {
            other->draw();
        }
    }
    constexpr uint32_t most_by_passes = 5;
    Drawn& asked = other != nullptr ? *other : base;
    for (uint32_t frame = 0; frame < std::min(frames, most_by_passes); ++frame) {
        asked.draw(true);
    }
}

} // namespace

const Spread& cost_of(const BenchPoint& point, bool software)
{
    return software ? point.wall_ms : point.gpu_ms;
}

double growth(const BenchSeries& series, size_t point, bool software)
{
    if (point == 0) {
        return 0.0;
    }
    const BenchPoint& before = series.points[point - 1];
    const BenchPoint& here = series.points[point];
    return std::log(cost_of(here, software).median / cost_of(before, software).median) /
           std::log(here.amount / before.amount);
}

BenchResult measure(const std::vector<const Series*>& series, const BenchPlan& plan,
                    const std::function<void(const Series&, double amount)>& on_point)
{
    BenchResult result{.width = plan.width, .height = plan.height, .frames = plan.frames};
    for (const Series* one : series) {
        BenchSeries measured{.name = one->name, .work = one->work};
        std::optional<Drawn> base;
        for (const double amount : one->amounts) {
            if (base && (amount > plan.most_share * one->amounts.back() ||
                         (result.software && amount > one->most_on_processor))) {
                break;
            }
            on_point(*one, amount);
            if (!base) {
                base.emplace(plan.device, one->picture(amount, plan.width, plan.height));
                result.device = base->device().name;
                result.driver = base->device().driver;
                result.software = base->device().software;
                draw_in_turn(*base, nullptr, plan.frames);
                measured.points.push_back(base->point(amount));
                continue;
            }
            Drawn here(plan.device, one->picture(amount, plan.width, plan.height));
            draw_in_turn(*base, &here, plan.frames);
            BenchPoint point = here.point(amount);
            point.ratio = median_of(here.costs()) / std::max(median_of(base->costs()), 1e-9);
            measured.points.push_back(std::move(point));
        }
        result.series.push_back(std::move(measured));
    }
    return result;
}

} // namespace estampe::lab
