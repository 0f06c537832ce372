// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/textures.hpp"

#include <algorithm>
#include <numeric>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "core/exr.hpp"
#include "core/file.hpp"

namespace estampe::terrain {
namespace {

constexpr size_t most_texels = size_t{1} << 24;

void check_room(const Program& program, size_t added)
{
    if (program.texels.size() + added > most_texels) {
        throw Error("textures of more than 16.7 million texels in all", {}, "make them smaller");
    }
}

HeightTexture append_picture(Program& program, const std::filesystem::path& path)
{
    const Image image = load_image(path);
    const size_t count = size_t{image.width} * image.height;
    check_room(program, count);
    for (size_t pixel = 0; pixel < count; ++pixel) {
        const uint8_t* const parts = &image.rgba[pixel * 4];
        program.texels.push_back(static_cast<float>(parts[0] + parts[1] + parts[2]) / 765.0F);
    }
    return {.columns = image.width, .rows = image.height};
}

HeightTexture append_floats(Program& program, const std::vector<std::byte>& bytes, const std::string& path)
{
    const ExrFile file = decode_exr(bytes, path);
    const size_t count = size_t{file.image.width} * file.image.height;
    check_room(program, count);
    for (size_t pixel = 0; pixel < count; ++pixel) {
        program.texels.push_back(file.image.texels[pixel].x);
    }
    return {.columns = file.image.width, .rows = file.image.height};
}

HeightTexture append_file(Program& program, const std::filesystem::path& path)
{
    constexpr uint64_t largest_bytes = uint64_t{1} << 30;
    const std::vector<std::byte> bytes = read_file(path, largest_bytes);
    return is_exr(bytes) ? append_floats(program, bytes, path.string()) : append_picture(program, path);
}

} // namespace

TextureInProgram texture_in(Program& program, const TextureRequest& request,
                            const std::filesystem::path& folder)
{
    const auto is_same = [&](const HeightTexture& texture) {
        return texture.name == request.name && texture.is_mask == request.is_mask;
    };
    auto found = std::ranges::find_if(program.textures, is_same);
    if (found == program.textures.end()) {
        const auto first = static_cast<uint32_t>(program.texels.size());
        HeightTexture texture;
        if (request.is_mask) {
            check_room(program, size_t{request.texels} * request.texels);
            program.texels.resize(first + size_t{request.texels} * request.texels);
            texture = {
                .name = request.name, .is_mask = true, .columns = request.texels, .rows = request.texels};
        } else {
            texture = append_file(program, folder / request.name);
            texture.name = request.name;
        }
        texture.first_texel = first;
        program.textures.push_back(texture);
        found = program.textures.end() - 1;
    }
    if (request.is_mask && found->columns != request.texels) {
        throw Error("the mask \"" + request.name + "\" is asked for in two sizes");
    }
    const auto begin = program.texels.begin() + found->first_texel;
    const size_t count = size_t{found->columns} * found->rows;
    const double sum = std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(count), 0.0);
    return {.index = static_cast<size_t>(found - program.textures.begin()),
            .mean = request.is_mask ? 0.0 : sum / static_cast<double>(count)};
}

} // namespace estampe::terrain
