// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_MATTER
#define ESTAMPE_FLUID_MATTER

// Sources, fading, cooling, combustion, condensation and evaporation of a cell's quantities. Requires
// `matter`, a FluidMatter. Include fluid_matter.glsl after fluid_shapes.glsl; the requirements of
// fluid_shapes.glsl apply.

#include "techniques/fluid/pressure/fluid_growth.glsl"

const int most_channels = (variant & fluid_bit_few) != 0u ? fluid_fuel : int(fluid_most_channels);

float gain_of_channel(FluidShape shape, int channel)
{
    return channel < 4 ? shape.gain[channel] : shape.more_gain[channel - 4];
}

// Burns fuel above the ignition temperature, which becomes heat and smoke.
void burn(inout float amounts[fluid_most_channels])
{
    float burnt = amounts[fluid_temperature] >= matter.ignition ? matter.burnt * amounts[fluid_fuel] : 0.0;
    amounts[fluid_fuel] -= burnt;
    amounts[fluid_temperature] += matter.heat_of_fuel * burnt;
    amounts[fluid_density] += matter.smoke_of_fuel * burnt;
}

float vapour_held(float temperature, float height_m)
{
    return matter.saturation *
           exp(matter.saturation_heat * temperature - matter.saturation_height * height_m);
}

// Exchanges air through open ends: fuel and cloud leave, and vapour approaches the vapour of the outside air.
void exchange(inout float amounts[fluid_most_channels], float stays, float height_m)
{
    amounts[fluid_fuel] *= stays;
    amounts[fluid_cloud] *= stays;
    float outside = min(matter.outside_vapour, vapour_held(0.0, height_m));
    amounts[fluid_vapour] = mix(outside, amounts[fluid_vapour], stays);
}

// Excess vapour condenses into cloud; cloud evaporates if the air holds more vapour.
void condense(inout float amounts[fluid_most_channels], float height_m)
{
    float most = vapour_held(amounts[fluid_temperature], height_m);
    float moved = max(matter.condensed * (amounts[fluid_vapour] - most), -amounts[fluid_cloud]);
    amounts[fluid_vapour] -= moved;
    amounts[fluid_cloud] += moved;
    amounts[fluid_temperature] += matter.latent_heat * moved;
}

// Thins the quantities of fluid that has grown, so that their sums over the grown volume stay as they were.
// The temperature counts as such an amount, so expanding fluid cools.
void thin(inout float amounts[fluid_most_channels])
{
    float share = 1.0 / growth_at(amounts[fluid_temperature], matter.expands_above, matter.excess_kept);
    for (int i = 0; i < min(most_channels, fluid_cloud + 1); ++i) {
        amounts[i] *= share;
    }
}

// Applies all changes of a cell's quantities in a step. Channels from `most_channels` on do not change.
void settle(inout float amounts[fluid_most_channels], ivec3 cell)
{
    vec3 place_m = (vec3(cell) + 0.5) * shapes.cell_m;
    if ((variant & fluid_bit_expanding) != 0u) {
        thin(amounts);
    }
    float least = 0.0; // lowest density that the sources allow in the cell
    float least_vapour = 0.0;
    for (uint k = shapes.obstacle_count; k < shapes.count; ++k) {
        float cover = cover_of(shape_list[k], place_m);
        for (int i = 0; i < most_channels; ++i) {
            amounts[i] += shapes.step_s * cover * gain_of_channel(shape_list[k], i);
        }
        least = max(least, cover * shape_list[k].least_density);
        least_vapour = max(least_vapour, cover * shape_list[k].least_vapour);
    }
    float stays = 1.0 - matter.rim_share * closeness_to_rim(vec3(cell) + 0.5, matter.rim_cells);
    amounts[fluid_density] *= stays * matter.density_kept;
    amounts[fluid_temperature] *= stays * matter.heat_kept;
    if ((variant & fluid_bit_few) == 0u) {
        exchange(amounts, stays, place_m.y);
        amounts[fluid_vapour] =
            least_vapour > 0.0 ? max(amounts[fluid_vapour], least_vapour) : amounts[fluid_vapour];
    }
    if ((variant & fluid_bit_burning) != 0u) {
        burn(amounts);
    }
    if ((variant & fluid_bit_condensing) != 0u) {
        condense(amounts, place_m.y);
    }
    amounts[fluid_density] = least > 0.0 ? max(amounts[fluid_density], least) : amounts[fluid_density];
}

#endif
