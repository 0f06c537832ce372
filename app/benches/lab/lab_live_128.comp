// SPDX-License-Identifier: MIT
// 128 numbers are kept.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

// clang-format off
#define ALL(M)                                                                                               \
    M(sa)                                                                                                    \
    M(sb)                                                                                                    \
    M(sc) M(sd) M(se) M(sf) M(sg) M(sh) M(ta) M(tb) M(tc) M(td) M(te) M(tf) M(tg) M(th) M(ua) M(ub) M(uc)    \
        M(ud) M(ue) M(uf) M(ug) M(uh) M(va) M(vb) M(vc) M(vd) M(ve) M(vf) M(vg) M(vh)
// clang-format on

#include "lab_live.glsl"
