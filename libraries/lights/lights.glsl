// SPDX-License-Identifier: Apache-2.0
// Light sources; the falloff pow(distance + 1, -decay) stays finite at the light. NAME_sample is the light of one of its points, for path tracers.

#include "../pbrlib/shaders/sampling.glsl"

// A light from one direction.
void mx_directional_light(vec3 direction, vec3 color, float intensity, vec3 P, out vec3 to_light, out vec3 radiance)
{
    to_light = -direction;
    radiance = color * intensity;
}

// Intensity of a light at the vector d from it: pow(distance + 1, -decay_rate), which stays finite at the light.
float mx_falloff(vec3 d, float intensity, float decay_rate)
{
    return intensity / pow(length(d) + 1.0, decay_rate);
}

// A light at a position that shines alike in all directions.
void mx_point_light(vec3 position, vec3 color, float intensity, float decay_rate, vec3 P, out vec3 to_light,
                    out vec3 radiance)
{
    vec3 d = position - P;
    to_light = normalize(d);
    radiance = color * mx_falloff(d, intensity, decay_rate);
}

// Share of a cone of light that arrives from to_light; inner_angle and outer_angle are cosines.
//
// The edge is never quite sharp, where smoothstep would be undefined.
float mx_cone(vec3 to_light, vec3 direction, float inner_angle, float outer_angle)
{
    float edge = min(inner_angle, outer_angle) - 1e-5;
    return smoothstep(edge, inner_angle, -dot(to_light, direction));
}

// A light at a position that shines into a cone; inner_angle and outer_angle are cosines.
void mx_spot_light(vec3 position, vec3 direction, vec3 color, float intensity, float decay_rate, float inner_angle,
                   float outer_angle, vec3 P, out vec3 to_light, out vec3 radiance)
{
    vec3 d = position - P;
    to_light = normalize(d);
    float cone = mx_cone(to_light, direction, inner_angle, outer_angle);
    radiance = color * (mx_falloff(d, intensity, decay_rate) * cone);
}

// A sphere of radiance 1: the irradiance of a surface that faces it is pi r^2 / d^2; within the sphere that of its
// surface.
void mx_sphere_light(vec3 position, vec3 direction, vec3 color, float intensity, float radius, float inner_angle,
                     float outer_angle, vec3 P, out vec3 to_light, out vec3 radiance)
{
    vec3 d = position - P;
    to_light = normalize(d);
    float part = radius * radius / max(dot(d, d), max(radius * radius, 1e-30));
    radiance = color * (3.14159265 * part * intensity * mx_cone(to_light, direction, inner_angle, outer_angle));
}

// One direction to a sphere of radiance 1, from two random numbers xi. Directions are even in the cone around the sphere, so each brings its solid
// angle 2 pi (1 - cos t), sin t = r / d (Shirley, Wang, Zimmerman 1996, "Monte Carlo Techniques for Direct Lighting Calculations"). Within the sphere
// they are even all around.
void mx_sphere_light_sample(vec3 position, vec3 direction, vec3 color, float intensity, float radius, float inner_angle, float outer_angle, vec3 P,
                            vec2 xi, out vec3 to_light, out vec3 radiance, out float distance)
{
    vec3 d = position - P;
    float away = length(d), sine = radius / max(away, 1e-30);
    float gap = sine < 1.0 ? sine * sine / (1.0 + sqrt(1.0 - sine * sine)) : 2.0; // 1 - cos t, without its loss of digits
    float down = xi.x * gap, aside = sqrt(max(down * (2.0 - down), 0.0));
    to_light = mx_any_frame(d / max(away, 1e-30)) * vec3(mx_polar(aside, xi.y), 1.0 - down);
    float half_chord = sqrt(max(radius * radius - away * away * aside * aside, 0.0));
    distance = away * (1.0 - down) + (sine < 1.0 ? -half_chord : half_chord);
    radiance = color * (6.2831853 * gap * intensity * mx_cone(to_light, direction, inner_angle, outer_angle));
}

// A disk of radiance 1: the irradiance of a surface that faces it is pi r^2 / (r^2 + d^2).
//
// This is exact on its axis; beside it the disk seems smaller.
void mx_disk_light(vec3 position, vec3 direction, vec3 color, float intensity, float radius, float inner_angle,
                   float outer_angle, vec3 P, out vec3 to_light, out vec3 radiance)
{
    vec3 d = position - P;
    to_light = normalize(d);
    float part = radius * radius / max(dot(d, d) + radius * radius, 1e-30) * max(-dot(to_light, direction), 0.0);
    radiance = color * (3.14159265 * part * intensity * mx_cone(to_light, direction, inner_angle, outer_angle));
}

// The light of one point of a disk of radiance 1, from two random numbers xi; points are even on the disk.
void mx_disk_light_sample(vec3 position, vec3 direction, vec3 color, float intensity, float radius, float inner_angle, float outer_angle, vec3 P,
                          vec2 xi, out vec3 to_light, out vec3 radiance, out float distance)
{
    vec3 d = position + mx_any_frame(direction) * vec3(mx_polar(radius * sqrt(xi.x), xi.y), 0.0) - P;
    distance = length(d);
    to_light = d / max(distance, 1e-30);
    float part = radius * radius / max(dot(d, d), 1e-30) * max(-dot(to_light, direction), 0.0);
    radiance = color * (3.14159265 * part * intensity * mx_cone(to_light, direction, inner_angle, outer_angle));
}
