// SPDX-License-Identifier: Apache-2.0
// Light sources; the falloff pow(distance + 1, -decay) stays finite at the light.

void mx_directional_light(vec3 direction, vec3 color, float intensity, vec3 P, out vec3 to_light, out vec3 radiance)
{
    to_light = -direction;
    radiance = color * intensity;
}

float mx_falloff(vec3 d, float intensity, float decay_rate)
{
    return intensity / pow(length(d) + 1.0, decay_rate);
}

void mx_point_light(vec3 position, vec3 color, float intensity, float decay_rate, vec3 P, out vec3 to_light,
                    out vec3 radiance)
{
    vec3 d = position - P;
    to_light = normalize(d);
    radiance = color * mx_falloff(d, intensity, decay_rate);
}

// inner_angle and outer_angle are cosines; the edge is never quite sharp, where smoothstep would be undefined.
float mx_cone(vec3 to_light, vec3 direction, float inner_angle, float outer_angle)
{
    return smoothstep(min(inner_angle, outer_angle) - 1e-5, inner_angle, -dot(to_light, direction));
}

void mx_spot_light(vec3 position, vec3 direction, vec3 color, float intensity, float decay_rate, float inner_angle,
                   float outer_angle, vec3 P, out vec3 to_light, out vec3 radiance)
{
    vec3 d = position - P;
    to_light = normalize(d);
    float cone = mx_cone(to_light, direction, inner_angle, outer_angle);
    radiance = color * (mx_falloff(d, intensity, decay_rate) * cone);
}

// The irradiance of a surface that faces a sphere of radiance 1, pi r^2 / d^2; within the sphere that of its surface.
void mx_sphere_light(vec3 position, vec3 direction, vec3 color, float intensity, float radius, float inner_angle,
                     float outer_angle, vec3 P, out vec3 to_light, out vec3 radiance)
{
    vec3 d = position - P;
    to_light = normalize(d);
    float part = radius * radius / max(dot(d, d), max(radius * radius, 1e-30));
    radiance = color * (3.14159265 * part * intensity * mx_cone(to_light, direction, inner_angle, outer_angle));
}

// The same for a disk of radiance 1, pi r^2 / (r^2 + d^2), which is exact on its axis; beside it the disk seems smaller.
void mx_disk_light(vec3 position, vec3 direction, vec3 color, float intensity, float radius, float inner_angle,
                   float outer_angle, vec3 P, out vec3 to_light, out vec3 radiance)
{
    vec3 d = position - P;
    to_light = normalize(d);
    float part = radius * radius / max(dot(d, d) + radius * radius, 1e-30) * max(-dot(to_light, direction), 0.0);
    radiance = color * (3.14159265 * part * intensity * mx_cone(to_light, direction, inner_angle, outer_angle));
}
