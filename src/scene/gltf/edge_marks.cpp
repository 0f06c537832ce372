// SPDX-License-Identifier: MIT
#include "scene/gltf/convert.hpp"

#include <algorithm>
#include <array>

namespace estampe::gltf {
namespace {

constexpr auto extension_name = "EXT_mesh_primitive_edge_visibility";
constexpr uint32_t hard = 2; // smallest visibility value of a marked edge; larger values mark the edge too

/// The set of marked edges. The key of an edge has the smaller vertex index in its upper 32 bits.
class MarkedEdges {
public:
    void add(uint32_t a, uint32_t b) { keys_.push_back(key(a, b)); }

    void sort()
    {
        std::ranges::sort(keys_);
        keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
        is_met_.assign(keys_.size(), false);
    }

    /// Returns whether an edge is marked. Also records that at least one triangle has this edge.
    bool meet(uint32_t a, uint32_t b)
    {
        const auto found = std::ranges::lower_bound(keys_, key(a, b));
        const bool is_there = found != keys_.end() && *found == key(a, b);
        if (is_there) {
            is_met_[static_cast<size_t>(found - keys_.begin())] = true;
        }
        return is_there;
    }

    [[nodiscard]] size_t count() const { return keys_.size(); }

    [[nodiscard]] size_t count_unmet() const
    {
        return static_cast<size_t>(std::ranges::count(is_met_, false));
    }

private:
    static uint64_t key(uint32_t a, uint32_t b) { return uint64_t{std::min(a, b)} << 32U | std::max(a, b); }

    std::vector<uint64_t> keys_;
    std::vector<bool> is_met_;
};

size_t triangle_count(int mode, size_t index_count)
{
    return mode == TINYGLTF_MODE_TRIANGLES ? index_count / 3 : std::max<size_t>(index_count, 2) - 2;
}

/// Returns the corners of a triangle in the order that glTF specifies. The bits of edge visibility refer to
/// this order.
std::array<uint32_t, 3> corners_of(int mode, std::span<const uint32_t> indices, size_t triangle)
{
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return {indices[triangle], indices[triangle + 1 + triangle % 2],
                indices[triangle + 2 - triangle % 2]};
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {indices[triangle + 1], indices[triangle + 2], indices[0]};
    default:
        return {indices[3 * triangle], indices[3 * triangle + 1], indices[3 * triangle + 2]};
    }
}

class MarkReader {
public:
    MarkReader(Data& data, std::span<const uint32_t> indices, int mode, std::string pointer)
        : data_(data), indices_(indices), mode_(mode), pointer_(std::move(pointer))
    {
    }

    void read_visibility(int accessor)
    {
        const std::string at = pointer_ + "/visibility";
        check_scalar(accessor, at);
        if (accessor_of(data_, accessor).componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
            data_.fail(at, fmt::format("accessor {} is not of unsigned bytes", accessor));
        }
        const size_t triangles = triangle_count(mode_, indices_.size());
        const size_t wanted = (6 * triangles + 7) / 8;
        if (accessor_of(data_, accessor).count != wanted) {
            data_.fail(at, fmt::format("accessor {} has {} bytes; {} triangles need {}", accessor,
                                       accessor_of(data_, accessor).count, triangles, wanted));
        }
        const std::vector<uint32_t> bytes = read_integers(data_, accessor, 1);
        for (size_t t = 0; t < triangles; ++t) {
            const auto corners = corners_of(mode_, indices_, t);
            for (size_t k = 0; k < 3; ++k) {
                const size_t bit = 2 * (3 * t + k);
                if ((bytes[bit / 8] >> (bit % 8) & 3U) >= hard) {
                    edges_.add(corners[k], corners[(k + 1) % 3]);
                }
            }
        }
    }

    void read_line_string(int accessor, size_t vertex_count, const std::string& at)
    {
        check_scalar(accessor, at);
        const int type = accessor_of(data_, accessor).componentType;
        const uint32_t restart = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 0xffU
                                 : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 0xffffU
                                                                                  : 0xffffffffU;
        const std::vector<uint32_t> points = read_integers(data_, accessor, 1);
        size_t length = 0;
        for (size_t i = 0; i <= points.size(); ++i) {
            if (i == points.size() || points[i] == restart) {
                if (length < 2) {
                    data_.fail(at, fmt::format("a line string that ends at entry {} has no two points", i));
                }
                length = 0;
                continue;
            }
            if (points[i] >= vertex_count) {
                data_.fail(at,
                           fmt::format("entry {} is {}, past the {} vertices", i, points[i], vertex_count));
            }
            if (length > 0) {
                edges_.add(points[i - 1], points[i]);
            }
            ++length;
        }
    }

    void mark(Primitive& primitive)
    {
        edges_.sort();
        data_.spend(primitive.indices.size() / 3, pointer_);
        primitive.edge_marks.assign(primitive.indices.size() / 3, 0);
        for (size_t t = 0; t < primitive.edge_marks.size(); ++t) {
            for (size_t k = 0; k < 3; ++k) {
                if (edges_.meet(primitive.indices[3 * t + k], primitive.indices[3 * t + (k + 1) % 3])) {
                    primitive.edge_marks[t] |= static_cast<uint8_t>(1U << k);
                }
            }
        }
        if (edges_.count_unmet() > 0) {
            data_.warn(pointer_, fmt::format("{} of {} marked edges run along no triangle; they are left out",
                                             edges_.count_unmet(), edges_.count()));
        }
    }

private:
    void check_scalar(int accessor, const std::string& at) const
    {
        const int components = component_count(accessor_of(data_, accessor));
        if (components != 1) {
            data_.fail(at, fmt::format("accessor {} has {} components, not 1", accessor, components));
        }
    }

    Data& data_;
    std::span<const uint32_t> indices_;
    int mode_;
    std::string pointer_;
    MarkedEdges edges_;
};

} // namespace

void read_edge_marks(Data& data, const tinygltf::Primitive& source, std::span<const uint32_t> indices,
                     Primitive& primitive, const std::string& pointer)
{
    const auto found = source.extensions.find(extension_name);
    if (found == source.extensions.end()) {
        return;
    }
    const tinygltf::Value& extension = found->second;
    const std::string at = fmt::format("{}/extensions/{}", pointer, extension_name);
    if (primitive.topology != Topology::triangles) {
        data.warn(at, "only triangles have edges to mark; it is left out");
        return;
    }
    if (!extension.Has("visibility") && !extension.Has("lineStrings")) {
        data.fail(at, "lacks both \"visibility\" and \"lineStrings\"");
    }
    MarkReader reader(data, indices, source.mode < 0 ? TINYGLTF_MODE_TRIANGLES : source.mode, at);
    if (extension.Has("visibility")) {
        reader.read_visibility(extension.Get("visibility").GetNumberAsInt());
    }
    if (extension.Has("lineStrings")) {
        const tinygltf::Value& strings = extension.Get("lineStrings");
        for (size_t i = 0; i < strings.ArrayLen(); ++i) {
            reader.read_line_string(strings.Get(static_cast<int>(i)).Get("indices").GetNumberAsInt(),
                                    primitive.positions.size(),
                                    fmt::format("{}/lineStrings/{}/indices", at, i));
        }
    }
    reader.mark(primitive);
}

} // namespace estampe::gltf
