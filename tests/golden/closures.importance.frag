#version 450
// Varnish · surfacematerial · mxgen 0.1 · vulkan · complete · 2 closures · 0 textures

struct mx_GgxLobe {
    vec3 N;
    float cosine;
    vec3 x;
    vec2 alpha;
    float masking;
};
struct mx_GgxSamples {
    mat3 to_map;
    vec3 stretch;
    float area;
    vec3 v;
    float masking;
    float reach;
    float step;
    float texels;
    float weight;
};
struct mx_GgxFacet {
    vec3 h;
    float cosine;
    float mirror;
    float texels;
};
struct mx_GgxLight {
    vec3 color;
    float weight;
    float cosine;
};
layout(set = 0, binding = 1, std140) uniform PublicUniforms {
    float SR_varnish_opacity;
};
layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    mat4 u_worldMatrix;
    mat4 u_worldInverseTransposeMatrix;
    mat4 u_viewProjectionMatrix;
    vec3 u_viewPosition;
    int u_numActiveLightSources;
    mat4 u_envMatrix;
    int u_envRadianceMips;
    int u_envRadianceSamples;
    float u_envLightIntensity;
    float u_alphaThreshold;
};
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
layout(set = 0, binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };
layout(set = 0, binding = 3) uniform sampler2D u_envRadiance;
layout(set = 0, binding = 4) uniform sampler2D u_envIrradiance;
layout(location = 0) in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
layout(location = 0) out vec4 out1;

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
// Here a = 0.04.
vec2 mx_ggx_albedo_fit(const float c)
{
    float x = clamp(1.0 - c - 0.04 * mx_bicubic(mat4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), 0.04 / (0.04 + c), 0.04), 0.0, 1.0);
    float u = 0.04 / (0.04 + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
        4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, 0.04 * c), 1.0),
        x * x * x * x * x);
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

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
// Here roughness = vec2(0.04).
int mx_sample_count()
{
    return max(int(ceil(0.4 * float(u_envRadianceSamples))), 1);
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here roughness = vec2(0.04), is_round = true.
mx_GgxLobe mx_ggx_lobe(const vec3 N, const vec3 V)
{
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), vec2(0.04), sqrt(0.0016 + 0.9984 * (cosine * cosine)));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here roughness = vec2(0.04), is_round = true.
mx_GgxSamples mx_ggx_samples(const int count, const vec3 N, const vec3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(N, V);
    vec3 x = normalize(V - lobe.cosine * lobe.N + 1e-6 * lobe.N.yzx);
    vec3 v = vec3(sqrt(max(1.0 - lobe.cosine * lobe.cosine, 0.0)), 0.0, lobe.cosine);
    vec3 stretch = vec3(lobe.alpha, 1.0);
    float reach = lobe.masking;
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    return mx_GgxSamples(mat3(u_envMatrix) * mat3(x, cross(lobe.N, x), lobe.N), stretch, area, v, lobe.masking, reach,
        share * (v.z + reach), area * (v.z + lobe.masking)
        * max(2.0 / float(count), 4.4 / float(max(u_envRadianceSamples, 1)))
        * exp2(2.0 * float(u_envRadianceMips) - 4.6485), u_envLightIntensity * (share * (v.z + lobe.masking)));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
vec3 mx_filtered_light(const vec3 d, const float texels)
{
    return textureLod(u_envRadiance, mx_map_point(d), 0.5 * log2(texels * inversesqrt(mx_map_square(d)))).xyz;
}

// Height-correlated masking and shadowing G2 over 2 cos_v cos_l (Heitz 2014, equation 99); `masking` is that of the
// viewer.
float mx_ggx_visibility(const float cos_v, const float masking, const float area, const float cos_l)
{
    return 1.0 / (cos_v * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * masking);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 v, const float reach)
{
    return v + vec3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// The facet of sample i. Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further
// around than the one before, by its `turn`.
mx_GgxFacet mx_ggx_facet(const mx_GgxSamples s, const int i, const vec2 turn)
{
    vec3 h = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.v * s.stretch, s.reach) * s.stretch;
    float cosine = dot(s.v, h);
    float mirror = 2.0 * cosine / dot(h, h);
    return mx_GgxFacet(h, cosine, mirror, mirror * mirror * s.texels);
}

// The light that the facet of sample i reflects.
mx_GgxLight mx_ggx_reflected(const mx_GgxSamples s, const int i, const vec2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    vec3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return mx_GgxLight(mx_filtered_light(s.to_map * l, facet.texels),
        s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0)));
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float cos_v = max(abs(dot(N, V)), 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(cos_v);
    float scale = (1.0 / albedo.x - 1.0) * 0.079748526 + 1.0;
    vec3 facing = faceforward(N, -V, N);
    float ggx_masking = sqrt(cos_v * cos_v * 0.9984 + 0.0016);
    mx_GgxLobe coat_ggx_lobe = mx_GgxLobe(facing, cos_v, vec3(0.0), vec2(0.04), ggx_masking);
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
        float cos_l = max(dot(L, facing), 1e-8);
        vec3 paint_response = paint_factor
            * (cos_l * (max(v_dot_l - cos_v * cos_l, 0.0) * 0.225 / max(cos_l, cos_v) + 0.89285713));
        color += u_lightData[i].color * (intensity
            * (coat_product * mx_ggx_light(coat_ggx_lobe, V, L) + paint_response));
    }
    // environment: paint
    vec3 paint_product = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * facing)), 0.0).xyz
        * vec3(0.6, 0.1, 0.05);
    vec2 fit = (cos_v * vec2(-0.7632, -0.4993) - vec2(0.4297, 0.6076) + vec2(0.43155, 0.60945)) * 0.3 + vec2(1.0);
    color += paint_product * (u_envLightIntensity * (paint_weight * clamp(fit.x / fit.y, 0.0, 1.0)));
    // environment: coat
    vec2 turn = vec2(1.0, 0.0);
    int count = mx_sample_count();
    mx_GgxSamples coat_ggx_samples = mx_ggx_samples(count, N, V);
    for (int i = 0; i < count; ++i) {
        mx_GgxLight light = mx_ggx_reflected(coat_ggx_samples, i, turn);
        color += light.color * (light.weight * (scale * mx_fresnel_permittivity(light.cosine)));
        turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
    }
    // opacity
    float opacity = clamp(SR_varnish_opacity, 0.0, 1.0);
    if (opacity < u_alphaThreshold)
        discard;
    out1 = vec4(opacity * color, opacity);
}
