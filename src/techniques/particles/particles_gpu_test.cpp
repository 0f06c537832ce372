// SPDX-License-Identifier: MIT
// Sprites over layers that a test paints.
#include "techniques/particles/particles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <gtest/gtest.h>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "support/folder.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"

namespace estampe::particles {
namespace {

constexpr glm::uvec2 size_px(128, 96);

struct Drawn {
    std::vector<glm::vec4> wash;
    std::vector<float> hatch;
};

/// Sprites over a white wash and full hatching ink, in front of a wall `wall_m` away.
class Page {
public:
    Camera camera{.eye = {0.0, 0.0, 10.0}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.8};
    double wall_m = 1e4;
    float halves_per_m = 0.0F; ///< haze that fades into green
    bool by_groups = false;

    [[nodiscard]] Drawn draw(const ParticleStyle& style, const std::vector<Particle>& particles) const
    {
        gpu::Device& device = test::shared_device();
        const shared::FrameGlobals globals =
            features::frame_globals(camera, {}, glm::dvec3(0.0), {.size_px = size_px});
        Sheet sheet;
        sheet.ensure(device, style, [] { return SheetImage(); });
        ParticlePlan plan = plan_particles(style, particles,
                                           {.clip_from_anchor = globals.clip_from_anchor,
                                            .page_px = size_px,
                                            .pixels_per_mm = 2.0F,
                                            .pixel_m = features::pixel_size(camera, size_px.y).at_one_m,
                                            .sheet_px = sheet.size_px(),
                                            .sheet_frames = sheet.frames()});
        plan.constants.haze_start_m = 4.0F;
        plan.constants.haze_halves_per_m = halves_per_m;
        gpu::Buffer frame = gpu::upload_buffer(device, "frame", std::vector{globals});
        gpu::Buffer sprites = gpu::upload_buffer(device, "sprites", plan.sprites);
        gpu::Buffer starts = gpu::upload_buffer(device, "starts", plan.starts);
        gpu::Buffer listed = gpu::upload_buffer(device, "listed", plan.listed);
        const auto near = static_cast<double>(camera.near_m);
        const auto add = [&](gpu::Graph& graph, test::Layer& wash, test::Layer& hatch, test::Layer& lines,
                             test::Layer& depth, test::Layer& sky) {
            return add_particles(
                graph,
                {.frame = gpu::import_whole(graph, "frame", frame),
                 .depth = depth.in(graph),
                 .sky = sky.in(graph),
                 .size_px = size_px,
                 .by_groups = by_groups},
                {.sprites = gpu::import_whole(graph, "sprites", sprites),
                 .starts = gpu::import_whole(graph, "starts", starts),
                 .listed = gpu::import_whole(graph, "listed", listed),
                 .sheet = gpu::import_whole(graph, "sheet", sheet.texels())},
                plan.constants, {.wash = wash.in(graph), .hatch = hatch.in(graph), .lines = lines.in(graph)});
        };
        const auto layers = [&] {
            return std::array{
                test::Layer::color(size_px, [](glm::uvec2) { return glm::vec4(1.0F, 1.0F, 1.0F, 0.0F); }),
                test::Layer::coverage(size_px, [](glm::uvec2) { return 1.0F; }),
                test::Layer::root_color(size_px, [](glm::uvec2) { return glm::vec4(0.0F); }),
                test::Layer::depth(size_px, [&](glm::uvec2) { return static_cast<float>(near / wall_m); }),
                test::Layer::color(size_px, [](glm::uvec2) { return glm::vec4(0.0F, 1.0F, 0.0F, 1.0F); })};
        };
        auto a = layers();
        auto b = layers();
        gpu::Graph for_wash;
        gpu::Graph for_hatch;
        return {test::run_and_read_colors(for_wash, add(for_wash, a[0], a[1], a[2], a[3], a[4]).wash),
                test::run_and_read_coverage(for_hatch, add(for_hatch, b[0], b[1], b[2], b[3], b[4]).hatch)};
    }
};

/// A particle of middle age, with full opacity.
Particle at(const glm::dvec3& place)
{
    return {.place = place, .age = 0.3F, .trait = 0.5F, .trait_b = 0.2F};
}

ParticleStyle soft()
{
    return {
        .look = Look::wash, .size_m = 3.0F, .grown_m = 3.0F, .color = {1.0F, 0.0F, 0.0F}, .opacity = 1.0F};
}

double cover(const Drawn& drawn)
{
    double sum = 0.0;
    for (const glm::vec4& color : drawn.wash) {
        sum += 1.0 - static_cast<double>(color.y);
    }
    return sum;
}

/// More particles than a workgroup reads at once, over the whole page.
std::vector<Particle> crowd()
{
    std::vector<Particle> particles;
    for (int i = 0; i < 300; ++i) {
        const double turn = 2.4 * i;
        const double out = 0.02 * i;
        Particle particle = at({out * std::cos(turn), 0.6 * out * std::sin(turn), 0.01 * (i % 50)});
        particle.trait = static_cast<float>(std::fmod(0.37 * i, 1.0));
        particles.push_back(particle);
    }
    return particles;
}

TEST(ParticlePictures, AreReadByGroupsAsByPixels)
{
    for (const Look look : {Look::wash, Look::drawn}) {
        ParticleStyle style = soft();
        style.look = look;
        style.opacity = 0.2F;
        Page page;
        const Drawn by_pixels = page.draw(style, crowd());
        page.by_groups = true;
        const Drawn by_groups = page.draw(style, crowd());
        double off = 0.0;
        for (size_t i = 0; i < by_pixels.wash.size(); ++i) {
            off = std::max<double>(off, glm::length(by_pixels.wash[i] - by_groups.wash[i]));
            off = std::max<double>(off, std::abs(by_pixels.hatch[i] - by_groups.hatch[i]));
        }
        EXPECT_LT(off, 2e-3);
        EXPECT_GT(cover(by_pixels), 500.0);
    }
}

TEST(ParticlePictures, ColourWhatTheyAreBeforeAndHideItsStrokes)
{
    const Page page;
    const Drawn drawn = page.draw(soft(), {at({0.0, 0.0, 0.0})});
    const double radius_px =
        1.5 / (10.0 * static_cast<double>(features::pixel_size(page.camera, size_px.y).at_one_m));
    for (size_t i = 0; i < drawn.wash.size(); ++i) {
        const glm::dvec2 from_middle(static_cast<double>(i % size_px.x) + 0.5 - 64.0,
                                     static_cast<double>(i / size_px.x) + 0.5 - 48.0);
        EXPECT_NEAR(drawn.hatch[i], drawn.wash[i].y, 2e-3F);
        if (glm::length(from_middle) > std::sqrt(2.0) * radius_px) {
            EXPECT_EQ(drawn.hatch[i], 1.0F);
        }
    }
    EXPECT_LT(drawn.wash[48 * size_px.x + 64].y, 0.15F);
    EXPECT_GT(cover(drawn), 1.0 * radius_px * radius_px);
}

TEST(ParticlePictures, FadeBeforeASurfaceAndAreNotSeenBehindIt)
{
    ParticleStyle style = soft();
    style.soft_m = 2.0F;
    Page page;
    const double open = cover(page.draw(style, {at({0.0, 0.0, 0.0})}));
    page.wall_m = 11.0;
    const double halfway = cover(page.draw(style, {at({0.0, 0.0, 0.0})}));
    EXPECT_GT(halfway, 0.3 * open);
    EXPECT_LT(halfway, 0.75 * open);
    page.wall_m = 9.9;
    EXPECT_EQ(cover(page.draw(style, {at({0.0, 0.0, 0.0})})), 0.0);
    EXPECT_EQ(cover(page.draw(style, {at({0.0, 0.0, 12.0})})), 0.0) << "nor behind the eye";
}

TEST(ParticlePictures, HaveNoSeamsBetweenTilesOfThePage)
{
    const Page page;
    const double pixel_m = 10.0 * static_cast<double>(features::pixel_size(page.camera, size_px.y).at_one_m);
    const Drawn here = page.draw(soft(), {at({-8.0 * pixel_m, 0.0, 0.0})});
    const Drawn there = page.draw(soft(), {at({3.0 * pixel_m, -5.0 * pixel_m, 0.0})});
    for (uint32_t y = 0; y + 5 < size_px.y; ++y) {
        for (uint32_t x = 0; x + 11 < size_px.x; ++x) {
            EXPECT_NEAR(here.wash[y * size_px.x + x].y, there.wash[(y + 5) * size_px.x + x + 11].y, 0.02F)
                << x << ", " << y;
        }
    }
}

TEST(ParticlePictures, DrawInkInPlaceOfColourAsTheirLookSays)
{
    const Page page;
    for (const Look look : {Look::blots, Look::strokes}) {
        ParticleStyle style = soft();
        style.look = look;
        const Drawn drawn = page.draw(style, {at({0.0, 0.0, 0.0})});
        EXPECT_EQ(cover(drawn), 0.0);
        EXPECT_EQ(std::ranges::min(drawn.hatch), 1.0F);
    }
    ParticleStyle drawn_style = soft();
    drawn_style.look = Look::drawn;
    EXPECT_EQ(std::ranges::min(page.draw(drawn_style, {at({0.0, 0.0, 0.0})}).hatch), 0.0F);
}

TEST(ParticlePictures, ShowTheFrameOfTheSheetThatTheirAgeHas)
{
    const test::Folder folder;
    Image picture{.width = 16, .height = 8, .rgba = std::vector<uint8_t>(size_t{16} * 8 * 4, 255)};
    for (size_t i = 0; i < picture.rgba.size(); ++i) {
        const bool is_first_frame = (i / 4) % 16 < 8;
        picture.rgba[i] = is_first_frame && i % 4 != 3 ? 0 : 255;
    }
    const std::string path = (folder.path() / "sheet.png").string();
    save_png(picture, path);
    ParticleStyle style = soft();
    style.sheet = path;
    style.columns = 2;
    const Page page;
    const auto at_age = [&](float age) {
        Particle particle = at({0.0, 0.0, 0.0});
        particle.age = age;
        return cover(page.draw(style, {particle}));
    };
    const double quarter = at_age(0.25F);
    EXPECT_GT(quarter, 10.0);
    EXPECT_NEAR(at_age(0.4F) / quarter, 0.4 / 0.25, 0.1) << "the next frame comes in evenly";
    EXPECT_NEAR(at_age(0.02F), 0.0, 0.03 * quarter);
    style.columns = 17;
    EXPECT_THROW(static_cast<void>(page.draw(style, {})), Error);
    style.sheet = "no such.png";
    EXPECT_THROW(static_cast<void>(page.draw(style, {})), Error);
}

TEST(ParticlePictures, FadeIntoTheSkyByHowFarTheyAre)
{
    Page page;
    const std::vector<Particle> particles{at({0.0, 0.0, 0.0})}; // ten metres away, red
    const Drawn clear = page.draw(soft(), particles);
    page.halves_per_m = 0.5F;
    const Drawn hazy = page.draw(soft(), particles);
    const size_t middle = size_t{size_px.y / 2} * size_px.x + size_px.x / 2;
    const double covered = 1.0 - static_cast<double>(clear.wash[middle].y);
    ASSERT_GT(covered, 0.5);
    // The sprite is 6 m beyond the haze's start at 4 m. Haze halves it three times: an eighth of the red is
    // left.
    EXPECT_NEAR(1.0 - static_cast<double>(hazy.wash[middle].x), covered * (1.0 - 0.125), 0.01);
    EXPECT_NEAR(1.0 - static_cast<double>(hazy.wash[middle].y), covered * 0.125, 0.01);
    EXPECT_NEAR(hazy.hatch[middle], clear.hatch[middle], 1e-6F) << "what is behind is hidden all the same";
}

} // namespace
} // namespace estampe::particles
