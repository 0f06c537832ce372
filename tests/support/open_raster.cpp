// SPDX-License-Identifier: MIT
#include "support/open_raster.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <pugixml.hpp>
#include <zip.h>

#include "core/image_codec.hpp"

namespace estampe::test {
namespace {

std::vector<std::byte> entry_of(zip_t* archive, const std::string& name)
{
    zip_stat_t status;
    zip_stat_init(&status);
    if (zip_stat(archive, name.c_str(), 0, &status) != 0) {
        ADD_FAILURE() << "there is no " << name;
        return {};
    }
    std::vector<std::byte> bytes(status.size);
    zip_file_t* file = zip_fopen(archive, name.c_str(), 0);
    EXPECT_EQ(zip_fread(file, bytes.data(), bytes.size()), static_cast<zip_int64_t>(bytes.size())) << name;
    zip_fclose(file);
    return bytes;
}

/// The file lists layers from the top down. They are read backwards, so `layers` runs from the bottom up.
void read_stack(const pugi::xml_node& stack, const std::string& group, zip_t* archive,
                std::vector<RasterLayer>& layers)
{
    for (pugi::xml_node child = stack.last_child(); child; child = child.previous_sibling()) {
        if (std::string(child.name()) == "stack") {
            EXPECT_STREQ(child.attribute("composite-op").value(), "svg:src-over");
            read_stack(child, child.attribute("name").value(), archive, layers);
            continue;
        }
        EXPECT_STREQ(child.name(), "layer");
        EXPECT_STREQ(child.attribute("opacity").value(), "1");
        const std::string source = child.attribute("src").value();
        layers.push_back({.name = child.attribute("name").value(),
                          .group = group,
                          .operation = child.attribute("composite-op").value(),
                          .is_visible = std::string(child.attribute("visibility").value()) == "visible",
                          .x = child.attribute("x").as_uint(),
                          .y = child.attribute("y").as_uint(),
                          .image = decode_image(entry_of(archive, source), source)});
    }
}

} // namespace

OpenRaster read_openraster(std::span<const std::byte> bytes)
{
    OpenRaster raster;
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    zip_t* archive = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
    if (archive == nullptr) {
        ADD_FAILURE() << "is no archive: " << zip_error_strerror(&error);
        return raster;
    }
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
        raster.entries.emplace_back(zip_get_name(archive, static_cast<zip_uint64_t>(i), 0));
    }
    const std::vector<std::byte> mimetype = entry_of(archive, "mimetype");
    raster.mimetype.assign(reinterpret_cast<const char*>(mimetype.data()), mimetype.size());
    zip_stat_t status;
    zip_stat(archive, "mimetype", 0, &status);
    raster.is_mimetype_stored = status.comp_method == ZIP_CM_STORE;
    const std::vector<std::byte> text = entry_of(archive, "stack.xml");
    pugi::xml_document document;
    EXPECT_TRUE(document.load_buffer(text.data(), text.size())) << "stack.xml is no XML";
    const pugi::xml_node image = document.child("image");
    raster.width = image.attribute("w").as_uint();
    raster.height = image.attribute("h").as_uint();
    read_stack(image.child("stack"), "", archive, raster.layers);
    raster.merged = decode_image(entry_of(archive, "mergedimage.png"), "mergedimage.png");
    raster.thumbnail = decode_image(entry_of(archive, "Thumbnails/thumbnail.png"), "thumbnail.png");
    zip_discard(archive);
    return raster;
}

std::vector<glm::dvec3> composite(const OpenRaster& raster, bool rounds_each)
{
    std::vector<glm::dvec3> page(size_t{raster.width} * raster.height, glm::dvec3(0.0));
    for (const RasterLayer& layer : raster.layers) {
        if (!layer.is_visible) {
            continue;
        }
        const bool multiplies = layer.operation == "svg:multiply";
        EXPECT_TRUE(multiplies || layer.operation == "svg:src-over") << layer.operation;
        for (uint32_t y = 0; y < layer.image.height; ++y) {
            for (uint32_t x = 0; x < layer.image.width; ++x) {
                const uint8_t* pixel = &layer.image.rgba[4 * (size_t{y} * layer.image.width + x)];
                glm::dvec3& below = page.at(size_t{y + layer.y} * raster.width + x + layer.x);
                const double alpha = pixel[3] / 255.0;
                for (int channel = 0; channel < 3; ++channel) {
                    const double color =
                        multiplies ? pixel[channel] * below[channel] / 255.0 : pixel[channel];
                    below[channel] += (color - below[channel]) * alpha;
                    below[channel] = rounds_each ? std::round(below[channel]) : below[channel];
                }
            }
        }
    }
    for (glm::dvec3& pixel : page) {
        pixel = glm::round(pixel);
    }
    return page;
}

double largest_difference(const std::vector<glm::dvec3>& values, const Image& image)
{
    double largest = values.size() * 4 == image.rgba.size() ? 0.0 : 255.0;
    for (size_t i = 0; i < values.size() && largest < 255.0; ++i) {
        for (size_t channel = 0; channel < 3; ++channel) {
            largest = std::max(largest,
                               std::abs(values[i][static_cast<int>(channel)] - image.rgba[4 * i + channel]));
        }
    }
    return largest;
}

double share_that_differs(const std::vector<glm::dvec3>& values, const Image& image)
{
    size_t count = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 pixel(image.rgba[4 * i], image.rgba[4 * i + 1], image.rgba[4 * i + 2]);
        count += values[i] == pixel ? 0 : 1;
    }
    return static_cast<double>(count) / static_cast<double>(values.size());
}

} // namespace estampe::test
