// SPDX-License-Identifier: MIT
#include "core/exr.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <stdexcept>

#include <ImfChannelList.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/child/child.hpp"
#include "core/file.hpp"
#include "core/free_memory.hpp"
#include "core/image_codec.hpp"

namespace estampe {
namespace {

constexpr float largest_half = 65504.0F;
constexpr uint32_t exr_magic = 20000630;

class MemoryReader : public Imf::IStream {
public:
    MemoryReader(std::span<const std::byte> bytes, const std::string& name)
        : Imf::IStream(name.c_str()), bytes_(bytes)
    {
    }

    bool read(char target[], int count) override
    {
        const auto wanted = static_cast<uint64_t>(count);
        if (count < 0 || wanted > bytes_.size() - std::min<uint64_t>(place_, bytes_.size())) {
            throw std::runtime_error("the file ends too early");
        }
        std::memcpy(target, bytes_.data() + place_, wanted);
        place_ += wanted;
        return place_ < bytes_.size();
    }

    uint64_t tellg() override { return place_; }

    void seekg(uint64_t place) override { place_ = place; }

private:
    std::span<const std::byte> bytes_;
    uint64_t place_ = 0;
};

class MemoryWriter : public Imf::OStream {
public:
    MemoryWriter() : Imf::OStream("picture") {}

    void write(const char source[], int count) override
    {
        const auto length = static_cast<uint64_t>(count);
        bytes.resize(std::max<uint64_t>(bytes.size(), place_ + length));
        std::memcpy(bytes.data() + place_, source, length);
        place_ += length;
    }

    uint64_t tellp() override { return place_; }

    void seekp(uint64_t place) override { place_ = place; }

    std::vector<std::byte> bytes;

private:
    uint64_t place_ = 0;
};

float sound(float value)
{
    return std::isfinite(value) ? std::clamp(value, 0.0F, largest_half) : 0.0F;
}

ExrFile read_picture(std::span<const std::byte> bytes, const std::string& name)
{
    MemoryReader stream(bytes, name);
    Imf::RgbaInputFile file(stream, 0);
    const Imath::Box2i window = file.dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1 || width > max_image_side || height > max_image_side ||
        static_cast<uint64_t>(width * height) > max_image_pixels) {
        throw Error(fmt::format("a picture of {} x {} pixels is beyond the limits", width, height), name);
    }
    require_memory(static_cast<uint64_t>(width * height) * sizeof(glm::vec3),
                   fmt::format("a picture of {} x {} pixels", width, height), name);
    ExrFile result;
    result.image.width = static_cast<uint32_t>(width);
    result.image.height = static_cast<uint32_t>(height);
    std::vector<Imf::Rgba> row(static_cast<size_t>(width));
    result.image.texels.reserve(static_cast<size_t>(width * height));
    for (int y = window.min.y; y <= window.max.y; ++y) {
        file.setFrameBuffer(row.data() - window.min.x - int64_t{y} * width, 1, static_cast<size_t>(width));
        file.readPixels(y);
        for (const Imf::Rgba& texel : row) {
            result.image.texels.emplace_back(sound(texel.r), sound(texel.g), sound(texel.b));
        }
    }
    for (auto entry = file.header().begin(); entry != file.header().end(); ++entry) {
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute())) {
            result.texts[entry.name()] = text->value();
        } else if (const auto* list = dynamic_cast<const Imf::FloatVectorAttribute*>(&entry.attribute())) {
            result.numbers[entry.name()] = list->value();
        }
    }
    return result;
}

} // namespace

bool is_exr(std::span<const std::byte> bytes)
{
    uint32_t magic = 0;
    std::memcpy(&magic, bytes.data(), std::min(bytes.size(), sizeof magic));
    return magic == exr_magic;
}

std::vector<std::byte> encode_exr(const ExrFile& file)
{
    const LightImage& image = file.image;
    if (image.empty() || image.texels.size() != static_cast<size_t>(image.width) * image.height) {
        throw Error("an empty picture cannot be written");
    }
    const auto width = static_cast<int>(image.width);
    const auto height = static_cast<int>(image.height);
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, text] : file.texts) {
        header.insert(key, Imf::StringAttribute(text));
    }
    for (const auto& [key, list] : file.numbers) {
        header.insert(key, Imf::FloatVectorAttribute(list));
    }
    std::vector<Imf::Rgba> texels;
    texels.reserve(image.texels.size());
    for (const glm::vec3& texel : image.texels) {
        texels.emplace_back(sound(texel.x), sound(texel.y), sound(texel.z), 1.0F);
    }
    MemoryWriter stream;
    {
        Imf::RgbaOutputFile output(stream, header, Imf::WRITE_RGB, 0);
        output.setFrameBuffer(texels.data(), 1, image.width);
        output.writePixels(height);
    }
    return std::move(stream.bytes);
}

namespace {

/// Encodes red, green, blue and alpha as floats, bit-exact. Throws Error if the picture is empty.
std::vector<std::byte> encode_float_exr(uint32_t width, uint32_t height, std::span<const glm::vec4> texels)
{
    if (texels.empty() || texels.size() != static_cast<size_t>(width) * height) {
        throw Error("an empty picture cannot be written");
    }
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer channels;
    // A writable copy, because OpenEXR's frame buffer requires writable data.
    std::vector<glm::vec4> rows(texels.begin(), texels.end());
    static constexpr const char* names[] = {"R", "G", "B", "A"};
    for (int i = 0; i < 4; ++i) {
        header.channels().insert(names[i], Imf::Channel(Imf::FLOAT));
        channels.insert(names[i], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&rows[0][i]),
                                             sizeof(glm::vec4), sizeof(glm::vec4) * width));
    }
    MemoryWriter stream;
    {
        Imf::OutputFile output(stream, header, 0);
        output.setFrameBuffer(channels);
        output.writePixels(static_cast<int>(height));
    }
    return std::move(stream.bytes);
}

} // namespace

std::vector<std::byte> encode_exr(uint32_t width, uint32_t height, std::span<const ExrChannel> channels,
                                  ExrNumbers numbers, const std::map<std::string, std::string>& texts)
{
    if (width == 0 || height == 0 || channels.empty()) {
        throw Error("an empty picture cannot be written");
    }
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities()); // Declares the primaries of Rec. 709
    for (const auto& [key, text] : texts) {
        header.insert(key, Imf::StringAttribute(text));
    }
    // The buffer holds one row per channel and is reused for each row of the picture.
    const bool is_half = numbers == ExrNumbers::half;
    std::vector<std::vector<float>> rows(channels.size(), std::vector<float>(width));
    std::vector<std::vector<Imath::half>> halves(channels.size(),
                                                 std::vector<Imath::half>(is_half ? width : 0));
    Imf::FrameBuffer slices;
    for (size_t i = 0; i < channels.size(); ++i) {
        const Imf::PixelType type = is_half ? Imf::HALF : Imf::FLOAT;
        char* const row =
            is_half ? reinterpret_cast<char*>(halves[i].data()) : reinterpret_cast<char*>(rows[i].data());
        header.channels().insert(channels[i].name, Imf::Channel(type));
        slices.insert(channels[i].name,
                      Imf::Slice(type, row, is_half ? sizeof(Imath::half) : sizeof(float), 0));
    }
    MemoryWriter stream;
    {
        Imf::OutputFile output(stream, header, 0);
        output.setFrameBuffer(slices);
        for (uint32_t y = 0; y < height; ++y) {
            for (size_t i = 0; i < channels.size(); ++i) {
                channels[i].fill(y, rows[i]);
                std::transform(
                    rows[i].begin(), rows[i].begin() + static_cast<std::ptrdiff_t>(halves[i].size()),
                    halves[i].begin(),
                    [](float value) { return Imath::half(std::clamp(value, -largest_half, largest_half)); });
            }
            output.writePixels(1);
        }
    }
    return std::move(stream.bytes);
}

ExrFile decode_exr(std::span<const std::byte> bytes, const std::string& name)
{
    if (!is_exr(bytes)) {
        throw Error("is not an OpenEXR picture", name);
    }
    try {
        return read_picture(bytes, name);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {
        const std::string_view reason = problem.what();
        throw Error(fmt::format("is damaged: {}", reason.substr(0, reason.find('\n'))), name);
    }
}

namespace {

constexpr const char* geometry_key = "estampe:geometry";
constexpr const char* settings_key = "estampe:settings";
constexpr float most_kinds = baked_directional | baked_point | baked_spot;
constexpr const char* corners_key = "estampe:corners";
constexpr const char* numbers_key = "estampe:exposure and kinds of lights";

template <class Map>
typename Map::mapped_type taken(Map& attributes, const char* key, const std::filesystem::path& path)
{
    const auto found = attributes.find(key);
    if (found == attributes.end()) {
        throw Error("is an OpenEXR picture, but not a lightmap", path.string(),
                    "estampe bake makes one; a program that writes it anew must keep its header");
    }
    return std::move(found->second);
}

bool is_place(float x)
{
    return x >= 0.0F && x <= 1.0F;
}

} // namespace

void save_lightmap(const Lightmap& map, const std::filesystem::path& path)
{
    if (!map.pictures.empty()) {
        throw Error("is made of pictures that its scene names; only baked lightmaps are saved",
                    path.string());
    }
    ExrFile file{.image = map.light};
    file.texts[geometry_key] = map.geometry;
    file.texts[settings_key] = map.settings;
    file.numbers[numbers_key] = {map.exposure, static_cast<float>(map.baked_lights)};
    std::vector<float>& corners = file.numbers[corners_key];
    corners.reserve(2 * map.corners.size());
    for (const glm::vec2& corner : map.corners) {
        corners.push_back(corner.x);
        corners.push_back(corner.y);
    }
    write_file_atomically(path, encode_exr(file));
}

bool is_baked(const ExrFile& file)
{
    return file.texts.contains(geometry_key);
}

Lightmap baked_lightmap(ExrFile file, const std::filesystem::path& path)
{
    Lightmap map;
    map.geometry = taken(file.texts, geometry_key, path);
    map.settings = taken(file.texts, settings_key, path);
    const std::vector<float> numbers = taken(file.numbers, numbers_key, path);
    const std::vector<float> corners = taken(file.numbers, corners_key, path);
    map.light = std::move(file.image);
    if (numbers.size() != 2 || !std::isfinite(numbers[0]) || numbers[0] <= 0.0F || !(numbers[1] >= 0.0F) ||
        numbers[1] > most_kinds || corners.size() % 6 != 0) {
        throw Error("is a damaged lightmap", path.string(), "bake it again");
    }
    map.exposure = numbers[0];
    map.baked_lights = static_cast<uint32_t>(numbers[1]);
    for (size_t i = 0; i < corners.size(); i += 2) {
        if (!is_place(corners[i]) || !is_place(corners[i + 1])) {
            throw Error("is a damaged lightmap", path.string(), "bake it again");
        }
        map.corners.emplace_back(corners[i], corners[i + 1]);
    }
    return map;
}

namespace {

bool is_well_formed(const LightImage& image)
{
    return image.width <= max_image_side && image.height <= max_image_side &&
           image.texels.size() == size_t{image.width} * image.height;
}

} // namespace

bool is_well_formed(const Lightmap& map)
{
    const auto is_worn_well = [&map](const std::optional<WornPicture>& worn) {
        return !worn || (worn->picture < map.pictures.size() && worn->uv_set <= 1);
    };
    return is_well_formed(map.light) && map.exposure > 0.0F &&
           static_cast<float>(map.baked_lights) <= most_kinds && map.corners.size() % 3 == 0 &&
           std::ranges::all_of(
               map.corners,
               [](const glm::vec2& corner) { return is_place(corner.x) && is_place(corner.y); }) &&
           std::ranges::all_of(map.pictures, [](const LightImage& image) { return is_well_formed(image); }) &&
           std::ranges::all_of(map.of_node, is_worn_well) &&
           std::ranges::all_of(map.of_material, is_worn_well) && is_worn_well(map.of_scene);
}

Lightmap load_lightmap(const std::filesystem::path& path, const ReadScope& scope)
{
    const auto read = [&] {
        constexpr uint64_t max_file_bytes = uint64_t{1} << 32;
        return baked_lightmap(decode_exr(read_file(path, max_file_bytes, scope), path.string()), path);
    };
    Lightmap map = run_in_child(read, limits_for_file(path, scope), path.string());
    if (!is_well_formed(map)) {
        throw Error("what was read from it came back damaged", path.string());
    }
    return map;
}

std::vector<std::byte> encode_motion(const Motion& motion, const std::filesystem::path& path)
{
    if (motion.pixels.empty()) {
        throw Error("there is no motion to write", path.string(),
                    "ask for it in RenderSettings::motion_since");
    }
    return encode_float_exr(motion.width, motion.height, motion.pixels);
}

void save_motion(const Motion& motion, const std::filesystem::path& path)
{
    write_file_atomically(path, encode_motion(motion, path));
}

} // namespace estampe
