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
struct LightData {
    int type;
    vec3 direction;
    vec3 color;
    float intensity;
};
uniform LightData u_lightData[1];
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

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 N = normalize(vd.normalWorld);
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    float cos_v = max(abs(dot(N, V)), 1e-8);
    vec2 albedo = mx_ggx_albedo_fit(cos_v);
    float ggx_compensation = (1.0 / albedo.x - 1.0) * 0.079748526 + 1.0;
    vec3 facing = faceforward(N, -V, N);
    float ggx_masking = sqrt(cos_v * cos_v * 0.9984 + 0.0016);
    mx_GgxLobe coat_ggx_lobe = mx_GgxLobe(facing, cos_v, vec3(0.0), vec2(0.04), ggx_masking);
    vec3 paint_factor = (1.0 - mix(0.03373595, 1.0, albedo.y) * albedo.x * ggx_compensation) * 0.75 * 0.31830987
        * vec3(0.6, 0.1, 0.05);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 1) - 1; i >= 0; --i) {
        // coat, paint
        float light_intensity = u_lightData[i].intensity;
        vec3 L = -u_lightData[i].direction;
        float v_dot_l = dot(V, L);
        float coat_product = ggx_compensation
            * mx_fresnel_permittivity(sqrt(clamp(v_dot_l * 0.5 + 0.500001, 0.0, 1.0)));
        float cos_l = max(dot(L, facing), 1e-8);
        vec3 paint_response = paint_factor
            * (cos_l * (max(v_dot_l - cos_v * cos_l, 0.0) * 0.225 / max(cos_l, cos_v) + 0.89285713));
        vec3 response = coat_product * mx_ggx_light(coat_ggx_lobe, V, L) + paint_response;
        color += u_lightData[i].color * ((u_lightData[i].type == 1 ? light_intensity : 0.0) * response);
    }
    out1 = vec4(color, 1.0);
}
