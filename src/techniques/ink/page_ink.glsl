// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_PAGE
#define ESTAMPE_INK_PAGE

// Wet and dry ink at places of the page. Requires before inclusion: `frame`, and grid.glsl.

// Wet and dry ink at a place of the page.
vec2 ink_on_page(vec2 page_px)
{
    if (!is_around) {
        return ink_between(grid_place_of_page(page_px));
    }
    vec3 direction = (frame.anchor_from_clip * vec4(ndc_at(page_px, globals.page_px), 0.0, 1.0)).xyz;
    return ink_between(grid_place_of_direction(direction));
}

#endif
