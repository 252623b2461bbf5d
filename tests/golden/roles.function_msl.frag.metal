// Tile · surfacematerial · mxgen 0.1 · msl · reduced · 2 closures · 0 textures

#include <metal_stdlib>
using namespace metal;

struct mx_GgxLobe {
    float3 N;
    float cosine;
    float3 x;
    float2 alpha;
    float masking;
};
struct PrivateUniforms {
    float3 u_viewPosition;
};
struct Surface {
    float3 color;
    float alpha;
};

// The square of the length of the facet's normal H after the roughness divided its parts along the surface, times the
// product of the roughness along x and y; cos_h is its part along N.
// Here is_round = true, is_wide = true.
float mx_ggx_stretched(mx_GgxLobe lobe, float cos_h, float square)
{
    return square - (1.0 - lobe.alpha.x * lobe.alpha.y) * (cos_h * cos_h);
}

// The GGX lobe towards the light L, without Fresnel's factor: distribution, visibility and the cosine over one divisor.
// Here is_round = true, is_wide = true.
float mx_ggx_light(mx_GgxLobe lobe, float3 V, float3 L)
{
    float area = lobe.alpha.x * lobe.alpha.y;
    float cos_l = max(dot(lobe.N, L), 1e-8);
    float square = 2.0 + 2.0 * dot(V, L);
    float e = mx_ggx_stretched(lobe, lobe.cosine + dot(lobe.N, L), square);
    return area / 6.2831855 * square * square * cos_l
        / (e * e * (lobe.cosine * sqrt(area + (1.0 - area) * (cos_l * cos_l)) + cos_l * lobe.masking));
}

// Unpolarised reflectance of an interface whose squared index is `re`, with c for the cosine in front of it:
//     F = ((c - g)^2 / (c + g)^2) (1 + (cg - s)^2 / (cg + s)^2) / 2
//     s = 1 - c^2,  g^2 = c^2 + 2k,  2k = re - 1
// Here re = 2.25.
float mx_fresnel_permittivity(float cosine)
{
    float c2 = cosine * cosine;
    float s = 1.0 - c2;
    float cg2 = c2 * (c2 + 1.25);
    float r = 0.625 / (1.625 * (c2 + sqrt(cg2)) + 0.625);
    return (cg2 + s * s) * (r * r);
}

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

struct GlobalContext {
    constant PrivateUniforms& u_prv;
    MxgHost mxg_host;

Surface surface(float3 positionWorld, float3 normalWorld)
{
    Surface result;
    float3 color = float3(0.0);
    // lights
    float3 N = normalize(normalWorld);
    float3 V = normalize(u_prv.u_viewPosition - positionWorld);
    float3 facing = faceforward(N, -V, N);
    float cos_v = max(abs(dot(N, V)), 1e-8);
    float ggx_masking = sqrt(cos_v * cos_v * 0.96 + 0.04);
    mx_GgxLobe glaze_ggx_lobe = mx_GgxLobe{facing, cos_v, float3(0.0), float2(0.2), ggx_masking};
    float2 albedo = mx_ggx_albedo_fit(cos_v);
    float ggx_compensation = (1.0 / albedo.x - 1.0) * 0.08571429 + 1.0;
    float3 clay_factor = (1.0 - mix(0.04, 1.0, albedo.y) * albedo.x * ggx_compensation * 0.8) * 0.31830987
        * float3(0.6, 0.3, 0.2);
    // from the last light, so that drivers do not unroll the loop
    for (int i = mxg_host.mxg_light_count() - 1; i >= 0; --i) {
        // glaze, clay
        float3 light_L, light_radiance;
        mxg_host.mxg_light(i, positionWorld, light_L, light_radiance);
        float glaze_product = mx_fresnel_permittivity(sqrt(clamp(dot(V, light_L) * 0.5 + 0.500001, 0.0, 1.0)))
            * (ggx_compensation * 0.8);
        float glaze_response = mx_ggx_light(glaze_ggx_lobe, V, light_L) * glaze_product;
        color += light_radiance * (glaze_response + max(dot(light_L, facing), 1e-8) * clay_factor);
    }
    result.color = color;
    result.alpha = 1.0;
    return result;
}
};
