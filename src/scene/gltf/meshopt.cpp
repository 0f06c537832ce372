// SPDX-License-Identifier: MIT
#include "scene/gltf/meshopt.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <estampe/error.hpp>

namespace estampe::gltf {
namespace {

/// The decoders assert what is checked here.
void check_layout(const MeshoptLayout& layout)
{
    bool good = false;
    if (layout.mode == "ATTRIBUTES") {
        good = layout.stride % 4 == 0 && layout.stride <= 256;
    } else {
        good = (layout.stride == 2 || layout.stride == 4) && layout.filter == "NONE" &&
               (layout.mode == "INDICES" || layout.count % 3 == 0);
    }
    if (layout.filter == "OCTAHEDRAL") {
        good = good && (layout.stride == 4 || layout.stride == 8);
    } else if (layout.filter == "QUATERNION") {
        good = good && layout.stride == 8;
    }
    if (!good) {
        throw Error(fmt::format("{} elements of {} bytes do not go with mode {} and filter {}", layout.count,
                                layout.stride, layout.mode, layout.filter));
    }
}

} // namespace

std::vector<std::byte> decode_meshopt(std::span<const std::byte> source, const MeshoptLayout& layout)
{
    check_layout(layout);
    std::vector<std::byte> decoded(layout.count * layout.stride);
    const auto* bytes = reinterpret_cast<const unsigned char*>(source.data());
    int failure = 0;
    if (layout.mode == "ATTRIBUTES") {
        failure =
            meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.stride, bytes, source.size());
    } else if (layout.mode == "TRIANGLES") {
        failure =
            meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.stride, bytes, source.size());
    } else {
        failure =
            meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.stride, bytes, source.size());
    }
    if (failure != 0) {
        throw Error("the compressed data is damaged", {}, "fetch or export the file again");
    }
    if (layout.filter == "OCTAHEDRAL") {
        meshopt_decodeFilterOct(decoded.data(), layout.count, layout.stride);
    } else if (layout.filter == "QUATERNION") {
        meshopt_decodeFilterQuat(decoded.data(), layout.count, layout.stride);
    } else if (layout.filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(decoded.data(), layout.count, layout.stride);
    }
    return decoded;
}

} // namespace estampe::gltf
