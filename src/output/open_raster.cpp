// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/image_codec.hpp"
#include "core/srgb.hpp"
#include "core/zip_writer.hpp"
#include "output/layer_files.hpp"
#include "output/xml_text.hpp"

namespace estampe::output {
namespace {

std::string layer_element(const LayerFile& file, const std::string& source)
{
    return fmt::format("<layer name=\"{}\" src=\"{}\" x=\"{}\" y=\"{}\" opacity=\"1\" visibility=\"{}\" "
                       "composite-op=\"{}\"/>\n",
                       escaped(file.name), source, file.x, file.y, file.is_visible ? "visible" : "hidden",
                       file.blend == "multiply" ? "svg:multiply" : "svg:src-over");
}

/// The list of layers, the topmost first; objects on top in a group of their own.
std::string stack_of(const LayeredImage& image, const std::vector<LayerFile>& files,
                     const std::vector<std::string>& sources)
{
    std::string objects;
    std::string others;
    for (size_t i = files.size(); i-- > 0;) {
        (files[i].is_object ? objects : others) += layer_element(files[i], sources[i]);
    }
    if (!objects.empty()) {
        objects = fmt::format("<stack name=\"objects\" opacity=\"1\" visibility=\"visible\" "
                              "composite-op=\"svg:src-over\">\n{}</stack>\n",
                              objects);
    }
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<image version=\"0.0.3\" w=\"{}\" h=\"{}\">\n<stack>\n{}{}</stack>\n</image>\n",
                       image.picture.width, image.picture.height, objects, others);
}

/// The picture at a size of at most 256 pixels, each the mean of the light and the alpha of those it stands
/// for.
Image thumbnail_of(const Image& picture)
{
    constexpr uint32_t longest_side = 256;
    static const auto linear = linear_of_srgb_bytes<float>();
    const uint32_t longest = std::max(picture.width, picture.height);
    const auto reduced = [&](uint32_t side) {
        return longest <= longest_side
                   ? side
                   : std::max(1U, static_cast<uint32_t>(uint64_t{side} * longest_side / longest));
    };
    Image thumbnail{.width = reduced(picture.width), .height = reduced(picture.height), .rgba = {}};
    const auto place = [](uint32_t i, uint32_t from, uint32_t to) {
        return static_cast<uint32_t>(uint64_t{i} * from / to);
    };
    for (uint32_t y = 0; y < thumbnail.height; ++y) {
        for (uint32_t x = 0; x < thumbnail.width; ++x) {
            const uint32_t top = place(y, picture.height, thumbnail.height);
            const uint32_t bottom = std::max(top + 1, place(y + 1, picture.height, thumbnail.height));
            const uint32_t left = place(x, picture.width, thumbnail.width);
            const uint32_t right = std::max(left + 1, place(x + 1, picture.width, thumbnail.width));
            glm::vec4 sum(0.0F); // colour times alpha
            for (uint32_t from_y = top; from_y < bottom; ++from_y) {
                for (uint32_t from_x = left; from_x < right; ++from_x) {
                    const uint8_t* pixel = &picture.rgba[4 * (size_t{from_y} * picture.width + from_x)];
                    const float alpha = static_cast<float>(pixel[3]) / 255.0F;
                    sum += alpha * glm::vec4(linear[pixel[0]], linear[pixel[1]], linear[pixel[2]], 1.0F);
                }
            }
            const float alpha = sum.w / static_cast<float>((bottom - top) * (right - left));
            sum /= std::max(sum.w, 1e-6F);
            for (int channel = 0; channel < 3; ++channel) {
                thumbnail.rgba.push_back(static_cast<uint8_t>(
                    std::lround(255.0F * srgb_from_linear(std::min(sum[channel], 1.0F)))));
            }
            thumbnail.rgba.push_back(static_cast<uint8_t>(std::lround(255.0F * alpha)));
        }
    }
    return thumbnail;
}

} // namespace

std::vector<std::byte> encode_openraster(const LayeredImage& image)
{
    const std::vector<LayerFile> files = layer_files(image, 8);
    std::vector<std::string> sources;
    for (size_t i = 0; i < files.size(); ++i) {
        sources.push_back(fmt::format("data/{:03}.png", i));
    }
    const std::string mimetype = "image/openraster";
    const std::string stack = stack_of(image, files, sources);
    const std::vector<std::byte> merged = encode_png(image.picture);
    const std::vector<std::byte> thumbnail = encode_png(thumbnail_of(image.picture));
    ZipWriter archive;
    archive.add("mimetype", std::as_bytes(std::span(mimetype)),
                false); // first and as it is: so files are told apart
    archive.add("stack.xml", std::as_bytes(std::span(stack)), true);
    for (size_t i = 0; i < files.size(); ++i) {
        archive.add(sources[i], files[i].png, false);
    }
    archive.add("mergedimage.png", merged, false);
    archive.add("Thumbnails/thumbnail.png", thumbnail, false);
    return archive.finish();
}

} // namespace estampe::output
