// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_ROUNDS
#define ESTAMPE_ROUNDS

// `count`, for loops that are to stay loops: what is in them is compiled once, as the compiler does not know
// that `not_negative` is that, and so not how often they run.
int rounds(int count, int not_negative)
{
    return count + min(not_negative, 0);
}

#endif
