// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/textures.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include <estampe/error.hpp>

#include "core/exr.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"

namespace estampe::terrain {
namespace {

constexpr size_t most_texels = size_t{1} << 24;

void check_room(const Program& program, size_t added)
{
    if (program.texels.size() + added > most_texels) {
        throw Error("textures of more than 16.7 million texels in all", {}, "make them smaller");
    }
}

/// An Image or a DeepImage: the mean of its colours, of which the brightest is one.
template <class Picture>
HeightTexture append_picture(Program& program, const Picture& image)
{
    using Value = typename decltype(Picture::rgba)::value_type;
    constexpr auto white = static_cast<float>(3 * std::numeric_limits<Value>::max());
    const size_t count = size_t{image.width} * image.height;
    check_room(program, count);
    for (size_t pixel = 0; pixel < count; ++pixel) {
        const Value* const parts = &image.rgba[pixel * 4];
        program.texels.push_back(static_cast<float>(parts[0] + parts[1] + parts[2]) / white);
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
    if (is_exr(bytes)) {
        return append_floats(program, bytes, path.string());
    }
    const std::optional<DeepImage> deep = decode_deep_image(bytes, path.string());
    return deep ? append_picture(program, *deep)
                : append_picture(program, decode_image(bytes, path.string()));
}

} // namespace

TextureInProgram texture_in(Program& program, const TextureRequest& request,
                            const std::filesystem::path& folder)
{
    const auto is_same = [&](const HeightTexture& texture) {
        return texture.name == request.name && texture.is_mask == request.is_mask &&
               texture.sand == request.sand;
    };
    auto found = std::ranges::find_if(program.textures, is_same);
    if (found == program.textures.end()) {
        const auto first = static_cast<uint32_t>(program.texels.size());
        HeightTexture texture;
        if (request.texels > 0) {
            check_room(program, size_t{request.texels} * request.texels);
            program.texels.resize(first + size_t{request.texels} * request.texels);
            texture = {.name = request.name,
                       .is_mask = request.is_mask,
                       .columns = request.texels,
                       .rows = request.texels,
                       .sand = request.sand};
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
            .mean = request.texels > 0 ? 0.0 : sum / static_cast<double>(count)};
}

} // namespace estampe::terrain
