// SPDX-License-Identifier: Apache-2.0
// View-dependent nodes.

in vec3 positionWorld;
in vec3 normalWorld;

uniform vec3 u_viewPosition;

float mx_facingratio(vec3 viewdirection, vec3 normal, bool faceforward, bool invert)
{
    float d = dot(viewdirection, normal);
    float facing = faceforward ? abs(d) : -d;
    return invert ? 1.0 - facing : facing;
}

// Amy Gooch et al., "A Non-Photorealistic Lighting Model for Automatic Technical Illustration", SIGGRAPH 1998.
vec3 mx_gooch_shade(vec3 warm_color, vec3 cool_color, float specular_intensity, float shininess, vec3 light_direction)
{
    vec3 normal = normalize(normalWorld);
    vec3 light = normalize(light_direction);
    vec3 mirrored = reflect(normalize(positionWorld - u_viewPosition), normal);
    float highlight = pow(max(dot(-light, mirrored), 0.0), shininess);
    return mix(warm_color, cool_color, 0.5 + 0.5 * dot(normal, light)) + specular_intensity * highlight;
}
