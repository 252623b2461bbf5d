#version 450
// UsdPreviewSurface · surfacematerial · mxgen 0.1 · glsl · reduced · 2 closures · 0 textures

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
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
} vd;
out vec4 out1;

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
// Here a = 0.25.
vec2 mx_ggx_albedo_fit(const float c)
{
    float x = clamp(1.0 - c - 0.25 * mx_bicubic(mat4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), 0.25 / (0.25 + c), 0.25), 0.0, 1.0);
    float u = 0.25 / (0.25 + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
        4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, 0.25 * c), 1.0),
        x * x * x * x * x);
}

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here f0 = vec3(0.04), bend = vec3(0.0), f90 = vec3(1.0), exponent = 5.0.
vec3 mx_fresnel_schlick(const float cosine)
{
    float x = 1.0 - cosine;
    return mix(vec3(0.04), vec3(1.0), x * x * x * x * x);
}

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
mat3 mx_frame(const vec3 N, const vec3 X)
{
    mat3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

// GGX distribution of normals, at a normal that the roughness stretched to e; `area` is the product of the roughness
// along x and y (Burley 2012, appendix B.2, equation 13).
// Here area = 0.0625.
float mx_ggx_distribution(const vec3 e)
{
    return 1.0 / (0.19634955 * dot(e, e) * dot(e, e));
}

// Masking and shadowing of the directions v and l over 4 cos_v, each with the roughness in its direction (Heitz 2014,
// equations 80 and 99).
// Here alpha = vec2(0.25).
float mx_ggx_smith_visibility(const vec3 v, const vec3 l)
{
    return 0.5 * l.z / (v.z * length(vec3(l.xy * 0.25, l.z)) + l.z * length(vec3(v.xy * 0.25, v.z)));
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
// Here roughness = vec2(0.25).
float mx_ggx_smith_lobe(const mat3 frame, const vec3 V, const vec3 L)
{
    return mx_ggx_distribution(normalize(V + L) * frame / vec3(0.25, 0.25, 1.0))
        * mx_ggx_smith_visibility(max(V * frame, vec3(-1.0, -1.0, 1e-8)), max(L * frame, vec3(-1.0, -1.0, 1e-8)));
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
// Here roughness = vec2(0.25).
int mx_sample_count()
{
    return max(int(ceil(0.5 * float(u_envRadianceSamples))), 1);
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here roughness = vec2(0.25), is_round = true.
mx_GgxLobe mx_ggx_lobe(const vec3 N, const vec3 V)
{
    float cosine = max(abs(dot(N, V)), 1e-8);
    return mx_GgxLobe(faceforward(N, -V, N), cosine, vec3(0.0), vec2(0.25), sqrt(0.0625 + 0.9375 * (cosine * cosine)));
}

// The GGX lobe of a surface as samples of the environment see it.
// Here roughness = vec2(0.25), is_round = true.
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
    vec3 shading_normal = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    // SR_UsdPreviewSurface
    vec2 albedo = mx_ggx_albedo_fit(max(abs(dot(shading_normal, V)), 1e-8));
    float scale = (1.0 / albedo.x - 1.0) * 0.08571429 + 1.0;
    vec3 facing = faceforward(shading_normal, -V, shading_normal);
    mat3 reflection_frame = mx_frame(facing, normalize(vd.tangentWorld));
    float reflection_throughput = 1.0 - dot(mx_fresnel_schlick(max(1.0 - pow(albedo.y, 0.2), 1e-8))
        * (albedo.x * scale), vec3(0.33333334));
    float diffuse_factor = reflection_throughput * 0.31830987 * 0.18;
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
        // reflection, diffuse
        vec3 reflection_product = scale * mx_fresnel_schlick(sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0)));
        vec3 reflection_response = reflection_product * mx_ggx_smith_lobe(reflection_frame, V, L);
        color += u_lightData[i].color * (intensity
            * (reflection_response + max(dot(L, facing), 1e-8) * diffuse_factor));
    }
    // environment: diffuse
    vec3 diffuse_part = textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * facing)), 0.0).xyz;
    color += diffuse_part * (u_envLightIntensity * (reflection_throughput * 0.18));
    // environment: reflection
    vec2 turn = vec2(1.0, 0.0);
    int count = mx_sample_count();
    mx_GgxSamples reflection_ggx_samples = mx_ggx_samples(count, shading_normal, V);
    for (int i = 0; i < count; ++i) {
        mx_GgxLight light = mx_ggx_reflected(reflection_ggx_samples, i, turn);
        color += light.color * (light.weight * (scale * mx_fresnel_schlick(light.cosine)));
        turn = vec2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
    }
    out1 = vec4(color, 1.0);
}
