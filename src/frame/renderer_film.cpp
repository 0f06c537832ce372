// SPDX-License-Identifier: MIT
// What the renderer does for films that are drawn in several runs.
#include "frame/renderer_impl.hpp"

#include <cstring>

#include <estampe/error.hpp>

#include "gpu/imports.hpp"
#include "gpu/read_back.hpp"
#include "gpu/upload.hpp"
#include "techniques/contour/chains/chains.glsl.h"

namespace estampe {
namespace {

/// The first of the bytes: changes when what follows does.
constexpr uint64_t signature = 0x37304d4c49465345ULL;

/// Ink that flows, and the camera that saw it.
struct InkHead {
    uint64_t is_there = 0;
    double time_s = 0.0;
    glm::uvec2 size{0};
    glm::vec2 margin_cells{0.0F};
    float cells_per_px = 1.0F;
    float mm_per_cell = 1.0F;
    uint32_t face_side = 0;
    uint32_t sum_now = 0;
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
    glm::dvec3 up{0.0};
    double vertical_fov_rad = 0.0;
    double near_m = 0.0;
    double half_height_m = -1.0; ///< negative: in perspective
};

InkHead ink_head(const features::FlowingInk& ink)
{
    const auto kept = ink.memory().kept();
    if (!kept) {
        return {};
    }
    const Camera& camera = ink.camera_before();
    return {.is_there = 1,
            .time_s = kept->time_s,
            .size = kept->grid.size,
            .margin_cells = kept->grid.margin_cells,
            .cells_per_px = kept->grid.cells_per_px,
            .mm_per_cell = kept->grid.mm_per_cell,
            .face_side = kept->grid.face_side,
            .sum_now = kept->sum_now,
            .eye = camera.eye,
            .target = camera.target,
            .up = camera.up,
            .vertical_fov_rad = camera.vertical_fov_rad,
            .near_m = camera.near_m,
            .half_height_m = camera.orthographic_half_height_m.value_or(-1.0)};
}

ink::Memory::Kept kept_of(const InkHead& head)
{
    return {.grid = {.size = head.size,
                     .margin_cells = head.margin_cells,
                     .cells_per_px = head.cells_per_px,
                     .mm_per_cell = head.mm_per_cell,
                     .face_side = head.face_side},
            .time_s = head.time_s,
            .sum_now = head.sum_now & 1U};
}

Camera camera_of(const InkHead& head)
{
    Camera camera{.eye = head.eye, .target = head.target, .up = head.up};
    camera.vertical_fov_rad = head.vertical_fov_rad;
    camera.near_m = head.near_m;
    if (head.half_height_m >= 0.0) {
        camera.orthographic_half_height_m = head.half_height_m;
    }
    return camera;
}

/// Smoke that rises in a box, ahead of its numbers.
struct SmokeHead {
    uint32_t number = 0;
    glm::uvec3 cells{0};
    float cell_m = 1.0F;
    uint32_t channels = 2; ///< as wide as that no byte between is left open
    double time_s = 0.0;
    double behind_s = 0.0;
};

/// What is written ahead of the buffers.
struct Head {
    uint64_t first = signature;
    glm::uvec2 size_px{0};
    glm::mat4 clip_from_anchor{1.0F};
    std::array<uint32_t, 2> has_lines{}; ///< seen, hidden
    uint64_t has_exposure = 0;           ///< as wide as that no byte between is left open
    double exposure_time_s = 0.0;
    InkHead ink;
    uint64_t smoke_boxes = 0;
    uint64_t has_cloth = 0;
    double cloth_time_s = 0.0;
    uint64_t has_water = 0; ///< that ink stirs
    double water_time_s = 0.0;
    uint64_t water_numbers = 0;
};

class Writer {
public:
    explicit Writer(const Head& head) { append(std::as_bytes(std::span(&head, 1))); }

    void append(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}

    [[nodiscard]] std::span<const std::byte> take(uint64_t size_bytes)
    {
        if (left_.size() < size_bytes) {
            throw Error("this is not the memory of a film's frame");
        }
        const auto taken = left_.first(size_bytes);
        left_ = left_.subspan(size_bytes);
        return taken;
    }

    [[nodiscard]] std::vector<float> take_floats(uint64_t count)
    {
        const auto bytes = take(sizeof(float) * count);
        std::vector<float> numbers(count);
        std::memcpy(numbers.data(), bytes.data(), bytes.size());
        return numbers;
    }

    [[nodiscard]] bool is_at_end() const { return left_.empty(); }

private:
    std::span<const std::byte> left_;
};

/// The buffers to keep, which come to the host in one go.
class Download {
public:
    void add(gpu::Device& device, gpu::Buffer& buffer)
    {
        copies_.emplace_back(device, "film memory", buffer.size_bytes(), gpu::MemoryUse::readback);
        sources_.push_back(&buffer);
    }

    void append_to(Writer& writer, gpu::Executor& executor)
    {
        gpu::Graph graph;
        for (size_t i = 0; i < copies_.size(); ++i) {
            gpu::add_read_back(graph, "remember", gpu::import_whole(graph, "remembered", *sources_[i]),
                               copies_[i]);
        }
        executor.run(graph);
        for (const gpu::Buffer& copy : copies_) {
            writer.append(copy.mapped());
        }
    }

private:
    std::vector<gpu::Buffer> copies_;
    std::vector<gpu::Buffer*> sources_;
};

constexpr std::array line_classes{contour::LineClass::seen, contour::LineClass::hidden};

} // namespace

std::vector<std::byte> Renderer::film_memory() const
{
    Impl& impl = *impl_;
    if (!impl.is_of_film) {
        return {};
    }
    const std::vector<features::KeptSmoke> smoke = impl.rising_smoke.kept(impl.device, impl.executor);
    Head head{.size_px = impl.line_history.size_px(),
              .clip_from_anchor = impl.line_history.clip_from_anchor_before(),
              .has_exposure = impl.exposure.time_s() ? uint64_t{1} : 0,
              .exposure_time_s = impl.exposure.time_s().value_or(0.0),
              .ink = ink_head(impl.flowing_ink),
              .smoke_boxes = smoke.size()};
    features::MovingCloth* const cloth = impl.loaded ? impl.loaded->cloth.get() : nullptr;
    if (cloth != nullptr && cloth->time_s()) {
        head.has_cloth = 1;
        head.cloth_time_s = *cloth->time_s();
    }
    const std::optional<features::KeptWater> water =
        impl.flowing_ink.water().kept(impl.device, impl.executor);
    if (water) {
        head.has_water = 1;
        head.water_time_s = water->time_s;
        head.water_numbers = water->velocity.size();
    }
    Download download;
    for (size_t i = 0; i < line_classes.size(); ++i) {
        const contour::LineClass lines = line_classes.at(i);
        if (impl.line_history.holds_frame(lines)) {
            head.has_lines.at(i) = 1;
            download.add(impl.device, impl.line_history.before(lines).grid);
            download.add(impl.device, impl.line_history.before(lines).samples);
        }
    }
    if (head.has_exposure != 0) {
        download.add(impl.device, impl.exposure.buffer());
    }
    if (head.ink.is_there != 0) {
        for (gpu::Buffer* const buffer : impl.flowing_ink.memory().kept_buffers()) {
            download.add(impl.device, *buffer);
        }
    }
    if (head.has_cloth != 0) {
        for (gpu::Buffer* const buffer : cloth->sheets().state()) {
            download.add(impl.device, *buffer);
        }
    }
    Writer writer(head);
    download.append_to(writer, impl.executor);
    for (const features::KeptSmoke& box : smoke) {
        const SmokeHead of_box{.number = box.number,
                               .cells = box.cells,
                               .cell_m = box.cell_m,
                               .channels = box.channels,
                               .time_s = box.time_s,
                               .behind_s = box.behind_s};
        writer.append(std::as_bytes(std::span(&of_box, 1)));
        writer.append(std::as_bytes(std::span(box.velocity)));
        writer.append(std::as_bytes(std::span(box.quantities)));
    }
    if (water) {
        writer.append(std::as_bytes(std::span(water->velocity)));
    }
    return writer.take();
}

void Renderer::recall_film(std::span<const std::byte> memory)
{
    Impl& impl = *impl_;
    if (!impl.loaded) {
        throw Error("there is no scene to draw", "", "call set_scene first");
    }
    Reader reader(memory);
    Head head;
    std::memcpy(&head, reader.take(sizeof head).data(), sizeof head);
    constexpr uint32_t longest_side_px = 1U << 16U;
    const bool has_lines = head.has_lines.front() != 0;
    const auto is_side = [&](uint32_t side_px) { return side_px > 0 && side_px <= longest_side_px; };
    if (head.first != signature || (has_lines && (!is_side(head.size_px.x) || !is_side(head.size_px.y)))) {
        throw Error("this is not the memory of a film's frame");
    }
    const auto next_buffer = [&](const char* name, uint64_t size_bytes) {
        return gpu::upload_buffer(impl.device, name, reader.take(size_bytes));
    };
    std::array<std::optional<contour::LineHistory::Drawn>, line_classes.size()> drawn;
    for (size_t i = 0; i < line_classes.size(); ++i) {
        if (head.has_lines.at(i) != 0) {
            gpu::Buffer grid =
                next_buffer("line grid", sizeof(glm::uvec2) * contour::grid_cell_count(head.size_px));
            drawn.at(i) = {std::move(grid),
                           next_buffer("drawn samples",
                                       sizeof(shared::DrawnSample) * contour::sample_capacity(head.size_px))};
        }
    }
    std::optional<gpu::Buffer> exposure;
    if (head.has_exposure != 0) {
        exposure = next_buffer("exposure", sizeof(shared::ExposureState));
    }
    std::array<gpu::Buffer, 3> ink;
    if (head.ink.is_there != 0) {
        const auto bytes = ink::Memory::kept_bytes(kept_of(head.ink).grid);
        ink = {next_buffer("ink cells", bytes[0]), next_buffer("ink depths", bytes[1]),
               next_buffer("ink sums", bytes[2])};
    }
    features::MovingCloth* const cloth = impl.loaded->cloth.get();
    std::vector<gpu::Buffer> sheets;
    if (head.has_cloth != 0 && cloth != nullptr) {
        for (const gpu::Buffer* const buffer : cloth->sheets().state()) {
            sheets.push_back(next_buffer("cloth state", buffer->size_bytes()));
        }
    }
    std::vector<features::KeptSmoke> smoke;
    for (uint64_t i = 0; i < head.smoke_boxes; ++i) {
        SmokeHead of_box;
        std::memcpy(&of_box, reader.take(sizeof of_box).data(), sizeof of_box);
        features::KeptSmoke& box = smoke.emplace_back(features::KeptSmoke{.number = of_box.number,
                                                                          .cells = of_box.cells,
                                                                          .cell_m = of_box.cell_m,
                                                                          .time_s = of_box.time_s,
                                                                          .behind_s = of_box.behind_s,
                                                                          .channels = of_box.channels,
                                                                          .velocity = {},
                                                                          .quantities = {}});
        const uint64_t cell_count = features::kept_cell_count(box);
        box.velocity = reader.take_floats(3 * cell_count);
        box.quantities = reader.take_floats(box.channels * cell_count);
    }
    constexpr uint64_t most_numbers = 1U << 20U;
    if (head.water_numbers > most_numbers) {
        throw Error("this is not the memory of a film's frame");
    }
    features::KeptWater water{.time_s = head.water_time_s,
                              .velocity = reader.take_floats(head.water_numbers)};
    if (!reader.is_at_end()) {
        throw Error("this is not the memory of a film's frame");
    }
    if (has_lines) {
        impl.line_history.recall(impl.device, head.size_px, std::move(drawn), head.clip_from_anchor);
    } else {
        impl.line_history.forget();
    }
    impl.exposure.forget();
    if (exposure) {
        impl.exposure.recall(std::move(*exposure), head.exposure_time_s);
    }
    if (head.has_cloth != 0 && cloth != nullptr) {
        cloth->recall(head.cloth_time_s, std::move(sheets));
    }
    impl.flowing_ink.forget();
    if (head.ink.is_there != 0) {
        impl.flowing_ink.memory().recall(impl.device, kept_of(head.ink), std::move(ink));
        impl.flowing_ink.recall_camera(camera_of(head.ink));
    }
    if (head.has_water != 0) {
        impl.flowing_ink.water().recall(std::move(water));
    }
    impl.rising_smoke.recall(std::move(smoke));
    impl.is_of_film = true;
}

} // namespace estampe
