// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/srgb.hpp"
#include "scene/stl/stl_data.hpp"

namespace estampe::stl {
namespace {

constexpr size_t bytes_of_title = 80;
constexpr size_t bytes_of_record = 50;
constexpr size_t facets_at_once = 4096;

uint32_t read_u32(const char* bytes)
{
    std::array<uint8_t, 4> b{};
    std::memcpy(b.data(), bytes, 4);
    return b[0] | uint32_t{b[1]} << 8U | uint32_t{b[2]} << 16U | uint32_t{b[3]} << 24U;
}

float read_float(const char* bytes)
{
    return std::bit_cast<float>(read_u32(bytes));
}

/// The colour of a whole part, which Materialise Magics writes into the title.
std::optional<glm::vec4> part_color(std::string_view title)
{
    constexpr std::string_view key = "COLOR=";
    const size_t at = title.find(key);
    if (at == std::string_view::npos || at + key.size() + 4 > title.size())
        return std::nullopt;
    glm::vec4 color;
    for (int i = 0; i < 4; ++i)
        color[i] = static_cast<float>(static_cast<uint8_t>(title[at + key.size() + static_cast<size_t>(i)])) /
                   255.0F;
    for (int i = 0; i < 3; ++i)
        color[i] = linear_from_srgb(color[i]);
    color.w = 1.0F; // many programs write a zero there
    return color;
}

/// Colours of facets in their last two bytes, five bits each. VisCAM sets the highest bit where there is one,
/// and begins with blue; Magics sets it where the part's colour holds, and begins with red.
class FacetColors {
public:
    explicit FacetColors(std::string_view title) : part_(part_color(title))
    {
        for (size_t i = 0; i < linear_.size(); ++i)
            linear_[i] = linear_from_srgb(static_cast<float>(i) / 31.0F);
    }

    void add(uint16_t bits, size_t facet, std::vector<glm::vec4>& colors) const
    {
        const bool is_marked = (bits & 0x8000U) != 0;
        const bool has_own = part_ ? !is_marked : is_marked;
        if (!has_own && !part_ && colors.empty())
            return;
        colors.resize(facet, glm::vec4(1.0F));
        glm::vec4 color = part_.value_or(glm::vec4(1.0F));
        if (has_own) {
            color = {linear_[bits & 31U], linear_[bits >> 5U & 31U], linear_[bits >> 10U & 31U], 1.0F};
            if (!part_)
                std::swap(color.x, color.z);
        }
        colors.push_back(color);
    }

private:
    std::optional<glm::vec4> part_;
    std::array<float, 32> linear_{};
};

} // namespace

Data parse_binary(Input& input)
{
    const std::string_view head = input.peek(bytes_of_title + 4);
    if (head.size() < bytes_of_title + 4)
        throw Error("is cut off before its facets", input.name(), "check that the file is whole");
    const FacetColors facet_colors(head.substr(0, bytes_of_title));
    const uint32_t said = read_u32(head.data() + bytes_of_title);
    input.skip(bytes_of_title + 4);
    const auto count = static_cast<size_t>(std::min<uint64_t>(said, input.bytes_left() / bytes_of_record));
    Data data;
    if (count < said)
        data.warnings.push_back(fmt::format("is cut off: says {} facets, has {}", said, count));
    if (count == 0)
        return data;
    Solid& solid = data.solids.emplace_back();
    solid.positions.reserve(3 * count);
    for (size_t done = 0; done < count;) {
        const std::string_view bytes = input.peek(bytes_of_record * std::min(count - done, facets_at_once));
        const size_t here = std::min(bytes.size() / bytes_of_record, count - done);
        if (here == 0)
            throw Error("became shorter while it was read", input.name());
        for (size_t facet = 0; facet < here; ++facet) {
            const char* const at = bytes.data() + facet * bytes_of_record;
            for (size_t corner = 0; corner < 3; ++corner) {
                const char* const place = at + 12 + 12 * corner;
                solid.positions.emplace_back(read_float(place), read_float(place + 4), read_float(place + 8));
            }
            facet_colors.add(static_cast<uint16_t>(read_u32(at + 46) >> 16U), done + facet, solid.colors);
        }
        input.skip(here * bytes_of_record);
        done += here;
    }
    return data;
}

} // namespace estampe::stl
