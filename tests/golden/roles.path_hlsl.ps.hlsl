// Tile · surfacematerial · mxgen 0.1 · hlsl · reduced · 2 closures · 0 textures
// shader model 6.0

cbuffer PrivateUniforms : register(b0)
{
    row_major float4x4 u_worldMatrix : packoffset(c0);
    row_major float4x4 u_worldInverseTransposeMatrix : packoffset(c4);
    row_major float4x4 u_viewProjectionMatrix : packoffset(c8);
    float3 u_viewPosition : packoffset(c12);
    int u_numActiveLightSources : packoffset(c12.w);
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
struct VertexData {
    float4 position : SV_Position;
    float3 positionWorld : TEXCOORD0;
    float3 normalWorld : TEXCOORD1;
    float3 tangentWorld : TEXCOORD2;
};

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
float3x3 mx_frame(float3 N, float3 X)
{
    float3x3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
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
// Here alpha = float2(0.2, 0.2).
float mx_ggx_smith_visibility(float3 v, float3 l)
{
    return 0.5 * l.z / (v.z * length(float3(l.xy * 0.2, l.z)) + l.z * length(float3(v.xy * 0.2, v.z)));
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
// Here roughness = float2(0.2, 0.2).
float mx_ggx_smith_lobe(float3x3 frame, float3 V, float3 L)
{
    return mx_ggx_distribution(mul(frame, normalize(V + L)) / float3(0.2, 0.2, 1.0))
        * mx_ggx_smith_visibility(max(mul(frame, V), float3(-1.0, -1.0, 1e-8)),
        max(mul(frame, L), float3(-1.0, -1.0, 1e-8)));
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

void main(
    VertexData vd,
    out float4 out1 : SV_Target0)
{
    float3 color = float3(0.0, 0.0, 0.0);
    // lights
    float3 N = normalize(vd.normalWorld);
    float3 V = normalize(u_viewPosition - vd.positionWorld);
    float3 facing = faceforward(N, -V, N);
    float3x3 glaze_frame = mx_frame(facing, normalize(vd.tangentWorld));
    float n_dot_v = dot(N, V);
    float index_ahead = n_dot_v < 0.0 ? 0.6666667 : 1.5;
    float r = (1.0 - index_ahead) / (index_ahead + 1.0);
    float2 albedo = mx_ggx_albedo_fit(max(abs(n_dot_v), 1e-8));
    float ggx_compensation = lerp(r * r, 1.0, 0.04761905) * (1.0 / albedo.x - 1.0) + 1.0;
    float3 clay_factor = (1.0 - mx_fresnel_permittivity(max(1.0 - pow(albedo.y, 0.2), 1e-8), index_ahead * index_ahead)
        * albedo.x * ggx_compensation * 0.8) * 0.31830987 * float3(0.6, 0.3, 0.2);
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
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
            }
        }
        // glaze, clay
        float half_cosine = sqrt(clamp(dot(V, L) * 0.5 + 0.500001, 0.0, 1.0));
        float glaze_product = mx_fresnel_permittivity(half_cosine, index_ahead * index_ahead)
            * (ggx_compensation * 0.8);
        float glaze_response = mx_ggx_smith_lobe(glaze_frame, V, L) * glaze_product;
        color += u_lightData[i].color * (intensity * (glaze_response + max(dot(L, facing), 1e-8) * clay_factor));
    }
    out1 = float4(color, 1.0);
}
