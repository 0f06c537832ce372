// SPDX-License-Identifier: MIT
#pragma once

// Builds FBX files for tests, as text.

#include <string>

#include <fmt/format.h>

namespace estampe::fbx::test {

/// The sections of an FBX text file. Each section is a list of lines.
struct File {
    std::string creator = "FBX SDK/FBX Plugins version 2020.1";
    std::string settings;
    std::string definitions;
    std::string objects;
    std::string connections;

    [[nodiscard]] std::string text() const
    {
        return fmt::format(
            "; FBX 7.4.0 project file\n"
            "FBXHeaderExtension:  {{\nFBXHeaderVersion: 1003\nFBXVersion: 7400\nCreator: \"{}\"\n}}\n"
            "GlobalSettings:  {{\nVersion: 1000\nProperties70:  {{\n{}}}\n}}\n"
            "Definitions:  {{\nVersion: 100\n{}}}\n"
            "Objects:  {{\n{}}}\nConnections:  {{\n{}}}\n",
            creator, settings, definitions, objects, connections);
    }

    void link(int child, int parent) { connections += fmt::format("C: \"OO\",{},{}\n", child, parent); }

    void link(int child, int parent, const std::string& property)
    {
        connections += fmt::format("C: \"OP\",{},{}, \"{}\"\n", child, parent, property);
    }

    /// Adds a model (a node) to the file. `kind` is the FBX type: Mesh, Camera, Light or Null.
    void add_model(int id, const std::string& name, const std::string& kind, const std::string& properties,
                   int parent = 0)
    {
        objects += fmt::format("Model: {}, \"Model::{}\", \"{}\" {{\nVersion: 232\n"
                               "Properties70:  {{\n{}}}\nShading: Y\nCulling: \"CullingOff\"\n}}\n",
                               id, name, kind, properties);
        link(id, parent);
    }

    void add_attribute(int id, const std::string& kind, const std::string& properties, int model)
    {
        objects += fmt::format("NodeAttribute: {}, \"NodeAttribute::\", \"{}\" {{\nProperties70:  {{\n{}}}\n"
                               "TypeFlags: \"{}\"\n}}\n",
                               id, kind, properties, kind);
        link(id, model);
    }

    /// Adds a tetrahedron with edges of 1, 2 and 3 along x, y and z; its corner lies at (offset, offset,
    /// offset).
    void add_tetrahedron(int id, int model, double offset = 0.0)
    {
        const double o = offset;
        objects += fmt::format("Geometry: {}, \"Geometry::\", \"Mesh\" {{\n"
                               "Vertices: *12 {{\na: {},{},{},{},{},{},{},{},{},{},{},{}\n}}\n"
                               "PolygonVertexIndex: *12 {{\na: 0,2,-2,0,1,-4,0,3,-3,1,2,-4\n}}\n"
                               "GeometryVersion: 124\n}}\n",
                               id, o, o, o, o + 1, o, o, o, o + 2, o, o, o, o + 3);
        link(id, model);
    }

    /// Animates one axis of a vector property of a model, such as its translation along x, with two keys.
    void animate(int first_id, int model, const std::string& property, const std::string& axis,
                 double start_s, double stop_s, double from, double to)
    {
        const auto time = [](double s) { return static_cast<long long>(s * 46186158000.0); };
        const int stack = first_id;
        const int layer = first_id + 1;
        const int node = first_id + 2;
        const int curve = first_id + 3;
        objects += fmt::format("AnimationStack: {}, \"AnimStack::Take 001\", \"\" {{\nProperties70:  {{\n"
                               "P: \"LocalStart\", \"KTime\", \"Time\", \"\",{}\nP: \"LocalStop\", "
                               "\"KTime\", \"Time\", \"\",{}\n}}\n}}\n"
                               "AnimationLayer: {}, \"AnimLayer::Base\", \"\" {{\n}}\n"
                               "AnimationCurveNode: {}, \"AnimCurveNode::T\", \"\" {{\nProperties70:  {{\n"
                               "P: \"d|{}\", \"Number\", \"\", \"A\",{}\n}}\n}}\n"
                               "AnimationCurve: {}, \"AnimCurve::\", \"\" {{\nDefault: {}\nKeyVer: 4008\n"
                               "KeyTime: *2 {{\na: {},{}\n}}\nKeyValueFloat: *2 {{\na: {},{}\n}}\n}}\n",
                               stack, time(start_s), time(stop_s), layer, node, axis, from, curve, from,
                               time(start_s), time(stop_s), from, to);
        link(layer, stack);
        link(node, layer);
        link(node, model, property);
        link(curve, node, "d|" + axis);
    }
};

/// A property that holds one number.
[[nodiscard]] inline std::string number(const std::string& name, double value)
{
    return fmt::format("P: \"{}\", \"double\", \"Number\", \"\",{}\n", name, value);
}

[[nodiscard]] inline std::string whole(const std::string& name, int value)
{
    return fmt::format("P: \"{}\", \"int\", \"Integer\", \"\",{}\n", name, value);
}

[[nodiscard]] inline std::string vector(const std::string& name, double x, double y, double z)
{
    return fmt::format("P: \"{}\", \"Vector3D\", \"Vector\", \"\",{},{},{}\n", name, x, y, z);
}

/// FBX settings for the up, front and right axes of the file. 1 to 3 mean +x to +z; negative numbers mean the
/// opposite direction.
[[nodiscard]] inline std::string axes(int up, int front, int right)
{
    const auto axis = [](const char* name, int value) {
        return whole(name, (value < 0 ? -value : value) - 1) +
               whole(std::string(name) + "Sign", value < 0 ? -1 : 1);
    };
    return axis("UpAxis", up) + axis("FrontAxis", front) + axis("CoordAxis", right);
}

} // namespace estampe::fbx::test
