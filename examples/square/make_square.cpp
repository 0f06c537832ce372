// SPDX-License-Identifier: MIT
// Writes Estampe's own scene, a square after de Chirico, as binary glTF.
#include <cstdio>
#include <exception>

#include "square.hpp"

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::fputs("usage: make_square FILE.glb\n", stderr);
        return 2;
    }
    try {
        square::write_glb(square::build_square(), argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
