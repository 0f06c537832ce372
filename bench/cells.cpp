// SPDX-License-Identifier: MIT
// Culling by cells and portals in the temple, without a device: which rooms each viewpoint sees, how many
// triangles are left to draw, the time on the CPU, and a plan of one viewpoint's view.
// estampe_bench_cells --help

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <estampe/image.hpp>

#include "common/command_line.hpp"
#include "common/measuring.hpp"
#include "features/common/view.hpp"
#include "features/culling/culling.hpp"
#include "techniques/raster/raster.glsl.h"
#include "temple/temple.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): a program of one file

struct Options {
    uint64_t seed = 1;
    uint32_t rounds = 200;
    std::string view = "hall";
    std::string picture;
    bench::Size size{.width = 1920, .height = 1080};
};

/// The temple, its meshes, and the bounding box of each cluster of triangles.
struct Temple {
    Scene scene;
    pose::MeshData layout;
    std::vector<std::optional<Bounds>> boxes;
};

uint32_t triangles_of(const std::vector<uint32_t>& bits)
{
    const auto clusters = std::accumulate(bits.begin(), bits.end(), 0U, [](uint32_t sum, uint32_t word) {
        return sum + static_cast<uint32_t>(std::popcount(word));
    });
    return clusters * shared::cluster_triangles;
}

cells::Eye eye_of(const Temple& temple, const Camera& camera, const bench::Size& size)
{
    const glm::uvec2 size_px(size.width, size.height);
    const shared::FrameGlobals globals =
        features::frame_globals(camera, temple.layout.bounds, temple.layout.anchor, {.size_px = size_px});
    return *cells::eye_of(features::drawn_clip(globals), temple.layout.anchor, size_px);
}

/// A plan of the temple's prison and of one view of it, seen from above; north (-z) is at the top.
class Map {
public:
    explicit Map(const Scene& scene)
    {
        glm::dvec2 low(1e9);
        glm::dvec2 high(-1e9);
        for (const SceneCell& cell : scene.cells) {
            low = glm::min(low, glm::dvec2(cell.low_m.x, cell.low_m.z));
            high = glm::max(high, glm::dvec2(cell.high_m.x, cell.high_m.z));
        }
        low_m_ = low - glm::dvec2(4.0, 4.0);
        const glm::dvec2 size = (high + glm::dvec2(4.0, 22.0) - low_m_) * pixels_per_m;
        image_.width = static_cast<uint32_t>(size.x);
        image_.height = static_cast<uint32_t>(size.y);
        image_.rgba.assign(size_t{4} * image_.width * image_.height, 255);
    }

    /// Calls `color_of` with the place of each pixel in metres.
    template <typename ColorOf>
    void paint(const ColorOf& color_of)
    {
        for (uint32_t y = 0; y < image_.height; ++y) {
            for (uint32_t x = 0; x < image_.width; ++x) {
                put(glm::ivec2(x, y), color_of(low_m_ + (glm::dvec2(x, y) + 0.5) / pixels_per_m));
            }
        }
    }

    void line(const glm::dvec3& from, const glm::dvec3& to, const glm::u8vec3& color, int half_px)
    {
        const glm::dvec2 a = (glm::dvec2(from.x, from.z) - low_m_) * pixels_per_m;
        const glm::dvec2 b = (glm::dvec2(to.x, to.z) - low_m_) * pixels_per_m;
        const int steps = static_cast<int>(glm::length(b - a)) + 1;
        for (int step = 0; step <= steps; ++step) {
            const glm::ivec2 at(glm::mix(a, b, static_cast<double>(step) / steps));
            for (int y = -half_px; y <= half_px; ++y) {
                for (int x = -half_px; x <= half_px; ++x) {
                    put(at + glm::ivec2(x, y), color);
                }
            }
        }
    }

    [[nodiscard]] const Image& image() const { return image_; }

private:
    static constexpr double pixels_per_m = 12.0;

    void put(const glm::ivec2& at, const glm::u8vec3& color)
    {
        if (at.x >= 0 && at.y >= 0 && at.x < static_cast<int>(image_.width) &&
            at.y < static_cast<int>(image_.height)) {
            uint8_t* const pixel =
                image_.rgba.data() +
                4 * (size_t{image_.width} * static_cast<size_t>(at.y) + static_cast<size_t>(at.x));
            std::copy_n(&color.x, 3, pixel);
        }
    }

    glm::dvec2 low_m_{0.0};
    Image image_;
};

Image plan_of(const Temple& temple, const cells::Eye& eye, const cells::SeenCells& seen,
              const std::vector<uint32_t>& bits)
{
    const Scene& scene = temple.scene;
    Map map(scene);
    map.paint([&](const glm::dvec2& place) {
        const glm::dvec3 at(place.x, eye.place_m.y, place.y);
        Index own = no_index;
        for (Index cell = 0; cell < scene.cells.size(); ++cell) {
            const SceneCell& box = scene.cells[cell];
            if (at.x >= box.low_m.x && at.x <= box.high_m.x && at.z >= box.low_m.z && at.z <= box.high_m.z) {
                own = cell;
            }
        }
        const bool is_in_view = std::ranges::any_of(seen.beams(), [&](const cells::Beam& beam) {
            return beam.cell == own && cells::may_show(eye, beam, {at, at});
        });
        if (is_in_view) {
            return glm::u8vec3(250, 214, 120);
        }
        return own == no_index     ? glm::u8vec3(255, 255, 255)
               : seen.is_seen(own) ? glm::u8vec3(252, 244, 222)
                                   : glm::u8vec3(222, 224, 230);
    });
    // Each triangle is a line or an area seen from above; drawn triangles are dark.
    for (const bool is_drawn : {false, true}) {
        for (uint32_t i = 0; i < temple.layout.triangles.size(); ++i) {
            const uint32_t cluster = i / shared::cluster_triangles;
            const auto& box = temple.boxes[cluster];
            if (!box || ((bits[cluster / 32] >> cluster % 32 & 1U) != 0) != is_drawn) {
                continue;
            }
            const auto corner = [&](int k) {
                const glm::dvec3 rest(temple.layout.stroke_coordinates[temple.layout.triangles[i][k]]);
                return temple.layout.rest_anchor + temple.layout.stroke_unit_m * rest;
            };
            const glm::dvec3 a = corner(0);
            const glm::dvec3 b = corner(1);
            const glm::dvec3 c = corner(2);
            // Only what reaches through the plane at the eye's height belongs to its plan.
            if (std::min({a.y, b.y, c.y}) > eye.place_m.y + 0.5 ||
                std::max({a.y, b.y, c.y}) < eye.place_m.y - 0.5) {
                continue;
            }
            const glm::u8vec3 ink = is_drawn ? glm::u8vec3(30, 30, 40) : glm::u8vec3(176, 180, 192);
            map.line(a, b, ink, 0);
            map.line(b, c, ink, 0);
            map.line(c, a, ink, 0);
        }
    }
    for (const ScenePortal& portal : scene.portals) {
        const bool is_door = portal.corners_m[0].y != portal.corners_m[2].y;
        const glm::u8vec3 color = is_door ? glm::u8vec3(200, 40, 30) : glm::u8vec3(40, 90, 190);
        for (size_t i = 0; i < portal.corners_m.size(); ++i) {
            map.line(portal.corners_m[i], portal.corners_m[(i + 1) % portal.corners_m.size()], color, 1);
        }
    }
    for (int half = 0; half < 5; ++half) {
        const glm::dvec3 off(0.1 * half, 0.0, 0.0);
        map.line(eye.place_m - off, eye.place_m + off, {20, 120, 60}, 3);
    }
    return map.image();
}

void look_around(const Options& options)
{
    Temple temple{.scene = temple::build_temple(options.seed), .layout = {}, .boxes = {}};
    temple.layout = pose::build_meshes(temple.scene, static_cast<Index>(temple.scene.materials.size()));
    temple.boxes = features::still_boxes(temple.layout);
    const cells::CellsOfClusters in_cells(temple.scene.cells, temple.boxes);
    const cells::CellsOfClusters in_the_open({}, temple.boxes);
    fmt::print(
        "temple {}: {} rooms with a roof, {} portals, {} triangles in {} clusters\n"
        "| viewpoint | rooms in sight | beams | triangles on the page | triangles in sight | CPU, ms |\n"
        "|---|---|---|---|---|---|\n",
        options.seed, temple.scene.cells.size(), temple.scene.portals.size(), temple.layout.triangles.size(),
        temple.boxes.size());
    const ScenePose pose = pose_scene(temple.scene, 0.0, no_index);
    bool is_drawn = options.picture.empty();
    for (const SceneCamera& named : temple.scene.cameras) {
        const cells::Eye eye = eye_of(temple, scene_camera(temple.scene, pose, named.name), options.size);
        cells::SeenCells seen;
        std::vector<uint32_t> bits;
        seen.find({}, {}, eye);
        in_the_open.find_seen(eye, seen, bits);
        const uint32_t on_page = triangles_of(bits);
        std::vector<double> times_ms;
        for (uint32_t round = 0; round < options.rounds; ++round) {
            const bench::WallClock clock;
            seen.find(temple.scene.cells, temple.scene.portals, eye);
            in_cells.find_seen(eye, seen, bits);
            times_ms.push_back(clock.ms());
        }
        std::set<Index> rooms;
        for (const cells::Beam& beam : seen.beams()) {
            rooms.insert(beam.cell);
        }
        rooms.erase(no_index);
        fmt::print("| {} | {} | {} | {} | {} | {:.3f} |\n", named.name, rooms.size(), seen.beams().size(),
                   on_page, triangles_of(bits), median_of(times_ms));
        if (!options.picture.empty() && named.name == options.view) {
            save_png(plan_of(temple, eye, seen, bits), options.picture);
            is_drawn = true;
        }
    }
    if (!is_drawn) {
        throw CLI::ValidationError("--view", fmt::format("the temple has no viewpoint {}", options.view));
    }
}

} // namespace

int main(int argc, char** argv)
{
    Options options;
    CLI::App app("Measures culling by cells and portals in the temple", "estampe_bench_cells");
    app.add_option("--seed", options.seed)->capture_default_str();
    app.add_option("--rounds", options.rounds, "Searches per viewpoint")
        ->capture_default_str()
        ->check(bench::up_to(100'000));
    app.add_option("--view", options.view, "Viewpoint of the plan")->capture_default_str();
    app.add_option("--picture", options.picture, "PNG file for a plan of the view, seen from above");
    bench::add_size_option(app, options.size);
    return bench::run(app, argc, argv, [&] { look_around(options); });
}
