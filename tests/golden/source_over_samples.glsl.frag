#version 450
// M · surfacematerial · mxgen 0.1 · glsl · reduced · 1 closure · 0 textures

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
uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform int u_envRadianceMips = 1;
uniform int u_envRadianceSamples = 16;
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

const float M_PI = 3.1415926535897932;
float mx_square(float a) { return a * a; }
vec2 mx_square(vec2 a) { return a * a; }
vec3 mx_square(vec3 a) { return a * a; }
struct BSDF { vec3 response; vec3 throughput; };
struct ClosureData { int closureType; vec3 L; vec3 V; vec3 N; vec3 P; float occlusion; };
// Included by several files, in the shader once.
#define HALF_PI (M_PI * 0.5)

float shape(float x)
{
    return mx_square(x) * HALF_PI;
}


vec3 facing(vec3 N, vec3 V)
{
    return dot(N, V) < 0.0 ? -N : N;
}


// Fog over a lobe: what it adds does not come from the lobe, so it must count once and not with each sample of the lobe.
void fogged_bsdf(ClosureData closureData, BSDF base, float fog, inout BSDF bsdf)
{
    bsdf.throughput = base.throughput;
    bsdf.response = base.response * (1.0 - fog) + vec3(fog * 0.1);
}

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
// Here roughness = vec2(0.05).
int mx_sample_count()
{
    return max(int(ceil(0.4472136 * float(u_envRadianceSamples))), 1);
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here roughness = vec2(0.05), is_round = true.
mx_GgxLobe mx_ggx_lobe(const vec3 N, const vec3 V)
{
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), vec2(0.05), sqrt(0.0025 + 0.9975 * (cosine * cosine)));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here roughness = vec2(0.05), is_round = true.
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

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
// Here a = 0.05.
vec2 mx_ggx_albedo_fit(const float c)
{
    float x = clamp(1.0 - c - 0.05 * mx_bicubic(mat4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), 0.05 / (0.05 + c), 0.05), 0.0, 1.0);
    float u = 0.05 / (0.05 + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
        4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, 0.05 * c), 1.0),
        x * x * x * x * x);
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
// Here re = 2.25.
float mx_fresnel_permittivity(const float cosine)
{
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 1.25);
    float r = 0.625 / (1.625 * (c2 + sqrt(cg2)) + 0.625);
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

void main()
{
    vec3 gathered = vec3(0.0);
    vec2 turn = vec2(1.0, 0.0);
    int count = mx_sample_count();
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    mx_GgxSamples gloss_ggx_samples = mx_ggx_samples(count, N, V);
    float cosine = max(abs(dot(N, V)), 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(cosine);
    float scale = (1.0 / albedo.x - 1.0) * 0.08571429 + 1.0;
    for (int i = 0; i < count; ++i) {
        mx_GgxLight light = mx_ggx_reflected(gloss_ggx_samples, i, turn);
        gathered += light.color * (light.weight * (scale * mx_fresnel_permittivity(light.cosine)));
        turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
    }
    vec3 color = vec3(0.0);
    // lights
    float ggx_masking = sqrt(cosine * cosine * 0.9975 + 0.0025);
    mx_GgxLobe gloss_ggx_lobe = mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), vec2(0.05), ggx_masking);
    vec3 dielectric_bsdf_throughput = vec3(1.0 - scale * (albedo.x * mix(0.04, 1.0, albedo.y)));
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
        // fogged
        ClosureData closure_data = ClosureData(1, L, V, N, vd.positionWorld, 1.0);
        float gloss_product = scale * mx_fresnel_permittivity(sqrt(clamp(dot(L, V) * 0.5 + 0.500001, 0.0, 1.0)));
        BSDF b_s_d_f = BSDF(vec3(gloss_product * mx_ggx_light(gloss_ggx_lobe, V, L)), dielectric_bsdf_throughput);
        BSDF fogged = BSDF(vec3(0.0), vec3(1.0));
        fogged_bsdf(closure_data, b_s_d_f, 0.25, fogged);
        color += u_lightData[i].color * (intensity * fogged.response);
    }
    // environment: fogged
    ClosureData closure_data = ClosureData(3, vec3(0.0), V, N, vd.positionWorld, 1.0);
    BSDF fogged = BSDF(vec3(0.0), vec3(1.0));
    fogged_bsdf(closure_data, BSDF(gathered, dielectric_bsdf_throughput), 0.25, fogged);
    color += fogged.response;
    out1 = vec4(color, 1.0);
}
