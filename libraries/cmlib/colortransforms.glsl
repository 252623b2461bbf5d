// SPDX-License-Identifier: Apache-2.0
// Color spaces to linear Rec. 709. Columns of a matrix are the primaries of its space in Rec. 709.

const mat3 MX_AP1_TO_REC709 = mat3( // white adapted from D60 to D65 (Bradford)
     1.705050992658, -0.130256417507, -0.024003356805,
    -0.621792120657,  1.140804736575, -0.128968976065,
    -0.083258872001, -0.010548319068,  1.152972332870);

const mat3 MX_ADOBERGB_TO_REC709 = mat3(
     1.39835574,  0.0,         0.0,
    -0.39835574,  1.0,        -0.0429289893,
     0.0,         0.0,         1.0429289893);

const mat3 MX_DISPLAYP3_TO_REC709 = mat3(
     1.22493029, -0.04205868, -0.01964128,
    -0.22492968,  1.04205894, -0.07864794,
     0.00000006, -0.00000001,  1.09828925);

vec3 mx_decode_gamma(vec3 color, float gamma)
{
    return pow(max(color, vec3(0.0)), vec3(gamma));
}

// IEC 61966-2-1
vec3 mx_srgb_texture_to_lin_rec709(vec3 color)
{
    vec3 curve = pow(max((color + 0.055) / 1.055, 0.0), vec3(2.4));
    return mix(color / 12.92, curve, step(0.04045, color));
}

vec3 mx_g18_rec709_to_lin_rec709(vec3 color) { return mx_decode_gamma(color, 1.8); }
vec3 mx_g22_rec709_to_lin_rec709(vec3 color) { return mx_decode_gamma(color, 2.2); }
vec3 mx_rec709_display_to_lin_rec709(vec3 color) { return mx_decode_gamma(color, 2.4); }
vec3 mx_acescg_to_lin_rec709(vec3 color) { return MX_AP1_TO_REC709 * color; }
vec3 mx_g22_ap1_to_lin_rec709(vec3 color) { return MX_AP1_TO_REC709 * mx_decode_gamma(color, 2.2); }
vec3 mx_lin_adobergb_to_lin_rec709(vec3 color) { return MX_ADOBERGB_TO_REC709 * color; }
vec3 mx_adobergb_to_lin_rec709(vec3 color) { return MX_ADOBERGB_TO_REC709 * mx_decode_gamma(color, 563.0 / 256.0); }
vec3 mx_lin_displayp3_to_lin_rec709(vec3 color) { return MX_DISPLAYP3_TO_REC709 * color; }
vec3 mx_srgb_displayp3_to_lin_rec709(vec3 color) { return MX_DISPLAYP3_TO_REC709 * mx_srgb_texture_to_lin_rec709(color); }
