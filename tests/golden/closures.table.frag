#version 450
// Varnish · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

struct mx_GgxLobe {
    vec3 N;
    float cosine;
    vec3 x;
    vec2 alpha;
    float masking;
};
uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform int u_envRadianceMips = 1;
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
uniform sampler2D u_envIrradiance;
uniform sampler2D u_albedoTable;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
out vec4 out1;

// The light that a white GGX lobe reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5 over it (y).
// Here roughness = vec2(0.04).
vec2 mx_ggx_albedo(const float c)
{
    vec2 scales = textureLod(u_albedoTable, vec2(c, 0.04), 0.0).xy;
    float sum = clamp(scales.x + scales.y, 1e-8, 1.0);
    return vec2(sum, scales.y / sum);
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
// Here re = 2.1025.
float mx_fresnel_permittivity(const float cosine)
{
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 1.1025002);
    float r = 0.5512501 / (1.55125 * (c2 + sqrt(cg2)) + 0.5512501);
    return (cg2 + s * s) * (r * r);
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = true.
float mx_ggx_stretched(const mx_GgxLobe lobe, const float cos_h, const float square)
{
    return square - (1.0 - lobe.alpha.x * lobe.alpha.y) * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = true.
float mx_ggx_light(const mx_GgxLobe lobe, const vec3 V, const vec3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, lobe.cosine + dot(lobe.N, L), square);
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

// Light that the lobe reflects, from a map whose levels of detail are filtered for rising roughness; with refract_ior >
// 0 light through a solid sphere of that index.
// Here roughness = vec2(0.04), by_direction = false, refract_ior = 0.0, model = "dielectric", n = vec3(1.45),
// k = vec3(0.0), f90 = vec3(1.0), exponent = 0.0, film = 0.0, film_ior = 1.5.
vec3 mx_ggx_prefiltered(const vec3 N, const vec3 V)
{
    vec3 h = faceforward(N, -V, N);
    vec2 albedo = mx_ggx_albedo(max(abs(dot(N, V)), 1e-8));
    return mix(vec3(0.03373595), vec3(1.0), albedo.y) * albedo.x
        * (textureLod(u_envRadiance, mx_map_point(normalize(mat3(u_envMatrix)
        * mix(h, reflect(-V, h), vec3(0.979004)))), 0.2 * float(u_envRadianceMips - 1)).xyz * u_envLightIntensity);
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float cos_v = max(abs(dot(N, V)), 1e-8);
    vec2 albedo = mx_ggx_albedo(cos_v);
    float scale = (1.0 / albedo.x - 1.0) * 0.079748526 + 1.0;
    vec3 h = faceforward(N, -V, N);
    float ggx_masking = sqrt(cos_v * cos_v * 0.9984 + 0.0016);
    mx_GgxLobe coat_ggx_lobe = mx_GgxLobe(h, cos_v, vec3(0.0), vec2(0.04), ggx_masking);
    float paint_weight = (1.0 - mix(0.03373595, 1.0, albedo.y) * albedo.x * scale) * 0.75;
    vec3 paint_factor = paint_weight * 0.31830987 * vec3(0.6, 0.1, 0.05);
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
        // coat, paint
        float v_dot_l = dot(V, L);
        float coat_product = scale * mx_fresnel_permittivity(sqrt(clamp(v_dot_l * 0.5 + 0.500001, 0.0, 1.0)));
        float cos_l = max(dot(L, h), 1e-8);
        vec3 paint_response = paint_factor
            * (cos_l * (max(v_dot_l - cos_v * cos_l, 0.0) * 0.225 / max(cos_l, cos_v) + 0.89285713));
        color += u_lightData[i].color * (intensity
            * (coat_product * mx_ggx_light(coat_ggx_lobe, V, L) + paint_response));
    }
    // environment: coat, paint
    vec3 paint_product = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * h)), 0.0).xyz
        * vec3(0.6, 0.1, 0.05);
    vec2 fit = (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + vec2(0.43155, 0.60945)) * 0.3 + vec2(1.0);
    vec3 paint_response = paint_product * (u_envLightIntensity * (paint_weight * clamp(fit.x / fit.y, 0.0, 1.0)));
    color += scale * mx_ggx_prefiltered(N, V) + paint_response;
    out1 = vec4(color, 1.0);
}
