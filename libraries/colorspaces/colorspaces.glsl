// SPDX-License-Identifier: Apache-2.0
// Color spaces to linear Rec. 709 and from there to those that shaders may compute in, from the primaries and white points
// of their definitions. Columns of a matrix are the primaries of its space in Rec. 709.

#include "../cmlib/colortransforms.glsl"

const mat3 MX_AP0_TO_REC709 = mat3( // SMPTE ST 2065-1; white adapted from D60 to D65 (Bradford)
     2.521686186744, -0.276479914230, -0.015378064966,
    -1.134130988240,  1.372719087668, -0.152975335867,
    -0.387555198504, -0.096239173438,  1.168353400833);

const mat3 MX_REC2020_TO_REC709 = mat3( // ITU-R BT.2020
     1.660491002108, -0.124550474522, -0.018150763355,
    -0.587641138789,  1.132899897126, -0.100578898008,
    -0.072849863320, -0.008349422604,  1.118729661363);

const mat3 MX_XYZ_TO_REC709 = mat3( // CIE 1931, scaled so that D65 is white
     3.240969941905, -0.969243636281,  0.055630079697,
    -1.537383177570,  1.875967501508, -0.203976958889,
    -0.498610760293,  0.041555057407,  1.056971514243);

vec3 mx_g18_ap1_to_lin_rec709(vec3 color) { return MX_AP1_TO_REC709 * mx_decode_gamma(color, 1.8); }
vec3 mx_srgb_ap1_to_lin_rec709(vec3 color) { return MX_AP1_TO_REC709 * mx_srgb_texture_to_lin_rec709(color); }
vec3 mx_lin_ap0_to_lin_rec709(vec3 color) { return MX_AP0_TO_REC709 * color; }
vec3 mx_lin_rec2020_to_lin_rec709(vec3 color) { return MX_REC2020_TO_REC709 * color; }
vec3 mx_lin_ciexyzd65_to_lin_rec709(vec3 color) { return MX_XYZ_TO_REC709 * color; }
