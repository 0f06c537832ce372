// SPDX-License-Identifier: MIT
#include "lab/series.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace estampe::lab {
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

/// As wide as 16 to 9.
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

/// All of the page in shade, by strokes that are the thinner the more there are to a centimetre.
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
    picture.style.set("wind.speed_m_s=6");
    picture.moves = true;
    return picture;
}

BenchPicture of_smoke(double cells, uint32_t width, uint32_t height)
{
    BenchPicture picture = field(1.0, width, height);
    add_root(picture.scene, {.name = "smoke", .transform = {.scale = {16.0, 16.0, 16.0}}});
    picture.style.set("smoke.drawn=true");
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

} // namespace estampe::lab
