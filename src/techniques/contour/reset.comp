// SPDX-License-Identifier: MIT
// One thread empties the list of edges.
#version 460

layout(local_size_x = 1) in;

layout(std430, binding = 0) writeonly buffer Count
{
    uint edge_count;
};

void main()
{
    edge_count = 0u;
}
