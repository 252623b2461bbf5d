// open_pbr_surface · surfacematerial · mxgen 0.1 · hlsl · complete · 13 closures · 0 textures
// shader model 6.0

struct mx_GgxLobe {
    float3 N;
    float cosine;
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
    float reach;
    float step;
    float texels;
    float weight;
};
struct mx_GgxFacet {
    float3 h;
    float cosine;
    float mirror;
    float texels;
};
struct mx_GgxLight {
    float3 color;
    float weight;
    float cosine;
};
cbuffer PublicUniforms : register(b1)
{
    float SR_open_pbr_surface_base_weight : packoffset(c0);
    float3 SR_open_pbr_surface_base_color : packoffset(c0.y);
    float SR_open_pbr_surface_base_diffuse_roughness : packoffset(c1);
    float SR_open_pbr_surface_base_metalness : packoffset(c1.y);
    float SR_open_pbr_surface_specular_weight : packoffset(c1.z);
    float3 SR_open_pbr_surface_specular_color : packoffset(c2);
    float SR_open_pbr_surface_specular_roughness : packoffset(c2.w);
    float SR_open_pbr_surface_specular_ior : packoffset(c3);
    float SR_open_pbr_surface_specular_roughness_anisotropy : packoffset(c3.y);
    float SR_open_pbr_surface_transmission_weight : packoffset(c3.z);
    float3 SR_open_pbr_surface_transmission_color : packoffset(c4);
    float SR_open_pbr_surface_transmission_depth : packoffset(c4.w);
    float3 SR_open_pbr_surface_transmission_scatter : packoffset(c5);
    float SR_open_pbr_surface_subsurface_weight : packoffset(c5.w);
    float3 SR_open_pbr_surface_subsurface_color : packoffset(c6);
    float SR_open_pbr_surface_subsurface_radius : packoffset(c6.w);
    float3 SR_open_pbr_surface_subsurface_radius_scale : packoffset(c7);
    float SR_open_pbr_surface_subsurface_scatter_anisotropy : packoffset(c7.w);
    float SR_open_pbr_surface_fuzz_weight : packoffset(c8);
    float3 SR_open_pbr_surface_fuzz_color : packoffset(c8.y);
    float SR_open_pbr_surface_fuzz_roughness : packoffset(c9);
    float SR_open_pbr_surface_coat_weight : packoffset(c9.y);
    float3 SR_open_pbr_surface_coat_color : packoffset(c10);
    float SR_open_pbr_surface_coat_roughness : packoffset(c10.w);
    float SR_open_pbr_surface_coat_roughness_anisotropy : packoffset(c11);
    float SR_open_pbr_surface_coat_ior : packoffset(c11.y);
    float SR_open_pbr_surface_coat_darkening : packoffset(c11.z);
    float SR_open_pbr_surface_thin_film_weight : packoffset(c11.w);
    float SR_open_pbr_surface_thin_film_thickness : packoffset(c12);
    float SR_open_pbr_surface_thin_film_ior : packoffset(c12.y);
    float SR_open_pbr_surface_emission_luminance : packoffset(c12.z);
    float3 SR_open_pbr_surface_emission_color : packoffset(c13);
    float SR_open_pbr_surface_geometry_opacity : packoffset(c13.w);
    bool SR_open_pbr_surface_geometry_thin_walled : packoffset(c14);
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

mx_GgxLobe make_mx_GgxLobe(float3 N, float cosine, float3 x, float2 alpha, float masking)
{
    mx_GgxLobe made;
    made.N = N;
    made.cosine = cosine;
    made.x = x;
    made.alpha = alpha;
    made.masking = masking;
    return made;
}

mx_GgxSamples make_mx_GgxSamples(float3x3 to_map, float3 stretch, float area, float3 v, float masking, float reach,
    float step, float texels, float weight)
{
    mx_GgxSamples made;
    made.to_map = to_map;
    made.stretch = stretch;
    made.area = area;
    made.v = v;
    made.masking = masking;
    made.reach = reach;
    made.step = step;
    made.texels = texels;
    made.weight = weight;
    return made;
}

mx_GgxFacet make_mx_GgxFacet(float3 h, float cosine, float mirror, float texels)
{
    mx_GgxFacet made;
    made.h = h;
    made.cosine = cosine;
    made.mirror = mirror;
    made.texels = texels;
    return made;
}

mx_GgxLight make_mx_GgxLight(float3 color, float weight, float cosine)
{
    mx_GgxLight made;
    made.color = color;
    made.weight = weight;
    made.cosine = cosine;
    return made;
}

// The numbers a and b of the linear transform that makes the sheen lobe of roughness r, at the cosine c of the viewer,
// of a clamped cosine (Zeltner, Burley and Chiang 2022):
//     M^-1 = [a 0 b; 0 a 0; 0 0 1] in the plane of V and N
float2 mx_sheen_transform(float c, float r)
{
    return float2((2.58126 * c + 0.813703 * r) * r / (1.0 + 0.310327 * c * c + 2.60994 * c * r),
        sqrt(1.0 - c) * (r - 1.0) * r * r * r / (0.0000254053 + 1.71228 * c - 1.71506 * c * r + 1.34174 * r * r));
}

// The direction w in the tangent space around N, whose x lies along the unit tangent `x`.
float3 mx_enter_frame(float3 w, float3 N, float3 x)
{
    return float3(dot(w, x), dot(w, cross(N, x)), dot(w, N));
}

// The unit tangent along X at the normal N.
float3 mx_tangent(float3 N, float3 X)
{
    return normalize(X - dot(X, N) * N);
}

// The sheen lobe of roughness r from L to V, where V has the cosine c (Zeltner, Burley and Chiang 2022).
float mx_sheen_zeltner(float3 N, float3 V, float3 L, float c, float r)
{
    float2 m = mx_sheen_transform(c, r);
    float3 l = mx_enter_frame(L, N, mx_tangent(N, V + 0.00001 * N.yzx));
    float3 w = float3(m.x * l.x + m.y * l.z, m.x * l.y, l.z);
    float scale = m.x / dot(w, w);
    return max(w.z, 0.0) / 3.1415927 * scale * scale;
}

// Squared roughness along X and across (OpenPBR Surface specification, "Microfacet model").
float2 mx_open_pbr_anisotropy(float roughness, float anisotropy)
{
    float aspect = 1.0 - anisotropy;
    return roughness * roughness * sqrt(2.0 / (1.0 + aspect * aspect)) * float2(1.0, aspect);
}

// cos (1 + 2 Lambda) of a direction for GGX; `area` is the product of the roughness along x and y (Heitz 2014,
// "Understanding the Masking-Shadowing Function", equation 72).
float mx_ggx_masking(float cosine, float area)
{
    return sqrt(area + (1.0 - area) * (cosine * cosine));
}

// The GGX lobe of a surface as lights see it; roughness is that along X and across, squared.
// Here is_round = false.
mx_GgxLobe mx_ggx_lobe(float2 roughness, float3 N, float3 X, float3 V)
{
    float2 alpha = clamp(roughness, 1e-8, 1.0);
    float cosine = max(abs(dot(N, V)), 1e-8);
    return make_mx_GgxLobe(faceforward(N, -V, N), cosine, normalize(X - dot(X, N) * N), alpha,
        mx_ggx_masking(cosine, alpha.x * alpha.y));
}

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = false, is_wide = false.
float mx_ggx_stretched(mx_GgxLobe lobe, float3 H, float cos_h)
{
    float2 parts = float2(dot(H, lobe.x), dot(cross(H, lobe.N), lobe.x)) / lobe.alpha;
    return lobe.alpha.x * lobe.alpha.y * (dot(parts, parts) + cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = false, is_wide = false.
float mx_ggx_light(mx_GgxLobe lobe, float3 V, float3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, V + L, lobe.cosine + dot(lobe.N, L));
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
float mx_fresnel_permittivity(float cosine, float re)
{
    float k = 0.5 * (re - 1.0);
    float c2 = max(cosine * cosine, -2.0 * k);
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 2.0 * k);
    float r = k / max((1.0 + k) * (c2 + sqrt(cg2)) + k, 1e-8);
    return (cg2 + s * s) * (r * r);
}

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), mul(float4(1.0, y, y * y, y * y * y), m));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
float2 mx_ggx_albedo_fit(float a, float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(float4x4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), a / (a + c), a), 0.0, 1.0);
    float u = a / (a + 0.6 * c);
    return float2(min(1.0017 - u * u * mx_bicubic(float4x4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238,
        8.7382, 4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, a * c), 1.0),
        x * x * x * x * x);
}

// Roughness of a lobe that is seen through a rough coat (OpenPBR Surface specification, "Roughening").
float mx_open_pbr_blurred(float roughness, float coat_roughness)
{
    return pow(min(2.0 * pow(coat_roughness, 4.0) + pow(roughness, 4.0), 1.0), 0.25);
}

// Light of one polarisation that interferes in a film, as Gaussian i of the CIE curves sees it: `a` is the amplitude of
// the film's interface, r that of the interface below, and light in the film goes further by d / (2 pi) micrometres.
float mx_film_light(float a, float2 r, float d, int i)
{
    float4 gaussian = float4x4(1.681, 0.846202, -0.0043278, 0.0, 2.2399, 0.153798, -0.0045282, 0.0, 1.7953, 1.0,
        -0.0093046, 0.0, 2.2084, 1.0, -0.0066121, 0.0)[i];
    float decay = exp(gaussian.z * d * d);
    float d2 = decay * decay;
    float d4 = d2 * d2;
    float r23 = dot(r, r);
    float path = -a * decay * (r.x * cos(gaussian.x * d) - r.y * sin(gaussian.x * d));
    float square = a * a * r23 * d2;
    float rest = (2.0 * path * path - square - d4 * square * path) / (1.0 - 2.0 * d4 * path + d4 * d4 * square);
    float t = 1.0 - a * a;
    float even = t * t * r23 / (1.0 - a * a * r23);
    return gaussian.y * (a * a + even + 2.0 * (even - t) * (path + d2 * rest));
}

// Amplitudes of an interface of reflectance f below a film of index `ior`: negative where f0 says that the index behind
// the film is lower.
float3 mx_film_turned(float3 f0, float3 f, float ior)
{
    return (1.0 - 2.0 * step(sqrt(clamp(f0, 0.01, 0.99)), (float3)((ior - 1.0) / (ior + 1.0))))
        * sqrt(max(0.5 * f, 0.0));
}

// Reflectance, facing the viewer, of a film on an interface of colour f0.
float3 mx_film_schlick_facing(float3 f0, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float a = (1.0 - ior) / (1.0 + ior);
    float d = 0.012566372 * ior * film;
    float3 r = mx_film_turned(f0, f0, ior);
    float3 xyz = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        xyz[channel] += mx_film_light(a, float2(-r[channel], 0.0), d, i);
    }
    return clamp(mul(xyz, float3x3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338,
        0.0885814, 1.0093968)), 0.0, 1.0);
}

// Reflectance, facing the viewer, of an interface.
// Here model = "schlick".
float3 mx_fresnel_facing(float3 n, float film, float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick_facing(n, film, film_ior);
    return n;
}

// Factor of what lies below a coat: the coat's colour, and what bounces below it, of which the share K stays inside:
//     coat_color mix(1, (1 - K) / (1 - K E coat_color), coat_darkening), E the albedo of the base
// (OpenPBR Surface specification 1.2, "Darkening").
// Here coat_color = float3(1.0, 1.0, 1.0).
float3 mx_open_pbr_coat_darkening(float3 base_color, float base_metalness, float specular_weight,
    float subsurface_weight, float3 subsurface_color, float coat_ior, float coat_darkening)
{
    float kept = max(1.0 - 4.0 * coat_ior / ((coat_ior + 1.0) * (coat_ior + 1.0)) / (coat_ior * coat_ior), 0.0);
    return lerp(float3(1.0, 1.0, 1.0), (float3)(1.0 - kept)
        / (float3(1.0, 1.0, 1.0) - kept * lerp(lerp(base_color, subsurface_color, subsurface_weight),
        base_color * min(specular_weight, 1.0), base_metalness)), coat_darkening);
}

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here f90 = float3(1.0, 1.0, 1.0), exponent = 5.0.
float3 mx_fresnel_schlick(float cosine, float3 f0, float3 bend)
{
    float x = 1.0 - cosine;
    float x3 = x * x * x;
    return lerp(f0, float3(1.0, 1.0, 1.0), x3 * x * x) - bend * (cosine * x3 * x3);
}

// Amplitudes of a film's own interface, of perpendicular and parallel light; `inside` is the cosine in the film.
float2 mx_film_amplitudes(float cosine, float inside, float ior)
{
    float2 x = float2(cosine, ior * cosine);
    float2 u = float2(ior * inside, inside);
    return (x - u) / (x + u);
}

// Reflectance of a film on an interface with Schlick's curve.
// Here f90 = float3(1.0, 1.0, 1.0), exponent = 5.0.
float3 mx_film_schlick(float cosine, float3 f0, float3 bend, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    float2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    float3 r = mx_film_turned(f0, mx_fresnel_schlick(c, f0, bend), ior);
    float3 xyz = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        float below = r[channel];
        for (int p = 0; p < 2; ++p) {
            below = -below;
            xyz[channel] += mx_film_light(a[p], float2(below, 0.0), d, i);
        }
    }
    return clamp(mul(0.5 * xyz, float3x3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338,
        0.0885814, 1.0093968)), 0.0, 1.0);
}

// Reflectance of an interface at a cosine.
// Here model = "schlick", f90 = float3(1.0, 1.0, 1.0), exponent = 5.0.
float3 mx_fresnel(float cosine, float3 n, float3 k, float film, float film_ior)
{
    if (film > 0.0)
        return mx_film_schlick(cosine, n, k, film, film_ior);
    return mx_fresnel_schlick(cosine, n, k);
}

// Reflectance of a dielectric that faces the viewer.
float mx_fresnel_dielectric_facing(float ior)
{
    float r = (1.0 - ior) / (1.0 + ior);
    return r * r;
}

// Complex amplitude (x - u) / (x + u) of an interface in one polarisation: u is the index times the cosine behind it; x
// is the cosine for perpendicular light, and the permittivity times the cosine for parallel light.
float2 mx_film_amplitude(float2 x, float2 u)
{
    return float2(dot(x, x) - dot(u, u), 2.0 * (x.y * u.x - x.x * u.y)) / dot(x + u, x + u);
}

// The index times the cosine behind an interface, u + iv, from the cosine in front of it and the permittivity:
//     (u + iv)^2 = re + i im - sin^2
float2 mx_fresnel_refract(float cosine, float re, float im)
{
    float t = re + (cosine * cosine - 1.0);
    float norm = sqrt(t * t + im * im);
    return sqrt(max(0.5 * float2(norm + t, norm - t), 0.0));
}

// Reflectance, facing the viewer, of a film on an interface with the permittivity re + i im.
// Here im = float3(0.0, 0.0, 0.0).
float3 mx_film_index_facing(float3 re, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float a = (1.0 - ior) / (1.0 + ior);
    float d = 0.012566372 * ior * film;
    float3 xyz = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        xyz[channel] += mx_film_light(a,
            mx_film_amplitude(float2(1.0, 0.0), mx_fresnel_refract(1.0, re[channel] / (ior * ior), 0.0)), d, i);
    }
    return clamp(mul(xyz, float3x3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338,
        0.0885814, 1.0093968)), 0.0, 1.0);
}

// Reflectance, facing the viewer, of an interface.
// Here model = "dielectric", k = float3(0.0, 0.0, 0.0).
float3 mx_fresnel_facing_2(float3 n, float film, float film_ior)
{
    if (film > 0.0)
        return mx_film_index_facing(n * n, film, film_ior);
    return (float3)mx_fresnel_dielectric_facing(n.x);
}

// Reflectance of a film on an interface with the permittivity re + i im.
// Here im = float3(0.0, 0.0, 0.0).
float3 mx_film_index(float cosine, float3 re, float film, float film_ior)
{
    float ior = max(film_ior, 1.0);
    float c = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));
    float2 a = mx_film_amplitudes(cosine, c, ior);
    float d = 0.012566372 * ior * c * film;
    float3 xyz = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        int channel = max(i - 1, 0);
        float2 below = float2(re[channel], 0.0) / (ior * ior);
        float2 u = mx_fresnel_refract(c, below.x, below.y);
        float2 x = float2(c, 0.0);
        for (int p = 0; p < 2; ++p) {
            xyz[channel] += mx_film_light(a[p], mx_film_amplitude(x, u), d, i);
            x = c * below;
        }
    }
    return clamp(mul(0.5 * xyz, float3x3(2.3706744, -0.513885, 0.0052982, -0.9000405, 1.4253036, -0.0146949, -0.4706338,
        0.0885814, 1.0093968)), 0.0, 1.0);
}

// Reflectance of an interface at a cosine.
// Here model = "dielectric", k = float3(0.0, 0.0, 0.0), f90 = float3(1.0, 1.0, 1.0), exponent = 0.0.
float3 mx_fresnel(float cosine, float3 n, float film, float film_ior)
{
    if (film > 0.0)
        return mx_film_index(cosine, n * n, film, film_ior);
    return (float3)mx_fresnel_permittivity(cosine, n.x * n.x);
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(float sine, float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(float3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
float2 mx_map_point(float3 d)
{
    float square = mx_map_square(d);
    float stretch = rsqrt(square);
    return float2(frac((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

// The number of samples, from 1, that a lobe takes; roughness is that along two directions, squared.
int mx_sample_count(float2 roughness)
{
    float wide = max(roughness.x, roughness.y);
    float share = 0.5 * min(4.0 * sqrt(wide), 1.0);
    share = min(share * wide / min(roughness.x, roughness.y), 1.0);
    return max(int(ceil(share * float(u_envRadianceSamples))), 1);
}

// The GGX lobe of a surface as samples of the environment see it.
// Here is_round = false.
mx_GgxSamples mx_ggx_samples(float2 roughness, int count, float3 N, float3 X, float3 V)
{
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, X, V);
    float3 x = lobe.x;
    float3x3 frame = float3x3(x, cross(lobe.N, x), lobe.N);
    float3 v = float3(mul(frame, V).xy, lobe.cosine);
    float3 stretch = float3(lobe.alpha, 1.0);
    float reach = length(v * stretch);
    float area = stretch.x * stretch.y;
    float share = 1.0 / float(count);
    return make_mx_GgxSamples(mul(frame, (float3x3)u_envMatrix), stretch, area, v, lobe.masking, reach,
        share * (v.z + reach), area * (v.z + lobe.masking)
        * max(2.0 / float(count), 4.4 / float(max(u_envRadianceSamples, 1)))
        * exp2(2.0 * float(u_envRadianceMips) - 4.6485), u_envLightIntensity * (share * (v.z + lobe.masking)));
}

// Light of the environment from the unit direction d of its picture, filtered over as many texels.
float3 mx_filtered_light(float3 d, float texels)
{
    return u_envRadiance.SampleLevel(u_envRadiance_sampler, mx_map_point(d),
        0.5 * log2(texels * rsqrt(mx_map_square(d)))).xyz;
}

// Height-correlated masking and shadowing G2 over 2 cos_v cos_l (Heitz 2014, equation 99); `masking` is that of the
// viewer.
float mx_ggx_visibility(float cos_v, float masking, float area, float cos_l)
{
    return 1.0 / (cos_v * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * masking);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
float3 mx_ggx_cap(float2 around, float depth, float3 v, float reach)
{
    return v + float3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// The facet of sample i. Samples are spherical Fibonacci points (Marques et al. 2013): each is the golden angle further
// around than the one before, by its `turn`.
mx_GgxFacet mx_ggx_facet(mx_GgxSamples s, int i, float2 turn)
{
    float3 h = mx_ggx_cap(turn, (float(i) + 0.5) * s.step, s.v * s.stretch, s.reach) * s.stretch;
    float cosine = dot(s.v, h);
    float mirror = 2.0 * cosine / dot(h, h);
    return make_mx_GgxFacet(h, cosine, mirror, mirror * mirror * s.texels);
}

// The light that the facet of sample i reflects.
mx_GgxLight mx_ggx_reflected(mx_GgxSamples s, int i, float2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float3 l = facet.mirror * facet.h - s.v;
    float cos_l = max(l.z, 1e-8);
    return make_mx_GgxLight(mx_filtered_light(mul(l, s.to_map), facet.texels),
        s.weight * cos_l * mx_ggx_visibility(s.v.z, s.masking, s.area, cos_l),
        sqrt(clamp(0.5 * (facet.mirror * facet.cosine), 1e-8, 1.0)));
}

// The light that comes to the facet of sample i through a solid sphere of index `ior` behind it.
mx_GgxLight mx_ggx_transmitted(mx_GgxSamples s, float ior, int i, float2 turn)
{
    mx_GgxFacet facet = mx_ggx_facet(s, i, turn);
    float3 h = normalize(facet.h);
    return make_mx_GgxLight(mx_filtered_light(mul(reflect(s.v, refract(-s.v, h, 1.0 / ior)), s.to_map), facet.texels),
        s.weight * 0.5 / s.v.z, clamp(dot(s.v, h), 1e-8, 1.0));
}

// Light that arrives at a point of a circle of this curvature by subsurface scattering, where the cosine of the light
// is cos_l: Burley's normalised diffusion (Christensen 2015) around the circle (after Penner 2011, "Pre-integrated skin
// shading").
float mx_subsurface_light(float radius, float curvature, float cos_l)
{
    float x = curvature * max(radius, 0.1);
    float3 bend = (float3(0.1573, 0.0104, 0.1632)
        + x * (float3(0.662, 0.1732, 0.6079) + x * float3(0.6075, 0.4138, 0.8133)))
        / (6.2831855 * (0.1602 + x * (0.6652 + x)));
    return bend.x * cos_l + sqrt(bend.y * bend.y + (bend.z * bend.z - bend.y * bend.y) * (cos_l * cos_l));
}

// Light that arrives by subsurface scattering, with a radius for each channel.
float3 mx_subsurface_light(float3 radius, float curvature, float cos_l)
{
    float3 light = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 3; ++i)
        light[i] = mx_subsurface_light(radius[i], curvature, cos_l);
    return light;
}

// Directional albedo of Fujii's lobe of roughness r (Fujii 2012, "A tiny improvement of Oren-Nayar reflectance model").
float mx_fujii_albedo(float cosine, float r)
{
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float g = sine * (acos(min(cosine, 1.0)) - sine * cosine)
        + 0.6666667 * (sine / cosine * (1.0 - sine * sine * sine) - sine);
    return (1.0 + r * g / 3.1415927) / (1.0 + 0.28779334 * r);
}

// Albedo of the light that Fujii's lobe scatters more than once, relative to `color`; `mean` is the mean albedo of the
// lobe.
float3 mx_fujii_multiple(float3 color, float mean)
{
    return color * mean / (1.0 - color * max(1.0 - mean, 0.0));
}

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    float coat_weight = SR_open_pbr_surface_coat_weight;
    float coating_weight = clamp(coat_weight, 0.0, 1.0);
    float coat_ior = SR_open_pbr_surface_coat_ior;
    float coat_transmittance = coat_ior * 4.0 / ((coat_ior + 1.0) * (coat_ior + 1.0));
    float3 N = normalize(vd.normalWorld);
    float3 V = normalize(u_viewPosition - vd.positionWorld);
    float absolute = abs(dot(N, V));
    float3 color = SR_open_pbr_surface_emission_luminance
        * (SR_open_pbr_surface_emission_color
        * (1.0 - coating_weight + SR_open_pbr_surface_coat_color
        * (coating_weight * (coat_transmittance * (1.0 - pow(1.0 - min(absolute, 1.0), 5.0))))));
    // lights: fuzz, coating, metal_film, metal_bare, reflection_film, reflection_bare
    float fuzz_weight = clamp(SR_open_pbr_surface_fuzz_weight, 0.0, 1.0);
    float3 Nf = faceforward(N, -V, N);
    float cos_v = max(absolute, 1e-8);
    float limited_cos_v = min(cos_v, 1.0);
    float fuzz_r = clamp(SR_open_pbr_surface_fuzz_roughness, 0.01, 1.0);
    float width = fuzz_r * (fuzz_r * 1.58491 + 0.0206607) / (fuzz_r * (fuzz_r + 1.32227) + 0.0379424);
    float x = (cos_v - fuzz_r * (fuzz_r * (fuzz_r * (1.7932 - fuzz_r * (fuzz_r * 0.95943)) - 1.14885) - 0.193854)
        / (fuzz_r + 0.046391)) / width;
    float fuzz_ratio = exp(x * (x * -0.5)) / (width * 2.5066283);
    float fuzz_product = fuzz_r * (fuzz_r * (fuzz_r * 0.119681 - 0.0207818) + 0.000654023);
    float fuzz_product_2 = fuzz_weight * max(fuzz_ratio + fuzz_product / (fuzz_r * (fuzz_r - 1.92021) + 1.26264), 0.0);
    float3 fuzz_factor = SR_open_pbr_surface_fuzz_color * fuzz_product_2;
    float2 coat_lobe = mx_open_pbr_anisotropy(SR_open_pbr_surface_coat_roughness,
        SR_open_pbr_surface_coat_roughness_anisotropy);
    float3 X = normalize(vd.tangentWorld);
    mx_GgxLobe coating_lobe = mx_ggx_lobe(coat_lobe, N, X, V);
    float coating_r = (1.0 - coat_ior) / (coat_ior + 1.0);
    float2 coating_alpha = clamp(coat_lobe, 1e-8, 1.0);
    float2 coating_albedo = mx_ggx_albedo_fit(sqrt(coating_alpha.x * coating_alpha.y), cos_v);
    float coating_scale = lerp(coating_r * coating_r, 1.0, 0.04761905) * (1.0 / coating_albedo.x - 1.0) + 1.0;
    float coating_factor = coating_scale * (coating_weight * (1.0 - fuzz_product_2));
    float clamped_specular_weight = clamp(SR_open_pbr_surface_specular_weight, 0.0, 1.0);
    float clamped_thin_film_weight = clamp(SR_open_pbr_surface_thin_film_weight, 0.0, 1.0);
    float metal_weight = clamp(SR_open_pbr_surface_base_metalness, 0.0, 1.0);
    float metal_film_weight = clamped_specular_weight * (clamped_thin_film_weight * metal_weight);
    float2 roughness = mx_open_pbr_anisotropy(lerp(SR_open_pbr_surface_specular_roughness,
        mx_open_pbr_blurred(SR_open_pbr_surface_specular_roughness, SR_open_pbr_surface_coat_roughness), coat_weight),
        SR_open_pbr_surface_specular_roughness_anisotropy);
    float2 alpha = clamp(roughness, 1e-8, 1.0);
    float2 albedo = mx_ggx_albedo_fit(sqrt(alpha.x * alpha.y), cos_v);
    float lost = 1.0 / albedo.x - 1.0;
    float3 fresnel_facing = max(SR_open_pbr_surface_base_weight * SR_open_pbr_surface_base_color, 0.0);
    float film_thickness = SR_open_pbr_surface_thin_film_thickness * 1000.0;
    float thin_film_ior = SR_open_pbr_surface_thin_film_ior;
    float3 clamped_darkened = clamp(mx_open_pbr_coat_darkening(SR_open_pbr_surface_base_color,
        SR_open_pbr_surface_base_metalness, SR_open_pbr_surface_specular_weight, SR_open_pbr_surface_subsurface_weight,
        SR_open_pbr_surface_subsurface_color, coat_ior, coat_weight * SR_open_pbr_surface_coat_darkening), 0.0, 1.0);
    float coated_weight = (1.0 - fuzz_product_2)
        * (1.0 - coating_weight * (lerp(coating_r * coating_r, 1.0, coating_albedo.y) * coating_albedo.x
        * coating_scale));
    float3 substrate_weight = clamped_darkened
        * (clamp(lerp(float3(1.0, 1.0, 1.0), SR_open_pbr_surface_coat_color, coat_weight), 0.0, 1.0) * coated_weight);
    float3 metal_film_factor = (lost * lerp(mx_fresnel_facing(fresnel_facing, film_thickness, thin_film_ior),
        float3(1.0, 1.0, 1.0), 0.04761905) + float3(1.0, 1.0, 1.0)) * (substrate_weight * metal_film_weight);
    float3 limited_specular_color = max(SR_open_pbr_surface_specular_color, 0.0);
    float3 schlick_bend = lerp(fresnel_facing, float3(1.0, 1.0, 1.0), 0.4626644)
        * (float3(1.0, 1.0, 1.0) - limited_specular_color) * 17.651384;
    mx_GgxLobe lobe = mx_ggx_lobe(roughness, N, X, V);
    float metal_bare_weight = clamped_specular_weight * (metal_weight * (1.0 - clamped_thin_film_weight));
    float3 metal_bare_factor = (lost * lerp(fresnel_facing, float3(1.0, 1.0, 1.0), 0.04761905) + float3(1.0, 1.0, 1.0))
        * (substrate_weight * metal_bare_weight);
    float reflection_film_weight = clamped_thin_film_weight * (1.0 - metal_weight);
    float ior_relative = lerp(SR_open_pbr_surface_specular_ior,
        max(SR_open_pbr_surface_specular_ior / coat_ior, coat_ior / SR_open_pbr_surface_specular_ior), coat_weight);
    float amplitude = clamp((ior_relative - 1.0) / (ior_relative + 1.0) * sqrt(SR_open_pbr_surface_specular_weight),
        -0.999995, 0.999995);
    float ior = (amplitude + 1.0) / (1.0 - amplitude);
    float3 reflection_film_scale = lerp(mx_fresnel_facing_2((float3)ior, film_thickness, thin_film_ior),
        float3(1.0, 1.0, 1.0), 0.04761905) * lost + float3(1.0, 1.0, 1.0);
    float3 reflection_film_factor = substrate_weight * reflection_film_weight
        * (reflection_film_scale * limited_specular_color);
    float reflection_bare_weight = (1.0 - metal_weight) * (1.0 - clamped_thin_film_weight);
    float r = (1.0 - ior) / (ior + 1.0);
    float reflection_bare_scale = lost * lerp(r * r, 1.0, 0.04761905) + 1.0;
    float3 reflection_bare_factor = reflection_bare_scale
        * (limited_specular_color * (substrate_weight * reflection_bare_weight));
    float scaled_ior = ior * ior;
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            float3 d = u_lightData[i].position - vd.positionWorld;
            float3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float spot_light_edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(spot_light_edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light))
                    * falloff : 0.0;
            }
        }
        // fuzz
        float3 light_color = u_lightData[i].color;
        if (fuzz_weight > 0.0)
            color += light_color * (intensity * (mx_sheen_zeltner(Nf, V, L, limited_cos_v, fuzz_r) * fuzz_factor));
        // coating
        float half_cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        if (coating_weight > 0.0) {
            float coating_product = mx_fresnel_permittivity(half_cosine, coat_ior * coat_ior) * coating_factor;
            color += light_color * (intensity * (mx_ggx_light(coating_lobe, V, L) * coating_product));
        }
        // metal_film
        float ggx_light = mx_ggx_light(lobe, V, L);
        if (metal_film_weight > 0.0)
            color += light_color * (intensity
                * (metal_film_factor * (mx_fresnel(half_cosine, fresnel_facing, schlick_bend, film_thickness,
                thin_film_ior) * ggx_light)));
        // metal_bare
        if (metal_bare_weight > 0.0)
            color += light_color * (intensity
                * (metal_bare_factor * (ggx_light * mx_fresnel_schlick(half_cosine, fresnel_facing, schlick_bend))));
        // reflection_film
        if (reflection_film_weight > 0.0)
            color += light_color * (intensity
                * (reflection_film_factor
                * (ggx_light * mx_fresnel(half_cosine, (float3)ior, film_thickness, thin_film_ior))));
        // reflection_bare
        if (reflection_bare_weight > 0.0)
            color += light_color * (intensity
                * (reflection_bare_factor * (ggx_light * mx_fresnel_permittivity(half_cosine, scaled_ior))));
    }
    // environment: fuzz
    float3 part = u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
        mx_map_point(normalize(mul(Nf, (float3x3)u_envMatrix))), 0.0).xyz;
    float envLightIntensity = u_envLightIntensity;
    if (fuzz_weight > 0.0)
        color += SR_open_pbr_surface_fuzz_color * part * (fuzz_product_2 * envLightIntensity);
    // environment: coating
    if (coating_weight > 0.0) {
        float2 turn = float2(1.0, 0.0);
        int coating_count = mx_sample_count(coating_alpha);
        mx_GgxSamples coating_ggx_samples = mx_ggx_samples(coat_lobe, coating_count, N, X, V);
        for (int i = 0; i < coating_count; ++i) {
            mx_GgxLight coating_light = mx_ggx_reflected(coating_ggx_samples, i, turn);
            color += coating_light.color
                * (mx_fresnel_permittivity(coating_light.cosine, coat_ior * coat_ior)
                * (coating_factor * coating_light.weight));
            turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
        }
    }
    // environment: metal_film, metal_bare, reflection_film, reflection_bare
    int count = mx_sample_count(alpha);
    mx_GgxSamples samples = mx_ggx_samples(roughness, count, N, X, V);
    if (reflection_bare_weight > 0.0 || reflection_film_weight > 0.0 || metal_film_weight > 0.0
        || metal_bare_weight > 0.0) {
        if (film_thickness > 0.0) {
            float2 turn = float2(1.0, 0.0);
            for (int i = 0; i < count; ++i) {
                mx_GgxLight light = mx_ggx_reflected(samples, i, turn);
                if (metal_film_weight > 0.0)
                    color += metal_film_factor
                        * (light.color * (light.weight
                        * mx_film_schlick(light.cosine, fresnel_facing, schlick_bend, film_thickness, thin_film_ior)));
                if (metal_bare_weight > 0.0)
                    color += metal_bare_factor
                        * (light.color * (light.weight
                        * mx_fresnel_schlick(light.cosine, fresnel_facing, schlick_bend)));
                if (reflection_film_weight > 0.0)
                    color += reflection_film_factor
                        * (light.color * (light.weight
                        * mx_film_index(light.cosine, (float3)scaled_ior, film_thickness, thin_film_ior)));
                if (reflection_bare_weight > 0.0)
                    color += reflection_bare_factor
                        * (light.color * (light.weight * mx_fresnel_permittivity(light.cosine, scaled_ior)));
                turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        } else {
            float2 turn = float2(1.0, 0.0);
            for (int i = 0; i < count; ++i) {
                mx_GgxLight light = mx_ggx_reflected(samples, i, turn);
                float3 product = light.color
                    * (light.weight * mx_fresnel_schlick(light.cosine, fresnel_facing, schlick_bend));
                color += metal_bare_factor * product + metal_film_factor * product;
                float3 product_2 = light.color * (light.weight * mx_fresnel_permittivity(light.cosine, scaled_ior));
                if (reflection_film_weight > 0.0)
                    color += reflection_film_factor * product_2;
                if (reflection_bare_weight > 0.0)
                    color += reflection_bare_factor * product_2;
                turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        }
    }
    // environment: refraction_film, refraction_bare
    float clamped_transmission_weight = clamp(SR_open_pbr_surface_transmission_weight, 0.0, 1.0);
    float filled_weight = clamped_transmission_weight * (1.0 - metal_weight);
    bool refraction_film_visible = clamped_thin_film_weight * filled_weight > 0.0;
    float refraction_bare_weight = filled_weight * (1.0 - clamped_thin_film_weight);
    float single = lerp(r * r, 1.0, albedo.y) * albedo.x;
    float3 body_weight = lerp((float3)(1.0 - single * reflection_bare_scale),
        float3(1.0, 1.0, 1.0) - single * reflection_film_scale, clamped_thin_film_weight) * substrate_weight;
    if (refraction_film_visible || refraction_bare_weight > 0.0) {
        float3 tint = max(SR_open_pbr_surface_transmission_depth > 0.0 ? float3(1.0, 1.0, 1.0)
            : SR_open_pbr_surface_transmission_color, 0.0);
        float3 absorbed = -(SR_open_pbr_surface_transmission_scatter + log(SR_open_pbr_surface_transmission_color))
            / SR_open_pbr_surface_transmission_depth;
        float3 product = exp(-(SR_open_pbr_surface_transmission_depth > 0.0
            ? absorbed - min(min(min(absorbed.x, absorbed.y), absorbed.z), 0.0) : float3(0.0, 0.0, 0.0))) * tint;
        float3 product_2 = (u_refractionTwoSided ? tint : float3(1.0, 1.0, 1.0)) * product;
        float3 refraction_film_factor = body_weight * (clamped_thin_film_weight * filled_weight) * product_2;
        float3 refraction_bare_factor = product_2 * (body_weight * refraction_bare_weight);
        if (film_thickness > 0.0) {
            float2 turn = float2(1.0, 0.0);
            for (int i = 0; i < count; ++i) {
                mx_GgxLight light = mx_ggx_transmitted(samples, ior, i, turn);
                if (refraction_film_visible)
                    color += refraction_film_factor
                        * (light.color * (light.weight
                        * (float3(1.0, 1.0, 1.0)
                        - mx_film_index(light.cosine, (float3)scaled_ior, film_thickness, thin_film_ior))));
                if (refraction_bare_weight > 0.0)
                    color += refraction_bare_factor
                        * (light.color * (light.weight * (1.0 - mx_fresnel_permittivity(light.cosine, scaled_ior))));
                turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        } else {
            float2 turn = float2(1.0, 0.0);
            for (int i = 0; i < count; ++i) {
                mx_GgxLight light = mx_ggx_transmitted(samples, ior, i, turn);
                float3 product_3 = light.color
                    * (light.weight * (1.0 - mx_fresnel_permittivity(light.cosine, scaled_ior)));
                if (refraction_film_visible)
                    color += refraction_film_factor * product_3;
                if (refraction_bare_weight > 0.0)
                    color += refraction_bare_factor * product_3;
                turn = float2(-turn.y, turn.x) * 0.6754903 - turn * 0.7373689;
            }
        }
    }
    // lights: sheet_front, sheet_back, scatter, diffuse
    float3 subsurface_positive = max(SR_open_pbr_surface_subsurface_color, 0.0);
    float clamped_backward_share = clamp((1.0 - SR_open_pbr_surface_subsurface_scatter_anisotropy) * 0.5, 0.0, 1.0);
    float thin = float(SR_open_pbr_surface_geometry_thin_walled);
    float clamped_subsurface_weight = clamp(SR_open_pbr_surface_subsurface_weight, 0.0, 1.0);
    float opaque_weight = (1.0 - metal_weight) * (1.0 - clamped_transmission_weight);
    float sheet_weight = thin * (clamped_subsurface_weight * opaque_weight);
    float3 sheet_front_product = subsurface_positive * (body_weight * (clamped_backward_share * sheet_weight));
    float base_diffuse_roughness = SR_open_pbr_surface_base_diffuse_roughness;
    float2 ab = base_diffuse_roughness * base_diffuse_roughness * float2(-0.5, 0.45)
        / (base_diffuse_roughness * base_diffuse_roughness + float2(0.33, 0.09)) + float2(1.0, 0.0);
    float sheet_back_weight = sheet_weight * (1.0 - clamped_backward_share);
    float3 sheet_back_factor = subsurface_positive * (body_weight * sheet_back_weight);
    float scatter_weight = clamped_subsurface_weight * opaque_weight * (1.0 - thin);
    float3 scatter_factor = subsurface_positive * (body_weight * scatter_weight);
    float3 scatter_radius = SR_open_pbr_surface_subsurface_radius * SR_open_pbr_surface_subsurface_radius_scale;
    float curvature = max(length(fwidth(Nf)) / max(length(fwidth(vd.positionWorld)), 1e-20), 0.01);
    float diffuse_weight = clamp(SR_open_pbr_surface_base_weight, 0.0, 1.0)
        * (opaque_weight * (1.0 - clamped_subsurface_weight));
    float3 base_positive = max(SR_open_pbr_surface_base_color, 0.0);
    float3 diffuse_product = base_positive * (body_weight * diffuse_weight);
    float diffuse_sum = base_diffuse_roughness * 0.28779334 + 1.0;
    float mean = (base_diffuse_roughness * 0.0724882 + 1.0) / diffuse_sum;
    float3 fujii_multiple = base_positive * mean / (float3(1.0, 1.0, 1.0) - base_positive * max(1.0 - mean, 0.0));
    float diffuse_fujii_albedo = mx_fujii_albedo(cos_v, base_diffuse_roughness);
    float lost_v = max(1.0 - diffuse_fujii_albedo, 1e-8);
    float diffuse_lost = max(1.0 - mean, 1e-8);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L;
        float intensity;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            float3 d = u_lightData[i].position - vd.positionWorld;
            float3 to_light = normalize(d);
            L = to_light;
            float falloff = u_lightData[i].intensity / pow(length(d) + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
            } else {
                float spot_light_edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? falloff * smoothstep(spot_light_edge, u_lightData[i].inner_angle,
                    -dot(u_lightData[i].direction, to_light)) : 0.0;
            }
        }
        // sheet_front, sheet_back
        float3 light_color = u_lightData[i].color;
        float cos_l = dot(Nf, L);
        float cos_l_2 = max(cos_l, 1e-8);
        float s = dot(V, L) - cos_v * cos_l_2;
        float greater = max(cos_l_2, cos_v);
        float3 sheet_front_response = sheet_front_product * 0.31830987
            * (cos_l_2 * (ab.x + ab.y * max(s, 0.0) / greater));
        color += light_color * (intensity
            * (sheet_front_response + sheet_back_factor * (max(-cos_l, 0.0) / 3.1415927)));
        // scatter
        if (scatter_weight > 0.0)
            color += light_color * (intensity
                * (scatter_factor * mx_subsurface_light(scatter_radius, curvature, cos_l)));
        // diffuse
        if (diffuse_weight > 0.0) {
            float diffuse_s = s / greater;
            float3 diffuse_product_2 = fujii_multiple
                * (lost_v * max(1.0 - mx_fujii_albedo(cos_l_2, base_diffuse_roughness), 1e-8) / diffuse_lost);
            color += light_color * (intensity
                * (diffuse_product * 0.31830987
                * (cos_l_2 * ((base_diffuse_roughness * (s > 0.0 ? diffuse_s : s) + 1.0) / diffuse_sum
                + diffuse_product_2))));
        }
    }
    // environment: sheet_front, scatter
    float2 fit = base_diffuse_roughness * (cos_v * float2(-0.7632, -0.4993) - float2(0.4297, 0.6076)
        + base_diffuse_roughness * float2(1.4385, 2.0315)) + float2(1.0, 1.0);
    float3 sheet_front_response = sheet_front_product * part * (envLightIntensity * clamp(fit.x / fit.y, 0.0, 1.0));
    color += sheet_front_response + envLightIntensity * (scatter_factor * part);
    // environment: sheet_back
    if (sheet_back_weight > 0.0)
        color += envLightIntensity * (sheet_back_factor
            * u_envIrradiance.SampleLevel(u_envIrradiance_sampler,
            mx_map_point(normalize(mul(-Nf, (float3x3)u_envMatrix))), 0.0).xyz);
    // environment: diffuse
    if (diffuse_weight > 0.0)
        color += envLightIntensity * (lerp(mx_fujii_multiple(base_positive, mean), float3(1.0, 1.0, 1.0),
            diffuse_fujii_albedo) * (diffuse_product * part));
    // opacity
    float opacity = clamp(SR_open_pbr_surface_geometry_opacity, 0.0, 1.0);
    if (opacity < u_alphaThreshold)
        discard;
    out1 = float4(opacity * color, opacity);
}
