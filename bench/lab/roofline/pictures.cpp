// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string_view>

#include "lab/roofline/roofline.hpp"

namespace estampe::lab::roofline {
namespace {

BenchPicture of_series(std::string_view name, double amount, uint32_t width, uint32_t height)
{
    const auto& series = all_series();
    const auto found = std::ranges::find_if(series, [&](const Series& one) { return name == one.name; });
    return found->picture(amount, width, height);
}

/// Triangles, lights, shadows, hatching, contours, occlusion and a lens.
BenchPicture field(bool software, uint32_t width, uint32_t height)
{
    BenchPicture picture{.scene = field_of_balls(software ? 70e3 : 1e6),
                         .camera = view_of_field(),
                         .style = {},
                         .width = width,
                         .height = height};
    add_lights(picture.scene, 40, 4);
    picture.style.set("occlusion.drawn=true");
    picture.style.set("lens.mode=gather");
    picture.style.set("lens.f_number=1");
    return picture;
}

BenchPicture smoke(bool software, uint32_t width, uint32_t height)
{
    return of_series("smoke", software ? 32768 : 2097152, width, height);
}

BenchPicture ink(bool /*software*/, uint32_t width, uint32_t height)
{
    return of_series("ink", static_cast<double>(width) * height, width, height);
}

BenchPicture cloth(bool software, uint32_t width, uint32_t height)
{
    return of_series("cloth", software ? 4096 : 65536, width, height);
}

BenchPicture ground(bool software, uint32_t width, uint32_t height)
{
    return of_series("ground", software ? 16384 : 262144, width, height);
}

} // namespace

const std::vector<Entry>& all_pictures()
{
    static const std::vector<Entry> entries{
        {"field", "Triangles, 40 lights, 4 shadows, hatching, contours, occlusion and a lens", field},
        {"smoke", "A fluid of three dimensions, its light and its drawing", smoke},
        {"ink", "A fluid of two dimensions on the page", ink},
        {"cloth", "A sheet in the wind", cloth},
        {"ground", "Dunes found anew in every frame", ground},
    };
    return entries;
}

} // namespace estampe::lab::roofline
