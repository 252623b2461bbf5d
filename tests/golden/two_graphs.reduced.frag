#version 450
// Soil · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform float u_envLightIntensity = 1.0;
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
    vec3 position;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
uniform LightData u_lightData[3];
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec2 texcoord_0;
} vd;
out vec4 out1;

// The dot product of p with one of the eight vectors (+-1, +-2), (+-2, +-1).
float mx_gradient(const uint hash, const vec2 p)
{
    bool swap = (hash & 4u) != 0u;
    float u = swap ? p.y : p.x;
    float v = swap ? p.x : p.y;
    return ((hash & 1u) != 0u ? -u : u) + 2.0 * ((hash & 2u) != 0u ? -v : v);
}

// Final scramble of a hash (Bob Jenkins, "lookup3.c", 2006).
// Here z = 3735928580u.
uint mx_hash_final(const uint x, const uint y)
{
    uint a = x;
    uint b = y;
    uint c = 3735928580u;
    c ^= b;
    c -= (b << 14) | (b >> 18);
    a ^= c;
    a -= (c << 11) | (c >> 21);
    b ^= a;
    b -= (a << 25) | (a >> 7);
    c ^= b;
    c -= (b << 16) | (b >> 16);
    a ^= c;
    a -= (c << 4) | (c >> 28);
    b ^= a;
    b -= (a << 14) | (a >> 18);
    c ^= b;
    c -= (b << 24) | (b >> 8);
    return c;
}

// The curve 6t^5 - 15t^4 + 10t^3 between lattice points (Perlin 2002, "Improving Noise").
vec2 mx_fade(const vec2 t)
{
    return t * t * t * (t * (t * 6.0 - vec2(15.0)) + vec2(10.0));
}

// Perlin noise at the point p, from -1 to 1.
float mx_noise_float(const vec2 p)
{
    vec2 cell = floor(p);
    vec2 f = p - cell;
    vec2 w = mx_fade(f);
    int x = int(cell.x);
    int y = int(cell.y);
    return 0.6616 * mix(mix(mx_gradient(mx_hash_final(3735928580u + uint(x), 3735928580u + uint(y)), f),
        mx_gradient(mx_hash_final(3735928580u + uint(x + 1), 3735928580u + uint(y)), f - vec2(1.0, 0.0)), w.x),
        mix(mx_gradient(mx_hash_final(3735928580u + uint(x), 3735928580u + uint(y + 1)), f - vec2(0.0, 1.0)),
        mx_gradient(mx_hash_final(3735928580u + uint(x + 1), 3735928580u + uint(y + 1)), f - vec2(1.0)), w.x), w.y);
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(const float sine, const float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(const vec3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float square = mx_map_square(d);
    float stretch = inversesqrt(square);
    return vec2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 N = normalize(vd.normalWorld);
    // wet
    vec3 facing = faceforward(N, -normalize(u_viewPosition - vd.positionWorld), N);
    float wet_body_weight = clamp(mx_noise_float(vd.texcoord_0), 0.0, 1.0);
    vec3 wet_body_factor = wet_body_weight * 0.31830987 * vec3(0.3, 0.2, 0.1);
    // dry
    vec3 dry_body_factor = (1.0 - wet_body_weight) * 0.31830987 * vec3(0.6, 0.5, 0.3);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
            vec3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
            }
        }
        // wet_body, dry_body
        float cos_l = max(dot(L, facing), 1e-8);
        color += u_lightData[i].color * (intensity * (cos_l * wet_body_factor + cos_l * dry_body_factor));
    }
    // environment: wet_body, dry_body
    vec3 part = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * facing)), 0.0).xyz;
    vec3 dry_body_response = part * vec3(0.6, 0.5, 0.3) * ((1.0 - wet_body_weight) * u_envLightIntensity);
    color += part * vec3(0.3, 0.2, 0.1) * (wet_body_weight * u_envLightIntensity) + dry_body_response;
    out1 = vec4(color, 1.0);
}
