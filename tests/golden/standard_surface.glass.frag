#version 450
// Glass · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

struct mx_GgxLobe {
    vec3 N;
    float cosine;
    vec3 x;
    vec2 alpha;
    float masking;
};
struct mx_GgxLight {
    vec3 color;
    float weight;
    float cosine;
};
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
uniform sampler2D u_envRadiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
out vec4 out1;

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
// Here a = 0.0001.
vec2 mx_ggx_albedo_fit(const float c)
{
    float x = clamp(1.0 - c - 0.0001 * mx_bicubic(mat4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225,
        -0.0277, 36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), 0.0001 / (0.0001 + c),
        0.0001), 0.0, 1.0);
    float u = 0.0001 / (0.0001 + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
        4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, 0.0001 * c), 1.0),
        x * x * x * x * x);
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
// Here re = 2.3104.
float mx_fresnel_permittivity(const float cosine)
{
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 1.3104);
    float r = 0.6552 / (1.6552 * (c2 + sqrt(cg2)) + 0.6552);
    return (cg2 + s * s) * (r * r);
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = false.
float mx_ggx_stretched(const mx_GgxLobe lobe, const vec3 H, const float cos_h)
{
    vec3 slope = H - cos_h * lobe.N;
    return dot(slope, slope) + lobe.alpha.x * lobe.alpha.y * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = false.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
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

// The light that a smooth surface mirrors.
mx_GgxLight mx_mirrored(const vec3 N, const vec3 V)
{
    return mx_GgxLight(textureLod(u_envRadiance,
        mx_map_point(normalize(mat3(u_envMatrix) * reflect(-V, faceforward(N, -V, N)))), 0.0).xyz * u_envLightIntensity,
        1.0, max(abs(dot(N, V)), 1e-8));
}

// The light that comes through a smooth solid sphere of index `ior`.
// Here ior = 1.52.
mx_GgxLight mx_transmitted(const vec3 N, const vec3 V)
{
    return mx_GgxLight(textureLod(u_envRadiance,
        mx_map_point(normalize(mat3(u_envMatrix) * reflect(V, refract(-V, faceforward(N, -V, N), 0.65789473)))),
        0.0).xyz * u_envLightIntensity, 1.0, max(abs(dot(N, V)), 1e-8));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 axis = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // SR_glass
    float cosine = max(abs(dot(axis, V)), 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(cosine);
    float scale = (1.0 / albedo.x - 1.0) * 0.08817142 + 1.0;
    vec3 facing = faceforward(axis, -V, axis);
    mx_GgxLobe reflection_ggx_lobe = mx_GgxLobe(facing, cosine, vec3(0.0), vec2(0.0001), sqrt(cosine * cosine + 1e-8));
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
        // reflection
        float reflection_product = scale * mx_fresnel_permittivity(sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0)));
        color += u_lightData[i].color * (intensity * (reflection_product * mx_ggx_light(reflection_ggx_lobe, V, L)));
    }
    // environment: reflection, refraction
    mx_GgxLight reflection_light = mx_mirrored(axis, V);
    vec3 reflection_response = reflection_light.color
        * (reflection_light.weight * (scale * mx_fresnel_permittivity(reflection_light.cosine)));
    mx_GgxLight refraction_light = mx_transmitted(axis, V);
    float refraction_product = (1.0 - mix(0.04257999, 1.0, albedo.y) * albedo.x * scale) * refraction_light.weight;
    color += reflection_response + refraction_light.color
        * ((1.0 - mx_fresnel_permittivity(refraction_light.cosine)) * refraction_product);
    out1 = vec4(color, 1.0);
}
