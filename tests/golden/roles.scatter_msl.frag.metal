// Tile · surfacematerial · mxgen 0.1 · msl · reduced · 2 closures · 0 textures
// Metal Shading Language 2.3
#include <metal_stdlib>
using namespace metal;

struct PrivateUniforms {
    int u_numActiveLightSources;
};
struct alignas(16) LightData {
    float3 direction;
    float3 color;
    float3 position;
    int type;
    float intensity;
    float decay_rate;
    float inner_angle;
    float outer_angle;
};
struct LightData_pixel {
    LightData u_lightData[3];
};
struct VertexData {
    float3 positionWorld;
    float3 normalWorld;
    float3 tangentWorld;
    float3 viewWorld;
    float4 random;
    float4 lightWorld;
};
struct PixelOutputs {
    float4 out1;
    float4 out2;
    float4 out3;
    float4 out4;
    float4 out5;
    float4 out6;
    float4 out7;
};

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(float4x4 m, float x, float y)
{
    return dot(float4(1.0, x, x * x, x * x * x), m * float4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
// Here a = 0.2.
float2 mx_ggx_albedo_fit(float c)
{
    float x = clamp(1.0 - c - 0.2 * mx_bicubic(float4x4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225,
        -0.0277, 36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), 0.2 / (0.2 + c), 0.2), 0.0,
        1.0);
    float u = 0.2 / (0.2 + 0.6 * c);
    return float2(min(1.0017 - u * u * mx_bicubic(float4x4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238,
        8.7382, 4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, 0.2 * c), 1.0),
        x * x * x * x * x);
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

// GGX distribution of normals, at a normal that the roughness stretched to e; `area` is the product of the roughness
// along x and y (Burley 2012, appendix B.2, equation 13).
// Here area = 0.04.
float mx_ggx_distribution(float3 e)
{
    return 1.0 / (0.12566371 * dot(e, e) * dot(e, e));
}

// Masking and shadowing of the directions v and l over 4 cos_v, each with the roughness in its direction (Heitz 2014,
// equations 80 and 99).
// Here alpha = float2(0.2).
float mx_ggx_smith_visibility(float3 v, float3 l)
{
    return 0.5 * l.z / (v.z * length(float3(l.xy * 0.2, l.z)) + l.z * length(float3(v.xy * 0.2, v.z)));
}

// Reflectance of a dielectric that faces the viewer.
float mx_fresnel_dielectric_facing(float ior)
{
    float r = (1.0 - ior) / (1.0 + ior);
    return r * r;
}

// Factor that gives back the light of multiple scattering (Turquin 2019, equations 14 and 16).
// Here model = "dielectric", k = float3(0.0), f90 = float3(1.0), film = 0.0, film_ior = 1.5.
float3 mx_ggx_compensation(float2 albedo, float3 n)
{
    return 1.0 + mix(float3(mx_fresnel_dielectric_facing(n.x)), float3(1.0), 0.04761905) * (1.0 / albedo.x - 1.0);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
float3 mx_ggx_cap(float2 around, float depth, float3 v, float reach)
{
    return v + float3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// A unit normal of those visible from v, from two random numbers xi.
// Here alpha = float2(0.2).
float3 mx_ggx_visible(float3 v, float2 xi)
{
    float3 stretch = float3(0.2, 0.2, 1.0);
    float reach = length(float3(v.xy * 0.2, v.z));
    return normalize(mx_ggx_cap(cos(6.2831855 * (xi.x - float2(0.0, 0.25))), xi.y * (v.z + reach), v * stretch, reach)
        * stretch);
}

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
float3x3 mx_frame(float3 N, float3 X)
{
    float3x3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

// A direction L that the lobe reflects or refracts light from, by three random numbers xi, with the value over the
// density (`weight`) and the density (`pdf`).
// Here roughness = float2(0.2), by_direction = false, mode = 1, model = "dielectric", k = float3(0.0),
// f90 = float3(1.0), exponent = 0.0, film = 0.0, film_ior = 1.5.
void mx_ggx_scatter(float3 N, float3 X, float3 V, float3 xi, float3 n, thread float3& L, thread float3& weight,
    thread float& pdf)
{
    float3x3 frame = mx_frame(faceforward(N, -V, N), X);
    float3 v = max(V * frame, float3(-1.0, -1.0, 1e-8));
    float3 h = mx_ggx_visible(v, xi.xy);
    float3 l = reflect(-v, h);
    float density = 2.0 / (v.z + length(float3(v.xy * 0.2, v.z)));
    L = frame * l;
    weight = float3(0.0);
    pdf = 0.0;
    if (l.z <= 0.0)
        return;
    weight = float3(mx_fresnel_permittivity(clamp(dot(v, h), 1e-8, 1.0), n.x * n.x))
        * (mx_ggx_smith_visibility(v, l) * 4.0 / density) * mx_ggx_compensation(mx_ggx_albedo_fit(v.z), n);
    pdf = 0.25;
    pdf *= density * mx_ggx_distribution(h / float3(0.2, 0.2, 1.0));
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
// Here roughness = float2(0.2).
float mx_ggx_smith_lobe(float3x3 frame, float3 V, float3 L)
{
    return mx_ggx_distribution(normalize(V + L) * frame / float3(0.2, 0.2, 1.0))
        * mx_ggx_smith_visibility(max(V * frame, float3(-1.0, -1.0, 1e-8)), max(L * frame, float3(-1.0, -1.0, 1e-8)));
}

// Density of the directions L that mx_ggx_scatter takes.
// Here roughness = float2(0.2), mode = 1, model = "dielectric", k = float3(0.0), f90 = float3(1.0), exponent = 0.0,
// film = 0.0, film_ior = 1.5.
float mx_ggx_pdf(float3 N, float3 X, float3 V, float3 L)
{
    float3x3 frame = mx_frame(faceforward(N, -V, N), X);
    float3 v = max(V * frame, float3(-1.0, -1.0, 1e-8));
    float3 l = L * frame;
    if (l.z <= 0.0)
        return 0.0;
    float3 h = normalize(v + l);
    if (dot(v, h) <= 0.0)
        return 0.0;
    return 2.0 / (v.z + length(float3(v.xy * 0.2, v.z))) * mx_ggx_distribution(h / float3(0.2, 0.2, 1.0)) * 0.25;
}

struct GlobalContext {
    constant LightData_pixel& u_lightData;
    constant PrivateUniforms& u_prv;
    VertexData vd;
    PixelOutputs out;

void scatter()
{
    float3 N = normalize(vd.normalWorld);
    float n_dot_lobe_view = dot(N, vd.viewWorld);
    float2 albedo = mx_ggx_albedo_fit(max(abs(n_dot_lobe_view), 1e-8));
    float eta = n_dot_lobe_view < 0.0 ? 0.6666667 : 1.5;
    float scaled_eta = eta * eta;
    float r = (1.0 - eta) / (eta + 1.0);
    float ggx_compensation = mix(r * r, 1.0, 0.04761905) * (1.0 / albedo.x - 1.0) + 1.0;
    float dielectric_bsdf_albedo = mx_fresnel_permittivity(max(1.0 - pow(albedo.y, 0.2), 1e-8), scaled_eta) * albedo.x
        * ggx_compensation;
    float glaze_share = max((dielectric_bsdf_albedo * 0.9 + 0.1) * 0.8, 0.0);
    float glaze_throughput = 1.0 - dielectric_bsdf_albedo * 0.8;
    float clay_share = max(dot(glaze_throughput * float3(0.64, 0.37, 0.28), float3(0.33333334)), 0.0);
    float shares = glaze_share + clay_share;
    float pick = shares * vd.random.w;
    float3 L = float3(0.0);
    float inside = 0.0;
    float3 weight = float3(0.0);
    float density = 0.0;
    float3 medium = float3(1.0);
    float3 X = normalize(vd.tangentWorld);
    if (pick >= 0.0 && pick < glaze_share) {
        float3 glaze_L, glaze_weight;
        float glaze_pdf;
        mx_ggx_scatter(N, X, vd.viewWorld, vd.random.xyz, float3(eta), glaze_L, glaze_weight, glaze_pdf);
        L = glaze_L;
        weight = glaze_weight * (shares / glaze_share * 0.8);
        bool is_in_front = n_dot_lobe_view * dot(N, glaze_L) > 0.0;
        inside = is_in_front ? 0.0 : 1.0;
        density = is_in_front ? glaze_pdf * (glaze_share / shares) : 0.0;
    }
    pick -= glaze_share;
    float3 facing = faceforward(N, -vd.viewWorld, N);
    const float3 clay_constant = float3(0.6, 0.3, 0.2);
    if (pick >= 0.0 && pick < clay_share) {
        float3x3 any_frame = mx_frame(facing, abs(facing.x) < 0.7 ? float3(1.0, 0.0, 0.0) : float3(0.0, 1.0, 0.0));
        float2 polar = sqrt(vd.random.x) * cos((vd.random.y - float2(0.0, 0.25)) * 6.2831855);
        float3 clay_L = any_frame * float3(polar, sqrt(1.0 - vd.random.x));
        L = clay_L;
        float facing_dot_clay_l = dot(facing, clay_L);
        float pdf = max(facing_dot_clay_l, 0.0) / 3.1415927;
        float3 clay_weight = max(facing_dot_clay_l, 1e-8) * 0.31830987 * clay_constant / max(pdf, 1e-8);
        weight = clay_weight * (glaze_throughput * (shares / clay_share));
        density = pdf * (clay_share / shares);
    }
    out.out1 = float4(0.0, 0.0, 0.0, 1.0);
    out.out2 = float4(L, inside);
    out.out3 = float4(weight, density);
    out.out4 = float4(medium, 0.0);
    float glaze_product = ggx_compensation
        * mx_fresnel_permittivity(sqrt(clamp(dot(vd.viewWorld, vd.lightWorld.xyz) * 0.5 + 0.500001, 0.0, 1.0)),
        scaled_eta);
    float3x3 frame = mx_frame(facing, X);
    float glaze_both = vd.lightWorld.w * (glaze_share / shares * mx_ggx_pdf(N, X, vd.viewWorld, vd.lightWorld.xyz))
        + 1.0;
    float3 balanced = float3(glaze_product * mx_ggx_smith_lobe(frame, vd.viewWorld, vd.lightWorld.xyz) * 0.8
        / glaze_both);
    float3 glaze_response = n_dot_lobe_view * dot(N, vd.lightWorld.xyz) > 0.0 ? balanced : float3(0.0);
    float facing_dot_l = dot(facing, vd.lightWorld.xyz);
    float clay_both = vd.lightWorld.w * (clay_share / shares * (max(facing_dot_l, 0.0) / 3.1415927)) + 1.0;
    out.out5 = float4(glaze_response + glaze_throughput * (max(facing_dot_l, 1e-8) * 0.31830987) * clay_constant
        / clay_both, 0.0);
    float chance = fract(vd.random.w * 4096.0);
    float brightness_sum = 0.0;
    float3 light = float3(0.0);
    float3 light_L = float3(0.0);
    float light_distance = 0.0;
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_prv.u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        float3 L_2;
        float intensity;
        float away;
        int light_type = u_lightData.u_lightData[i].type;
        if (light_type == 1) {
            L_2 = -u_lightData.u_lightData[i].direction;
            intensity = u_lightData.u_lightData[i].intensity;
            away = 1e30;
        } else {
            float3 d = u_lightData.u_lightData[i].position - vd.positionWorld;
            float3 to_light = normalize(d);
            L_2 = to_light;
            float magnitude_d = length(d);
            float falloff = u_lightData.u_lightData[i].intensity
                / pow(magnitude_d + 1.0, u_lightData.u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
                away = magnitude_d;
            } else {
                float edge = min(u_lightData.u_lightData[i].inner_angle, u_lightData.u_lightData[i].outer_angle)
                    - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData.u_lightData[i].inner_angle,
                    -dot(u_lightData.u_lightData[i].direction, to_light)) * falloff : 0.0;
                away = magnitude_d;
            }
        }
        float glaze_product_2 = ggx_compensation
            * mx_fresnel_permittivity(sqrt(clamp(dot(vd.viewWorld, L_2) * 0.5 + 0.500001, 0.0, 1.0)), scaled_eta);
        float3 glaze_vector = float3(glaze_product_2 * mx_ggx_smith_lobe(frame, vd.viewWorld, L_2) * 0.8);
        float3 clay_product = glaze_throughput * (max(dot(facing, L_2), 1e-8) * 0.31830987) * clay_constant;
        float3 response = (n_dot_lobe_view * dot(N, L_2) > 0.0 ? glaze_vector : float3(0.0)) + clay_product;
        float3 lit = u_lightData.u_lightData[i].color * intensity * response;
        float brightness = max(dot(lit, float3(0.33333334)), 0.0);
        brightness_sum += brightness;
        if (brightness_sum * chance < brightness) {
            light_L = L_2;
            light_distance = away;
            light = lit / brightness;
        }
        if (brightness > 0.0) {
            float ratio = (brightness_sum * chance - brightness) / (brightness_sum - brightness);
            chance = brightness_sum * chance < brightness ? brightness_sum * chance / brightness : ratio;
        }
    }
    out.out6 = float4(light_L, light_distance);
    out.out7 = float4(brightness_sum * light, 0.0);
}
};
