// SPDX-License-Identifier: MIT
// Writes Estampe's own scene, a square after de Chirico, or one object of this scene, as binary glTF.
#include <cstdio>
#include <exception>

#include "square.hpp"

int main(int argc, char** argv)
{
    if ((argc != 2 && argc != 3) || argv[1][0] == '-') {
        std::fputs("usage: make_square FILE.glb [statue|engine|tower]\n", stderr);
        return 2;
    }
    try {
        square::write_glb(argc == 2 ? square::build_square() : square::build_thing(argv[2]), argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
