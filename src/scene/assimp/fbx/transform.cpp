// SPDX-License-Identifier: MIT
#include "scene/assimp/fbx/transform.hpp"

#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace estampe::fbx {
namespace {

constexpr int order_xyz = 0;

/// `order` counts as FBX does: XYZ turns about x first.
glm::dquat turn(const glm::dvec3& degrees, int order)
{
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    for (const int axis : orders[order >= 0 && order < 6 ? static_cast<size_t>(order) : 0]) {
        glm::dvec3 about{0.0};
        about[axis] = 1.0;
        rotation = glm::angleAxis(glm::radians(degrees[axis]), about) * rotation;
    }
    return rotation;
}

glm::dmat4 moved(const glm::dvec3& by)
{
    return glm::translate(glm::dmat4(1.0), by);
}

/// An axis of the file: 0 to 2 with a sign.
glm::dvec3 axis_of(const Properties& settings, const std::string& name, double fallback)
{
    const double axis = settings.number(name).value_or(fallback);
    glm::dvec3 direction{0.0};
    if (axis == 0.0 || axis == 1.0 || axis == 2.0)
        direction[static_cast<int>(axis)] = settings.number(name + "Sign").value_or(1.0) < 0.0 ? -1.0 : 1.0;
    return direction;
}

/// Rows are the file's axes to the right, up and to the front.
glm::dmat3 axes_of(const Properties& settings)
{
    const glm::dmat3 axes(axis_of(settings, "CoordAxis", 0.0), axis_of(settings, "UpAxis", 1.0),
                          axis_of(settings, "FrontAxis", 2.0));
    return std::abs(glm::determinant(axes)) == 1.0 ? glm::transpose(axes) : glm::dmat3(1.0);
}

} // namespace

glm::dmat4 Parts::matrix() const
{
    return moved(translation) * before_rotation * glm::mat4_cast(rotation) * before_scale *
           glm::scale(glm::dmat4(1.0), scale) * after_scale;
}

bool Parts::is_plain() const
{
    const glm::dmat4 none(1.0);
    return before_rotation == none && before_scale == none && after_scale == none;
}

Parts parts_of(const Properties& model)
{
    const glm::dvec3 zero{0.0};
    const auto vector = [&](const char* name) { return model.vector(name).value_or(zero); };
    const bool turns_freely = model.number("RotationActive").value_or(1.0) != 0.0 &&
                              model.number("RotationSpaceForLimitOnly").value_or(0.0) == 0.0;
    const int order =
        turns_freely ? static_cast<int>(model.number("RotationOrder").value_or(order_xyz)) : order_xyz;
    const glm::dvec3 rotation_pivot = vector("RotationPivot");
    const glm::dvec3 scaling_pivot = vector("ScalingPivot");
    Parts parts;
    parts.translation = vector("Lcl Translation");
    parts.rotation = turn(vector("Lcl Rotation"), order);
    parts.scale = model.vector("Lcl Scaling").value_or(glm::dvec3(1.0));
    parts.before_rotation = moved(vector("RotationOffset") + rotation_pivot);
    parts.before_scale = moved(vector("ScalingOffset") + scaling_pivot - rotation_pivot);
    if (turns_freely) {
        parts.before_rotation *= glm::mat4_cast(turn(vector("PreRotation"), order_xyz));
        parts.before_scale =
            glm::mat4_cast(glm::conjugate(turn(vector("PostRotation"), order_xyz))) * parts.before_scale;
    }
    parts.after_scale = moved(-scaling_pivot);
    parts.geometry = glm::scale(moved(vector("GeometricTranslation")) *
                                    glm::mat4_cast(turn(vector("GeometricRotation"), order_xyz)),
                                model.vector("GeometricScaling").value_or(glm::dvec3(1.0)));
    return parts;
}

glm::dmat4 world_from_file(const Properties& settings)
{
    return glm::scale(glm::dmat4(1.0), glm::dvec3(unit_m(settings))) * glm::dmat4(axes_of(settings));
}

glm::dvec3 up_of_file(const Properties& settings)
{
    return glm::transpose(axes_of(settings)) * glm::dvec3(0.0, 1.0, 0.0);
}

double unit_m(const Properties& settings)
{
    const double centimetres = settings.number("UnitScaleFactor").value_or(1.0);
    return 0.01 * (centimetres > 0.0 ? centimetres : 1.0);
}

} // namespace estampe::fbx
