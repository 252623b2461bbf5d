// standard_surface · surfacematerial · mxgen 0.1 · hlsl · complete · 9 closures · 0 textures
// shader model 6.0

struct mx_GgxLobe {
    float3 N;
    float3 x;
    float2 alpha;
    float masking;
};
struct mx_GgxSamples {
    float3x3 to_map;
    float3 stretch;
    float area;
    float3 v;
    float masking;
    float3 top;
    float step;
    float weight;
    float level;
};
cbuffer PublicUniforms : register(b1)
{
    float SR_standard_surface_base : packoffset(c0);
    float3 SR_standard_surface_base_color : packoffset(c0.y);
    float SR_standard_surface_diffuse_roughness : packoffset(c1);
    float SR_standard_surface_metalness : packoffset(c1.y);
    float SR_standard_surface_specular : packoffset(c1.z);
    float3 SR_standard_surface_specular_color : packoffset(c2);
    float SR_standard_surface_specular_roughness : packoffset(c2.w);
    float SR_standard_surface_specular_IOR : packoffset(c3);
    float SR_standard_surface_specular_anisotropy : packoffset(c3.y);
    float SR_standard_surface_specular_rotation : packoffset(c3.z);
    float SR_standard_surface_transmission : packoffset(c3.w);
    float3 SR_standard_surface_transmission_color : packoffset(c4);
    float SR_standard_surface_transmission_extra_roughness : packoffset(c4.w);
    float SR_standard_surface_subsurface : packoffset(c5);
    float3 SR_standard_surface_subsurface_color : packoffset(c5.y);
    float3 SR_standard_surface_subsurface_radius : packoffset(c6);
    float SR_standard_surface_subsurface_scale : packoffset(c6.w);
    float SR_standard_surface_sheen : packoffset(c7);
    float3 SR_standard_surface_sheen_color : packoffset(c7.y);
    float SR_standard_surface_sheen_roughness : packoffset(c8);
    float SR_standard_surface_coat : packoffset(c8.y);
    float3 SR_standard_surface_coat_color : packoffset(c9);
    float SR_standard_surface_coat_roughness : packoffset(c9.w);
    float SR_standard_surface_coat_anisotropy : packoffset(c10);
    float SR_standard_surface_coat_rotation : packoffset(c10.y);
    float SR_standard_surface_coat_IOR : packoffset(c10.z);
    float SR_standard_surface_coat_affect_color : packoffset(c10.w);
    float SR_standard_surface_coat_affect_roughness : packoffset(c11);
    float SR_standard_surface_thin_film_thickness : packoffset(c11.y);
    float SR_standard_surface_thin_film_IOR : packoffset(c11.z);
    float SR_standard_surface_emission : packoffset(c11.w);
    float3 SR_standard_surface_emission_color : packoffset(c12);
    float3 SR_standard_surface_opacity : packoffset(c13);
    bool SR_standard_surface_thin_walled : packoffset(c13.w);
};
cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_worldInverseTransposeMatrix : packoffset(c4);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c8);
    float3 u_viewPosition : packoffset(c12);
    int u_numActiveLightSources : packoffset(c12.w);
    row_major float4x4 u_envMatrix : packoffset(c13);
    int u_envRadianceMips : packoffset(c17);
    int u_envRadianceSamples : packoffset(c17.y);
    float u_envLightIntensity : packoffset(c17.z);
    float u_alphaThreshold : packoffset(c17.w);
    bool u_refractionTwoSided : packoffset(c18);
};
struct LightData {
    float3 direction;
    float3 color;
    float3 position;
    int type;
    float intensity;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
cbuffer LightData_block : register(b2)
{
    LightData u_lightData[3];
};
Texture2D u_envRadiance : register(t3);
SamplerState u_envRadiance_sampler : register(s3);
Texture2D u_envIrradiance : register(t4);
SamplerState u_envIrradiance_sampler : register(s4);
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalWorld : TEXCOORD1;
    float3 tangentWorld : TEXCOORD2;
};

mx_GgxLobe make_mx_GgxLobe(float3 N, float3 x, float2 alpha, float masking)
{
    mx_GgxLobe made;
    made.N = N;
    made.x = x;
    made.alpha = alpha;
    made.masking = masking;
    return made;
}

mx_GgxSamples make_mx_GgxSamples(float3x3 to_map, float3 stretch, float area, float3 v, float masking, float3 top,
    float step, float weight, float level)
{
    mx_GgxSamples made;
    made.to_map = to_map;
    made.stretch = stretch;
    made.area = area;
    made.v = v;
    made.masking = masking;
    made.top = top;
    made.step = step;
    made.weight = weight;
    made.level = level;
    return made;
}

// Unpolarised Fresnel equations of a dielectric; the clamped root makes total internal reflection come out as 1.
float mx_fresnel_dielectric(float cosine, float ior)
{
    float g = sqrt(max(ior * ior + cosine * cosine - 1.0, 0.0));
    float2 a = cosine * float2(1.0, ior * ior);
    float2 r = (a - g) / (a + g);
    return 0.5 * dot(r, r);
}

// A channel after interference, the mean of both polarisations.
float mx_film_channel(float2 a, float2 re, float2 im, float2 terms)
{
    float2 r23 = re * re + im * im;
    float2 t = 1.0 - a * a;
    float2 even = t * t * r23 / (1.0 - a * a * r23);
    float2 both = a * a + even + 2.0 * (even - t) * terms;
    return 0.5 * (both.x + both.y);
}

// Two terms of the series (section 3.3) for one Gaussian: amplitude `a` of the film's own interface, which from behind
// is -a, and re + i im of the one below, and light that goes further by d / (2 pi) micrometre.
float2 mx_film_terms(float2 a, float2 re, float2 im, float d, float3 gauss)
{
    float c = cos(gauss.x * d);
    float s = sin(gauss.x * d);
    float decay = exp(gauss.z * d * d);
    float2 x = re * c - im * s;
    float2 y = re * s + im * c;
    return gauss.y * decay * a * (a * (decay * decay * decay) * (x * x - y * y) - x);
}

// The index n + ik times the cosine behind its interface: (u + iv)^2 = (n + ik)^2 - sin^2.
float2 mx_fresnel_refract(float cosine, float n, float k)
{
    float t = n * n - k * k + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + 4.0 * n * n * k * k);
    return sqrt(max(0.5 * float2(norm + t, norm - t), 0.0));
}

// Amplitudes re + i im of the interface below: (x + iy - u - iv) / (x + iy + u + iv), as in mx_fresnel_conductor.
void mx_film_base(float cosine, float n, float k, out float2 re, out float2 im)
{
    float2 u = mx_fresnel_refract(cosine, n, k);
    float2 x = cosine * float2(1.0, n * n - k * k);
    float2 y = float2(0.0, 2.0 * cosine * n * k);
    float2 norm = (x + u.x) * (x + u.x) + (y + u.y) * (y + u.y);
    re = (x * x + y * y - dot(u, u)) / norm;
    im = 2.0 * (y * u.x - x * u.y) / norm;
}

// Amplitudes of the film's own interface.
float2 mx_film_amplitudes(float cosine, float inside, float ior)
{
    float2 x = float2(cosine, ior * cosine);
    float2 u = float2(ior * inside, inside);
    return (x - u) / (x + u);
}

// A film on the index n + ik.
float3 mx_film_index(float cosine, float3 n, float3 k, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    float2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    float2 re;
    float2 im;
    mx_film_base(c, n.x / ior, k.x / ior, re, im);
    float x = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, float3(1.681, 0.84659, -0.0043278))
        + mx_film_terms(a, re, im, d, float3(2.2399, 0.153868, -0.0045282)));
    mx_film_base(c, n.y / ior, k.y / ior, re, im);
    float y = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, float3(1.7953, 1.000222, -0.0093046)));
    mx_film_base(c, n.z / ior, k.z / ior, re, im);
    float z = mx_film_channel(a, re, im, mx_film_terms(a, re, im, d, float3(2.2084, 1.001122, -0.0066121)));
    return clamp(mul(float3(x, y, z), float3x3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949,
        -0.4706338, 0.0885814, 1.0093968)), 0.0, 1.0);
}

float3 mx_fresnel(float cosine, float3 n, float film, float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, float3(0.0, 0.0, 0.0), film, film_ior);
    return (float3)mx_fresnel_dielectric(cosine, n.x);
}

// Burley 2012, section 5.4: the aspect ratio stretches one axis and shrinks the other.
float2 mx_roughness_anisotropy(float roughness, float anisotropy)
{
    float squared = clamp(roughness * roughness, 1e-8, 1.0);
    float aspect = sqrt(1.0 - clamp(anisotropy, 0.0, 0.98));
    return float2(min(squared / aspect, 1.0), squared * aspect);
}

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), mul(float4(1.0, y, y * y, y * y * y), m));
}

// The program fits/ggx.c makes the constants. x is never too small by more than 0.001, so that giving lost energy back
// adds none. `u` follows what happens where light grazes the facets.
float2 mx_ggx_albedo_fit(float a, float u, float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(float4x4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657,
        2.5694, 38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u, a), 0.0, 1.0);
    return float2(min(1.0046 - u * mx_bicubic(float4x4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911,
        -1.0905, 11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u, a), 1.0), x * x * x * x
        * x);
}

// Rodrigues' formula; the axis has unit length.
float3 mx_rotate3d(float3 v, float angle, float3 axis)
{
    float c = cos(angle);
    return v * c + cross(v, axis) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
}

// Heitz 2014, "Understanding the Masking-Shadowing Function", equation 72: cos (1 + 2 Lambda).
float mx_ggx_masking(float cosine, float area)
{
    return sqrt(lerp(cosine * cosine, 1.0, area));
}

// N faces V.
mx_GgxLobe mx_ggx_lobe(float2 roughness, float3 N, float3 X, float3 V)
{
    float2 alpha = clamp(roughness, 1e-8, 1.0);
    return make_mx_GgxLobe(N, normalize(X - dot(X, N) * N), alpha,
        mx_ggx_masking(max(dot(N, V), 1e-8), alpha.x * alpha.y));
}

// The lobe towards L, but for Fresnel's factor: distribution and visibility over one divisor.
float mx_ggx_light(mx_GgxLobe lobe, float3 V, float3 L)
{
    float3 H = V + L;
    float2 slope = float2(dot(H, lobe.x), dot(cross(H, lobe.N), lobe.x)) / lobe.alpha;
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float cos_h = dot(lobe.N, V) + dot(lobe.N, L);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = dot(slope, slope) + cos_h * cos_h;
    return square * square * cos_l / (6.2831855 * area * e * e
        * (max(dot(lobe.N, V), 1e-8) * sqrt(lerp(cos_l * cos_l, 1.0, area)) + cos_l * lobe.masking));
}

// Gulbrandsen 2014, "Artist Friendly Metallic Fresnel": his r (n + 1)^2 - (n - 1)^2 is 0 at the greatest n and at 1
// over it, hence factors.
void mx_artistic_ior(float3 reflectivity, float3 edge_color, out float3 ior, out float3 extinction)
{
    float3 s = sqrt(clamp(reflectivity, 0.0, 0.99));
    float3 greatest = (1.0 + s) / (1.0 - s);
    ior = lerp(greatest, (1.0 - s * s) / (1.0 + s * s), edge_color);
    extinction = sqrt(max((greatest - ior) * (ior - 1.0 / greatest), 0.0));
}

// |(x + iy - u - iv) / (x + iy + u + iv)|^2
float mx_fresnel_ratio(float2 x, float2 u)
{
    return dot(x - u, x - u) / dot(x + u, x + u);
}

// Fresnel equations for the index n + ik (Pharr et al. 2023, section 9.3.6): against u + iv stands the cosine in the
// perpendicular part, (n + ik)^2 times the cosine in the parallel part.
float mx_fresnel_conductor(float cosine, float n, float k)
{
    float2 u = mx_fresnel_refract(cosine, n, k);
    return 0.5 * (mx_fresnel_ratio(float2(cosine, 0.0), u)
        + mx_fresnel_ratio(cosine * float2(n * n - k * k, 2.0 * n * k), u));
}

// One channel after the other, which needs a third of the registers.
float3 mx_fresnel_conductor(float cosine, float3 n, float3 k)
{
    return float3(mx_fresnel_conductor(cosine, n.x, k.x), mx_fresnel_conductor(cosine, n.y, k.y),
        mx_fresnel_conductor(cosine, n.z, k.z));
}

float3 mx_fresnel(float cosine, float3 n, float3 k, float film, float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n, k, film, film_ior);
    return mx_fresnel_conductor(cosine, n, k);
}

float3 mx_subsurface_light(float3 falloff, float cos_l)
{
    float sin_l = sqrt(max(1.0 - cos_l * cos_l, 0.0));
    float3 light = float3(0.0, 0.0, 0.0);
    float3 sum = float3(0.0, 0.0, 0.0);
    float2 middle = float2(0.9987955, 0.04906767);
    while (middle.x > 0.0) {
        float d = middle.y;
        float3 e = exp(falloff * d);
        float3 profile = (e + e * e * e) / d;
        float along = cos_l * (1.0 - 2.0 * d * d);
        float across = sin_l * (2.0 * d * middle.x);
        light += profile * (max(along - across, 0.0) + max(along + across, 0.0));
        sum += 2.0 * profile;
        middle = mul(middle, float2x2(0.9951847, 0.09801714, -0.09801714, 0.9951847));
    }
    return light / (3.1415927 * sum);
}

// The point of the picture for a unit direction in it.
float2 mx_map_point(float3 d)
{
    float2 a = abs(d.xz);
    float t = min(a.x, a.y) / max(max(a.x, a.y), 1e-8);
    float t2 = t * t;
    float turn = t * (0.1590298 + t2 * (t2 * (0.0232785 - 0.0062048 * t2) - 0.0511165));
    turn = a.x > a.y ? 0.25 - turn : turn;
    turn = d.z > 0.0 ? 0.5 - turn : turn;
    float y = abs(d.y);
    float height = sqrt(max(1.0 - y, 0.0)) * (0.4999879 + y * (y * (0.0244774 - 0.0066502 * y) - 0.0677603));
    return float2(d.x < 0.0 ? 0.5 - turn : 0.5 + turn, d.y < 0.0 ? 1.0 - height : height);
}

// Light of a unit direction in the picture, filtered over the solid angle of a sample (Krivanek and Colbert 2008; the
// mip level is equation 13 of GPU Gems 3, section 20.4).
float3 mx_filtered_light(float3 d, float level)
{
    return u_envRadiance.SampleLevel(u_envRadiance_sampler, mx_map_point(d),
        max(0.25 * log2(level * level / dot(d.xz, d.xz)), 0.0)).xyz;
}

// Direction of the ray -v after it has entered the sphere at normal h and left it again.
float3 mx_refract_sphere(float3 v, float3 h, float ior)
{
    float3 inside = refract(-v, h, 1.0 / ior);
    return refract(inside, normalize(inside * dot(inside, h) - 0.5 * h), ior);
}

// Height-correlated masking and shadowing G2 (Heitz 2014, equation 99) over 2 cos_v cos_l; half is left of the divisor
// of the reflection model.
float mx_ggx_visibility(float cos_v, float masking, float area, float cos_l)
{
    return 1.0 / (cos_v * sqrt(lerp(cos_l * cos_l, 1.0, area)) + cos_l * masking);
}

// The light of a sample, and in the fourth component the cosine at its facet h, of any length; `spread` is its level
// over that of the first.
float4 mx_ggx_sample_at(mx_GgxSamples s, float3 h, float shrink, float spread, float refract_ior)
{
    float cosine = dot(s.v, h);
    float3 l = 2.0 * shrink * cosine * h - s.v;
    float cos_l = max(l.z, 1e-8);
    float weight = cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l);
    if (refract_ior > 0.0) {
        l = mx_refract_sphere(s.v, h * sqrt(shrink), refract_ior);
        weight = 0.5 / s.v.z;
    }
    return float4(weight * mx_filtered_light(mul(l, s.to_map), spread * spread * s.level),
        clamp(cosine * sqrt(shrink), 1e-8, 1.0));
}

// A normal of those visible from v, which is stretched by the roughness, before it is scaled to length 1 (Dupuy and
// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"): (cos, sin) of its turn around z, and how far the
// cap is below its top, `top` = v + z.
float3 mx_ggx_cap(float2 around, float depth, float3 top)
{
    return float3(top.xy + sqrt(depth * (2.0 - depth)) * around, top.z - depth);
}

float4 mx_ggx_sample(mx_GgxSamples s, float2 around, float depth, float refract_ior)
{
    float3 cap = mx_ggx_cap(around, depth, s.top);
    float3 h = cap * s.stretch;
    float shrink = 1.0 / dot(h, h);
    return mx_ggx_sample_at(s, h, shrink, shrink * dot(cap, cap), refract_ior);
}

mx_GgxSamples mx_ggx_samples(mx_GgxLobe lobe, float3 V)
{
    float3x3 frame = float3x3(lobe.x, cross(lobe.N, lobe.x), lobe.N);
    float3 v = max(mul(frame, V), float3(-1.0, -1.0, 1e-8));
    float area = lobe.alpha.x * lobe.alpha.y;
    float3 stretch = float3(lobe.alpha, 1.0);
    float3 top = normalize(v * stretch) + float3(0.0, 0.0, 1.0);
    float share = 1.0 / float(max(u_envRadianceSamples, 1));
    float weight = share * (v.z + lobe.masking);
    return make_mx_GgxSamples(mul(frame, (float3x3)u_envMatrix), stretch, area, v, lobe.masking, top, share * top.z,
        weight * u_envLightIntensity, weight * area * exp2(2.0 * float(u_envRadianceMips) - 2.3485));
}

// A function for each interface: what has nothing left to choose needs no version of its own.
float3 mx_ggx_gather_dielectric(mx_GgxLobe lobe, float3 V, float limit, float refract_ior, float ior)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    float2 around = float2(1.0, 0.0);
    float3 sum = float3(0.0, 0.0, 0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        float4 light = mx_ggx_sample(samples, around, depth, refract_ior);
        float f = mx_fresnel_dielectric(light.w, ior);
        sum += (refract_ior > 0.0 ? 1.0 - f : f) * light.xyz;
        around = mul(around, float2x2(-0.7373689, 0.6754903, -0.6754903, -0.7373689));
    }
    return samples.weight * sum;
}

// A film on an index of refraction, reflection alone: what most films are.
float3 mx_ggx_gather_film_index(mx_GgxLobe lobe, float3 V, float limit, float3 n, float3 k, float film, float film_ior)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    float2 around = float2(1.0, 0.0);
    float3 sum = float3(0.0, 0.0, 0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        float4 light = mx_ggx_sample(samples, around, depth, 0.0);
        sum += mx_film_index(light.w, n, k, film, film_ior) * light.xyz;
        around = mul(around, float2x2(-0.7373689, 0.6754903, -0.6754903, -0.7373689));
    }
    return samples.weight * sum;
}

float3 mx_ggx_gather_conductor(mx_GgxLobe lobe, float3 V, float limit, float3 n, float3 k)
{
    mx_GgxSamples samples = mx_ggx_samples(lobe, V);
    float2 around = float2(1.0, 0.0);
    float3 sum = float3(0.0, 0.0, 0.0);
    for (float depth = 0.5 * samples.step; depth < limit * samples.top.z; depth += samples.step) {
        float4 light = mx_ggx_sample(samples, around, depth, 0.0);
        sum += mx_fresnel_conductor(light.w, n, k) * light.xyz;
        around = mul(around, float2x2(-0.7373689, 0.6754903, -0.6754903, -0.7373689));
    }
    return samples.weight * sum;
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    float coat = SR_standard_surface_coat;
    float coat_IOR = SR_standard_surface_coat_IOR;
    float coat_front = coat_IOR * 4.0 / ((coat_IOR + 1.0) * (coat_IOR + 1.0));
    float3 N = normalize(vd.normalWorld);
    float3 V = normalize(u_viewPosition - vd.positionWorld);
    float absolute = abs(dot(N, V));
    float3 color = SR_standard_surface_emission
        * (SR_standard_surface_emission_color
        * (1.0 - coat + SR_standard_surface_coat_color
        * (coat * (coat_front * (1.0 - pow(1.0 - min(absolute, 1.0), 5.0))))));
    // lights
    float3 vector_coat_gamma = (float3)(SR_standard_surface_coat_affect_color * clamp(coat, 0.0, 1.0) + 1.0);
    float specular_IOR = SR_standard_surface_specular_IOR;
    float thin_film_thickness = SR_standard_surface_thin_film_thickness;
    float thin_film_IOR = SR_standard_surface_thin_film_IOR;
    float coat_blur = SR_standard_surface_coat_roughness * (coat * SR_standard_surface_coat_affect_roughness);
    float2 roughness = mx_roughness_anisotropy(lerp(SR_standard_surface_specular_roughness, 1.0, coat_blur),
        SR_standard_surface_specular_anisotropy);
    float2 alpha = clamp(roughness, 1e-8, 1.0);
    float a = sqrt(alpha.x * alpha.y);
    float cos_v = max(absolute, 1e-8);
    float2 albedo = mx_ggx_albedo_fit(a, a / (cos_v + a), cos_v);
    float difference = 1.0 / albedo.x - 1.0;
    float3 reflection_scale = lerp(mx_fresnel(1.0, (float3)specular_IOR, thin_film_thickness, thin_film_IOR),
        float3(1.0, 1.0, 1.0), 0.04761905) * difference + float3(1.0, 1.0, 1.0);
    float fresnel_bare = mx_fresnel_dielectric(1.0, coat_IOR);
    float2 coat_lobe = mx_roughness_anisotropy(SR_standard_surface_coat_roughness, SR_standard_surface_coat_anisotropy);
    float2 coating_alpha = clamp(coat_lobe, 1e-8, 1.0);
    float coating_a = sqrt(coating_alpha.x * coating_alpha.y);
    float2 coating_albedo = mx_ggx_albedo_fit(coating_a, coating_a / (cos_v + coating_a), cos_v);
    float coating_scale = lerp(fresnel_bare, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coating_difference = 1.0 - coat
        * (lerp(fresnel_bare, 1.0, coating_albedo.y) * coating_albedo.x * coating_scale);
    float3 clamped_coat_tint = clamp(lerp(float3(1.0, 1.0, 1.0), SR_standard_surface_coat_color, coat), 0.0, 1.0);
    float3 body_weight = (float3(1.0, 1.0, 1.0) - reflection_scale
        * (SR_standard_surface_specular * (lerp(mx_fresnel_dielectric(1.0, specular_IOR), 1.0, albedo.y) * albedo.x)))
        * (coating_difference * clamped_coat_tint);
    float sheen_albedo = clamp(mx_bicubic(float4x4(3.7341, -15.9587, 23.621, -11.0989, -8.2265, 35.1081, -49.7137,
        23.2945, 4.0691, -17.882, 25.6639, -12.0167, -0.5833, 2.6552, -3.9393, 1.8999), 1.0 / (cos_v + 1.0), 1.0
        / (SR_standard_surface_sheen_roughness + 0.2)), 0.0, 1.0);
    float fuzz_throughput = 1.0 - SR_standard_surface_sheen * sheen_albedo;
    float dielectric_weight = 1.0 - SR_standard_surface_metalness;
    float opaque_weight = dielectric_weight * (1.0 - SR_standard_surface_transmission);
    float3 diffuse_weight = body_weight * (fuzz_throughput
        * (SR_standard_surface_base * (opaque_weight * (1.0 - SR_standard_surface_subsurface))));
    float3 diffuse_product = pow(max(SR_standard_surface_base_color, 0.0), vector_coat_gamma) * diffuse_weight;
    float3 Nf = faceforward(N, -V, N);
    float r2 = SR_standard_surface_diffuse_roughness * SR_standard_surface_diffuse_roughness;
    float2 ab = r2 * float2(-0.5, 0.45) / (r2 + float2(0.33, 0.09)) + float2(1.0, 0.0);
    float s = 1.0 / max(SR_standard_surface_sheen_roughness, 0.005);
    float v_dot_nf = dot(V, Nf);
    float3 fuzz_product = SR_standard_surface_sheen_color * (body_weight * (SR_standard_surface_sheen * opaque_weight));
    float3 scatter_color = pow(max(SR_standard_surface_subsurface_color, 0.0), vector_coat_gamma);
    float thin = float(SR_standard_surface_thin_walled);
    float translucent_weight = thin * (SR_standard_surface_subsurface * opaque_weight);
    float3 translucent_product = scatter_color * (body_weight * (fuzz_throughput * translucent_weight));
    float3 tangent_direction = normalize(vd.tangentWorld);
    float3 coat_tangent = mx_rotate3d(tangent_direction, radians(SR_standard_surface_coat_rotation * 360.0), N);
    mx_GgxLobe coating_lobe = mx_ggx_lobe(coat_lobe, Nf, coat_tangent, V);
    float3 metal_ior, metal_extinction;
    mx_artistic_ior(SR_standard_surface_base * SR_standard_surface_base_color, SR_standard_surface_specular
        * SR_standard_surface_specular_color, metal_ior, metal_extinction);
    float3 metal_scale = difference * lerp(mx_fresnel(1.0, metal_ior, metal_extinction, thin_film_thickness,
        thin_film_IOR), float3(1.0, 1.0, 1.0), 0.04761905) + float3(1.0, 1.0, 1.0);
    float3 metal_product = metal_scale * (clamped_coat_tint * (SR_standard_surface_metalness * coating_difference));
    float3 specular_tangent = mx_rotate3d(tangent_direction, radians(SR_standard_surface_specular_rotation * 360.0), N);
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, Nf, specular_tangent, V);
    bool reflection_visible = SR_standard_surface_specular * dielectric_weight > 0.0;
    float3 reflection_weight = clamped_coat_tint
        * (coating_difference * (SR_standard_surface_specular * dielectric_weight));
    float3 reflection_product = reflection_weight * (reflection_scale * max(SR_standard_surface_specular_color, 0.0));
    float scatter_weight = SR_standard_surface_subsurface * opaque_weight * (1.0 - thin);
    float scaled_curvature = max(length(fwidth(Nf)) / length(fwidth(vd.positionWorld)), 0.01) * 3.0;
    float3 subsurface_falloff = float3(-2.0, -2.0, -2.0)
        / (scaled_curvature * max(SR_standard_surface_subsurface_radius * SR_standard_surface_subsurface_scale, 0.1));
    float3 scatter_product = scatter_color * (body_weight * (fuzz_throughput * scatter_weight));
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // fuzz, translucent, diffuse
        int type = u_lightData[i].type;
        float intensity = u_lightData[i].intensity;
        float3 d = u_lightData[i].position - vd.positionWorld;
        float ratio = intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
        float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
        float3 to_light = normalize(d);
        float spot_light_product = smoothstep(spot_light_difference, u_lightData[i].inner_angle,
            -dot(u_lightData[i].direction, to_light)) * ratio;
        float spot_light_choice = type == 3 ? spot_light_product : 0.0;
        float point_light_choice = type == 2 ? ratio : spot_light_choice;
        float3 light = u_lightData[i].color * (type == 1 ? intensity : point_light_choice);
        float3 directional_light_to_light = -u_lightData[i].direction;
        float3 L = type == 1 ? directional_light_to_light : to_light;
        float l_dot_nf = dot(L, Nf);
        float cos_l = max(l_dot_nf, 1e-8);
        float v_dot_l = dot(V, L);
        float3 diffuse_response = diffuse_product
            * (cos_l / 3.1415927 * (ab.x + ab.y * max(v_dot_l - cos_v * cos_l, 0.0) / max(cos_l, cos_v)));
        float scaled_along = (l_dot_nf + v_dot_nf) * (l_dot_nf + v_dot_nf);
        float fuzz_product_2 = cos_l * ((s + 2.0)
            * pow(clamp(1.0 - scaled_along / max(v_dot_l * 2.0 + 2.0, 1e-8), 0.0, 1.0), s * 0.5) / 6.2831855);
        float3 fuzz_response = fuzz_product_2 / ((cos_v + cos_l - cos_v * cos_l) * 4.0) * fuzz_product;
        color += light * (diffuse_response + (fuzz_response + max(-l_dot_nf, 0.0) / 3.1415927 * translucent_product));
        // coating
        float cosine = sqrt(clamp(v_dot_l * 0.5 + 0.5, 1e-8, 1.0));
        if (coat > 0.0)
            color += light * (coat * coating_scale
                * (mx_ggx_light(coating_lobe, V, L) * mx_fresnel_dielectric(cosine, coat_IOR)));
        // metal
        float ggx_light = mx_ggx_light(lobe, V, L);
        if (SR_standard_surface_metalness > 0.0)
            color += light * (metal_product
                * (ggx_light * mx_fresnel(cosine, metal_ior, metal_extinction, thin_film_thickness, thin_film_IOR)));
        // reflection
        if (reflection_visible)
            color += light * (reflection_product
                * (ggx_light * mx_fresnel(cosine, (float3)specular_IOR, thin_film_thickness, thin_film_IOR)));
        // scatter
        if (scatter_weight > 0.0)
            color += light * (mx_subsurface_light(subsurface_falloff, l_dot_nf) * scatter_product);
    }
    // environment
    // fuzz, scatter, diffuse
    float3 part = u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
        mx_map_point(normalize(mul(float4(Nf, 0.0), u_envMatrix).xyz)), 0.0).xyz;
    float2 fit = SR_standard_surface_diffuse_roughness
        * (cos_v * float2(-0.7632, -0.4993) - float2(0.4297, 0.6076) + SR_standard_surface_diffuse_roughness
        * float2(1.4385, 2.0315)) + float2(1.0, 1.0);
    float3 diffuse_response_2 = diffuse_product * part * (u_envLightIntensity * clamp(fit.x / fit.y, 0.0, 1.0));
    float3 fuzz_response_2 = fuzz_product * part * (sheen_albedo * u_envLightIntensity);
    color += diffuse_response_2 + (fuzz_response_2 + u_envLightIntensity * (scatter_product * part));
    // coating
    if (coat > 0.0)
        color += coat * coating_scale * mx_ggx_gather_dielectric(coating_lobe, V, 1.0, 0.0, coat_IOR);
    // metal
    float filmed = thin_film_thickness > 0.0 ? 1.0 : 0.0;
    float limit = thin_film_thickness > 0.0 ? 0.0 : 1.0;
    if (SR_standard_surface_metalness > 0.0) {
        float3 metal_ggx_gather_film_index = mx_ggx_gather_film_index(lobe, V, filmed, metal_ior, metal_extinction,
            thin_film_thickness, thin_film_IOR);
        float3 metal_bare = mx_ggx_gather_conductor(lobe, V, limit, metal_ior, metal_extinction);
        color += metal_product * (thin_film_thickness > 0.0 ? metal_ggx_gather_film_index : metal_bare);
    }
    // reflection
    if (reflection_visible) {
        float3 reflection_ggx_gather_film_index = mx_ggx_gather_film_index(lobe, V, filmed, (float3)specular_IOR,
            float3(0.0, 0.0, 0.0), thin_film_thickness, thin_film_IOR);
        float3 reflection_bare = mx_ggx_gather_dielectric(lobe, V, limit, 0.0, specular_IOR);
        color += reflection_product * (thin_film_thickness > 0.0 ? reflection_ggx_gather_film_index : reflection_bare);
    }
    // refraction
    if (SR_standard_surface_transmission * dielectric_weight > 0.0) {
        float3 tint = max(SR_standard_surface_transmission_color, 0.0);
        float transmission_blurred = lerp(clamp(SR_standard_surface_specular_roughness
            + SR_standard_surface_transmission_extra_roughness, 0.0, 1.0), 1.0, coat_blur);
        mx_GgxLobe refraction_lobe = mx_ggx_lobe(mx_roughness_anisotropy(transmission_blurred,
            SR_standard_surface_specular_anisotropy), Nf, specular_tangent, V);
        float3 ggx_refraction = mx_ggx_gather_dielectric(refraction_lobe, V, 1.0, specular_IOR, specular_IOR);
        float3 dielectric_bsdf_transmission = tint * (u_refractionTwoSided ? tint : float3(1.0, 1.0, 1.0))
            * ggx_refraction;
        color += dielectric_bsdf_transmission * (body_weight * (SR_standard_surface_transmission * dielectric_weight));
    }
    // translucent
    if (translucent_weight > 0.0)
        color += u_envLightIntensity * (translucent_product
            * u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
            mx_map_point(normalize(mul(float4(-Nf, 0.0), u_envMatrix).xyz)), 0.0).xyz);
    // opacity
    float opacity_grey = dot(SR_standard_surface_opacity, float3(0.2722287, 0.6740818, 0.0536895));
    if (opacity_grey < u_alphaThreshold)
        discard;
    out1 = float4(opacity_grey * color, opacity_grey);
}
