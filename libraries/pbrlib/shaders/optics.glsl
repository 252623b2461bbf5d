// SPDX-License-Identifier: Apache-2.0
// Conversions between what artists paint and what closures take.

#include "frame.glsl"

// Index and extinction of a conductor with this reflectivity facing the viewer, and this colour at the edge
// (Gulbrandsen 2014, "Artist Friendly Metallic Fresnel").
//
// His r (n + 1)^2 - (n - 1)^2 is 0 at the greatest n and at 1 over it, hence factors.
void mx_artistic_ior(vec3 reflectivity, vec3 edge_color, out vec3 ior, out vec3 extinction)
{
    vec3 s = sqrt(clamp(reflectivity, 0.0, 0.99));
    vec3 greatest = (1.0 + s) / (1.0 - s);
    ior = mix(greatest, (1.0 - s * s) / (1.0 + s * s), edge_color);
    extinction = sqrt(max((greatest - ior) * (ior - 1.0 / greatest), 0.0));
}

// Squared roughness along X and across: the aspect ratio stretches one axis and shrinks the other (Burley 2012,
// section 5.4).
vec2 mx_roughness_anisotropy(float roughness, float anisotropy)
{
    float squared = clamp(roughness * roughness, MX_EPSILON, 1.0);
    float aspect = sqrt(1.0 - clamp(anisotropy, 0.0, 0.98));
    return vec2(min(squared / aspect, 1.0), squared * aspect);
}

// Squared roughness along X and across. A negative second value means that both are alike.
vec2 mx_roughness_dual(vec2 roughness)
{
    vec2 r = vec2(roughness.x, roughness.y < 0.0 ? roughness.x : roughness.y);
    return clamp(r * r, MX_EPSILON, 1.0);
}

// Linear Rec. 709 of a black body at a temperature in kelvins (Kang et al. 2002, "Design of Advanced Color
// Temperature Control System for HDTV Applications"), which holds from 1667 K. Below it a fit to Planck's law through
// the CIE 1931 observer, whose colours differ by 0.03 at most.
vec3 mx_blackbody(float temperature)
{
    const mat3 XYZ_TO_RGB = mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570);
    float kelvin = clamp(temperature, 800.0, 25000.0);
    float t = 1000.0 / kelvin;
    vec4 powers = vec4(t * t * t, t * t, t, 1.0);
    float x = dot(powers, kelvin < 1667.0   ? vec4(0.1925412, -0.7066381, 0.9731853, 0.1935682)
                          : kelvin < 4000.0 ? vec4(-0.2661239, -0.2343580, 0.8776956, 0.179910)
                                            : vec4(-3.0258469, 2.1070379, 0.2226347, 0.240390));
    vec4 cubic = vec4(3.0817580, -5.87338670, 3.75112997, -0.37001483);
    if (kelvin < 1667.0)
        cubic = vec4(6.2622599, -14.2638258, 9.7298432, -1.6707199);
    else if (kelvin < 2222.0)
        cubic = vec4(-1.1063814, -1.34811020, 2.18555832, -0.20219683);
    else if (kelvin < 4000.0)
        cubic = vec4(-0.9549476, -1.37418593, 2.09137015, -0.16748867);
    float y = dot(vec4(x * x * x, x * x, x, 1.0), cubic);
    return max(XYZ_TO_RGB * vec3(x, y, 1.0 - x - y) / y, 0.0);
}
