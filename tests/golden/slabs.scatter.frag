#version 450
// wet_metal · slab_surface · mxgen 0.1 · glsl · reduced · 7 closures · 0 textures

uniform int u_numActiveLightSources = 0;
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
struct VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
    vec3 viewWorld;
    vec4 random;
    vec4 lightWorld;
    vec2 matter;
};
VertexData vd;
vec4 out1;
vec4 out2;
vec4 out3;
vec4 out4;
vec4 out5;
vec4 out6;
vec4 out7;
vec4 out9;
vec4 out10;
vec4 out11;
vec4 out12;

// A polynomial of two variables, what directional albedos are fitted by (the programs in fits/).
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The program fits/ggx.c makes the constants. x is never too small by more than 0.001, so that giving lost energy back
// adds none. `u` follows what happens where light grazes the facets.
vec2 mx_ggx_albedo_fit(const float a, const float u, const float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(mat4(-0.2006, 5.2916, -3.7565, 0.218, -10.2439, 6.6203, -0.9657, 2.5694,
        38.3042, -80.8059, 71.731, -28.5214, -34.2, 89.1079, -88.4065, 33.782), u, a), 0.0, 1.0);
    return vec2(min(1.0046 - u * mx_bicubic(mat4(-0.1447, 2.759, -5.4314, 2.8497, -0.9366, 1.4766, 0.5911, -1.0905,
        11.8506, -30.2645, 27.3289, -8.9414, -4.3199, 8.2596, -3.1648, -0.8054), u, a), 1.0), x * x * x * x * x);
}

vec3 mx_fresnel_schlick(const float cosine, const vec3 f0)
{
    float x = 1.0 - cosine;
    return mix(f0, vec3(1.0), x * x * x * x * x);
}

// Distribution of normals (Burley 2012, appendix B.2, equation 13) at a normal that is stretched to that of a unit
// sphere; `area` is the product of the roughness along x and y.
float mx_ggx_distribution(const vec3 e, const float area)
{
    return 1.0 / (3.1415927 * area * dot(e, e) * dot(e, e));
}

// Solid angle of normals for that of refracted directions (Walter et al. 2007, equation 17).
float mx_refraction_jacobian(const vec3 v, const vec3 l, const vec3 h)
{
    float cos_l = dot(l, h);
    float sum = dot(v, h) + 1.5 * cos_l;
    return 2.25 * abs(cos_l) / (sum * sum);
}

float mx_ggx_smith_visibility(const vec3 v, const vec3 l, const vec2 alpha)
{
    return 0.5 * l.z / (v.z * length(vec3(l.xy * alpha, l.z)) + l.z * length(vec3(v.xy * alpha, v.z)));
}

// What a white lobe reflects at the viewer's cosine c (x), and the mean of Schlick's (1 - cos)^5 over it (y).
vec2 mx_ggx_albedo(const vec2 roughness, const float c)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    float a = sqrt(alpha.x * alpha.y);
    return mx_ggx_albedo_fit(a, a / (a + c), c);
}

// A normal of those visible from v, which is stretched by the roughness and has length `reach`, at any length (Dupuy
// and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"): (cos, sin) of its turn around z, and how far
// it lies below the top of the cap, v.z + reach at most.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 v, const float reach)
{
    return v + vec3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// A normal of those visible from v.
vec3 mx_ggx_visible(const vec2 alpha, const vec3 v, const vec2 xi)
{
    vec3 stretch = vec3(alpha, 1.0);
    float reach = length(vec3(v.xy * alpha, v.z));
    return normalize(mx_ggx_cap(cos(6.2831855 * (xi.x - vec2(0.0, 0.25))), xi.y * (v.z + reach), v * stretch, reach)
        * stretch);
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

// What mx_ggx_eval and mx_ggx_refracted are over mx_ggx_pdf, without the numbers that become huge where the surface is
// smooth.
void mx_ggx_scatter(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V, const vec3 xi, const vec3 n,
    out vec3 L, out vec3 weight, out float pdf)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 h = mx_ggx_visible(alpha, v, xi.xy);
    float cos_h = clamp(dot(v, h), 1e-8, 1.0);
    vec3 f = mx_fresnel_schlick(cos_h, n);
    float share = 1.0;
    bool is_reflected = xi.z < share;
    vec3 l = is_reflected ? reflect(-v, h) : refract(-v, h, 0.6666667);
    float density = 2.0 / (v.z + length(vec3(v.xy * alpha, v.z)));
    L = frame * l;
    weight = vec3(0.0);
    pdf = 0.0;
    if (is_reflected ? l.z <= 0.0 : l.z >= 0.0)
        return;
    if (is_reflected) {
        weight = f * (mx_ggx_smith_visibility(v, l, alpha) * 4.0 / (density * share))
            * (vec3(1.0) + mix(n, vec3(1.0), vec3(0.04761905)) * (1.0 / mx_ggx_albedo(roughness, v.z).x - 1.0));
        pdf = 0.25 * share;
    } else {
        weight = (vec3(1.0) - f) * (2.0 / ((-l).z + length(vec3((-l).xy * alpha, (-l).z))) * -l.z / (1.0 - share));
        pdf = (1.0 - share) * cos_h * mx_refraction_jacobian(v, l, h);
    }
    pdf *= density * mx_ggx_distribution(h / vec3(alpha, 1.0), alpha.x * alpha.y);
}

// What the layer of the medium reflects and lets through, with all orders of scattering, of light on a way x.
vec3 mx_medium_layer(const float way, out vec3 transmitted)
{
    float x = way - 1.0;
    vec3 s = vec3(0.49529448, 0.49895358, 0.49975267) * way
        * (vec3(1.0) + 0.16666666 * (vec3(0.043278337, 0.052829146, 0.054919362) + x
        * vec3(-0.18317366, -0.19314766, -0.19532585)));
    vec3 k = vec3(0.009411037, 0.0020928383, 0.000494659) * way
        * (vec3(1.0) + vec3(0.16509815, 0.16631785, 0.16658421)
        * (vec3(1.3360909, 1.3377652, 1.3381231) + x * vec3(-1.792952, -1.8079973, -1.8112832)
        + vec3(0.0739174, 0.07612604, 0.07661489)));
    vec3 g = sqrt(k * (k + 2.0 * s));
    vec3 e = exp(-g * 0.2);
    vec3 ways = mix((vec3(1.0) - e * e) / max(g, vec3(1e-6)), 0.4 * (vec3(1.0) - g * 0.2), step(g * 0.2, vec3(0.001)));
    vec3 below = (k + s) * ways + vec3(1.0) + e * e;
    transmitted = 2.0 * e / below;
    return s * ways / below;
}

vec3 mx_medium_reflected(const float way)
{
    vec3 ignored;
    return mx_medium_layer(way, ignored);
}

float mx_way(const vec3 N, const vec3 V)
{
    float c = dot(N, V);
    return 1.5 * inversesqrt(1.25 + c * c);
}

// Reciprocal, with the albedo of the viewer's way.
vec3 mx_slab_thin_light(const vec3 N, const vec3 V, const vec3 L)
{
    return mx_medium_reflected(mx_way(N, V)) / vec3(0.10193972, 0.102937125, 0.103155464)
        * (mx_medium_reflected(mx_way(N, L)) * (max(dot(faceforward(N, -V, N), L), 0.0) / 3.1415927));
}

float mx_ggx_smith_lobe(const vec2 roughness, const mat3 frame, const vec3 V, const vec3 L)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    return mx_ggx_distribution(normalize(V + L) * frame / vec3(alpha, 1.0), alpha.x * alpha.y)
        * mx_ggx_smith_visibility(max(V * frame, vec3(-1.0, -1.0, 1e-8)), max(L * frame, vec3(-1.0, -1.0, 1e-8)),
        alpha);
}

// Normal of the facet that refracts l, below the horizon, towards v (Walter et al. 2007, equation 16).
vec3 mx_refracting_normal(const vec3 v, const vec3 l)
{
    vec3 h = normalize(v + 1.5 * l);
    return h.z < 0.0 ? -h : h;
}

float mx_ggx_pdf(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V, const vec3 L)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 l = L * frame;
    bool is_reflected = l.z > 0.0;
    vec3 h = is_reflected ? normalize(v + l) : mx_refracting_normal(v, l);
    float cos_h = dot(v, h);
    if (cos_h <= 0.0 || !is_reflected && dot(l, h) >= 0.0)
        return 0.0;
    float share = 1.0;
    return 2.0 / (v.z + length(vec3(v.xy * alpha, v.z))) * mx_ggx_distribution(h / vec3(alpha, 1.0), alpha.x * alpha.y)
        * (is_reflected ? 0.25 * share : (1.0 - share) * cos_h * mx_refraction_jacobian(v, l, h));
}

void scatter()
{
    float pick = 0.0;
    vec3 L = vec3(0.0);
    float inside = 0.0;
    vec3 weight = vec3(0.0);
    float density = 0.0;
    vec3 medium = vec3(1.0);
    L = -vd.viewWorld;
    inside = 2.0;
    weight = vec3(1.0);
    bool is_below = vd.matter.x < 0.0;
    bool drops_is_below = vd.matter.y < 0.5;
    float choice = is_below ? drops_is_below ? 0.0 : 2.0 : vd.matter.x;
    vec3 N = normalize(vd.normalWorld);
    // metal
    float c = dot(N, vd.viewWorld);
    float cos_v = max(abs(c), 1e-8);
    // coat
    vec2 coat_reflection_albedo = mx_ggx_albedo_fit(0.01, 0.01 / (cos_v + 0.01), cos_v);
    float coat_reflection_ggx_compensation = (1.0 / coat_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    vec3 coat_reflection_slab_reflection_bsdf_albedo = mx_fresnel_schlick(max(1.0 - pow(coat_reflection_albedo.y, 0.2),
        1e-8), vec3(0.04)) * (coat_reflection_albedo.x * coat_reflection_ggx_compensation);
    vec3 coat_reflection_throughput = max(vec3(1.0) - coat_reflection_slab_reflection_bsdf_albedo, 0.0);
    float sum = dot(coat_reflection_slab_reflection_bsdf_albedo, vec3(0.33333334)) * 0.9 + 0.1;
    float greater = max(dot(coat_reflection_throughput, vec3(0.33333334)), 0.0);
    float sum_2 = sum + greater;
    vec3 X = normalize(vd.tangentWorld);
    if (choice == 0.0) {
        weight = coat_reflection_throughput * (sum_2 / greater);
        if (sum_2 * vd.random.w < sum) {
            vec3 coat_reflection_L, coat_reflection_weight;
            float coat_reflection_pdf;
            mx_ggx_scatter(vec2(0.01), N, X, vd.viewWorld, vd.random.xyz, vec3(0.04), coat_reflection_L,
                coat_reflection_weight, coat_reflection_pdf);
            L = coat_reflection_L;
            inside = 0.0;
            weight = coat_reflection_weight * (sum_2 / sum);
            density = coat_reflection_pdf * (sum / sum_2);
        }
    }
    bool is_equal = choice == 1.0;
    // milk
    float way = inversesqrt(c * c + 1.25) * 1.5;
    vec3 N_2 = faceforward(N, -vd.viewWorld, N);
    mat3 any_frame = mx_frame(N_2, abs(N_2.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    vec2 product = sqrt(vd.random.x) * cos((vd.random.y - vec2(0.0, 0.25)) * 6.2831855);
    vec3 L_2 = any_frame * vec3(product, sqrt(1.0 - vd.random.x));
    float pdf = max(dot(N_2, L_2), 0.0) / 3.1415927;
    if (is_equal) {
        vec3 coat_medium_throughput = exp(way * vec3(-0.05, -0.033333335, -0.025));
        float greater_2 = max(dot(coat_medium_throughput, vec3(0.33333334)), 0.0);
        weight = coat_medium_throughput * ((greater_2 + 0.1) / greater_2);
        if (vd.random.w * (greater_2 + 0.1) < 0.1) {
            L = L_2;
            inside = 0.0;
            weight = vec3(0.0);
            density = pdf * (0.1 / (greater_2 + 0.1));
        }
    }
    vec2 milk_reflection_albedo = mx_ggx_albedo_fit(0.25071993, 0.25071993 / (cos_v + 0.25071993), cos_v);
    float milk_reflection_ggx_compensation = (1.0 / milk_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    vec3 milk_reflection_slab_reflection_bsdf_albedo = mx_fresnel_schlick(max(1.0 - pow(milk_reflection_albedo.y, 0.2),
        1e-8), vec3(0.04)) * (milk_reflection_albedo.x * milk_reflection_ggx_compensation);
    vec3 milk_reflection_throughput = max(vec3(1.0) - milk_reflection_slab_reflection_bsdf_albedo, 0.0);
    float sum_3 = dot(milk_reflection_slab_reflection_bsdf_albedo, vec3(0.33333334)) * 0.9 + 0.1;
    float greater_3 = max(dot(milk_reflection_throughput, vec3(0.33333334)), 0.0);
    float sum_4 = sum_3 + greater_3;
    if (choice == 3.0) {
        weight = milk_reflection_throughput * (sum_4 / greater_3);
        if (vd.random.w * sum_4 < sum_3) {
            vec3 milk_reflection_L, milk_reflection_weight;
            float milk_reflection_pdf;
            mx_ggx_scatter(vec2(0.25071993), N, X, vd.viewWorld, vd.random.xyz, vec3(0.04), milk_reflection_L,
                milk_reflection_weight, milk_reflection_pdf);
            L = milk_reflection_L;
            inside = 0.0;
            weight = milk_reflection_weight * (sum_4 / sum_3);
            density = milk_reflection_pdf * (sum_3 / sum_4);
        }
    }
    bool is_equal_2 = choice == 4.0;
    vec2 metal_reflection_albedo = mx_ggx_albedo_fit(0.29886922, 0.29886922 / (cos_v + 0.29886922), cos_v);
    const vec3 metal_constant = vec3(0.9, 0.6, 0.3);
    vec3 metal_reflection_ggx_compensation = (1.0 / metal_reflection_albedo.x - 1.0)
        * vec3(0.9047619, 0.61904764, 0.33333334) + vec3(1.0);
    vec3 metal_reflection_slab_reflection_bsdf_albedo = mx_fresnel_schlick(max(1.0
        - pow(metal_reflection_albedo.y, 0.2), 1e-8), metal_constant) * metal_reflection_albedo.x
        * metal_reflection_ggx_compensation;
    if (is_equal_2) {
        vec3 milk_medium_transmitted;
        vec3 milk_medium = mx_medium_layer(way, milk_medium_transmitted);
        vec3 milk_medium_throughput = milk_medium_transmitted
            / (vec3(1.0) - min(metal_reflection_slab_reflection_bsdf_albedo
            * vec3(0.10193972, 0.102937125, 0.103155464), 0.999));
        float sum_5 = dot(milk_medium, vec3(0.33333334)) * 0.9 + 0.1;
        float greater_4 = max(dot(milk_medium_throughput, vec3(0.33333334)), 0.0);
        float sum_6 = sum_5 + greater_4;
        weight = milk_medium_throughput * (sum_6 / greater_4);
        if (vd.random.w * sum_6 < sum_5) {
            L = L_2;
            inside = 0.0;
            weight = mx_slab_thin_light(N, vd.viewWorld, L_2) / max(pdf, 1e-8) * (sum_6 / sum_5);
            density = pdf * (sum_5 / sum_6);
        }
    }
    vec3 metal_reflection_throughput = max(vec3(1.0) - metal_reflection_slab_reflection_bsdf_albedo, 0.0);
    float sum_7 = dot(metal_reflection_slab_reflection_bsdf_albedo, vec3(0.33333334)) * 0.9 + 0.1;
    float greater_5 = max(dot(metal_reflection_throughput, vec3(0.33333334)), 0.0);
    float sum_8 = sum_7 + greater_5;
    if (choice == 5.0) {
        weight = metal_reflection_throughput * (sum_8 / greater_5);
        if (vd.random.w * sum_8 < sum_7) {
            vec3 metal_reflection_L, metal_reflection_weight;
            float metal_reflection_pdf;
            mx_ggx_scatter(vec2(0.29886922), N, X, vd.viewWorld, vd.random.xyz, metal_constant, metal_reflection_L,
                metal_reflection_weight, metal_reflection_pdf);
            L = metal_reflection_L;
            inside = 0.0;
            weight = metal_reflection_weight * (sum_8 / sum_7);
            density = metal_reflection_pdf * (sum_7 / sum_8);
        }
    }
    if (choice == 6.0) {
        weight = vec3(0.0);
        if (vd.random.w * 0.1 < 0.1) {
            L = L_2;
            inside = 0.0;
            weight = vec3(0.0);
            density = pdf;
        }
    }
    out1 = vec4(choice == 2.0 ? vec3(0.0, 0.1, 0.0) : vec3(0.0), 1.0);
    out2 = vec4(L, inside);
    out3 = vec4(weight, density);
    out4 = vec4(medium, 0.0);
    float cosine = sqrt(clamp(dot(vd.viewWorld, vd.lightWorld.xyz) * 0.5 + 0.500001, 0.0, 1.0));
    vec3 fresnel = mx_fresnel_schlick(cosine, vec3(0.04));
    mat3 frame = mx_frame(N_2, X);
    float sum_9 = vd.lightWorld.w * (sum / sum_2 * mx_ggx_pdf(vec2(0.01), N, X, vd.viewWorld, vd.lightWorld.xyz)) + 1.0;
    vec3 ratio = fresnel * (coat_reflection_ggx_compensation
        * mx_ggx_smith_lobe(vec2(0.01), frame, vd.viewWorld, vd.lightWorld.xyz)) / sum_9;
    float c_2 = dot(N, vd.lightWorld.xyz);
    float way_2 = inversesqrt(c_2 * c_2 + 1.25) * 1.5;
    const vec3 coat_medium_constant = vec3(0.05, 0.033333335, 0.025);
    vec3 choice_2 = drops_is_below ? coat_medium_constant : vec3(0.0);
    float sum_10 = vd.lightWorld.w * (sum_3 / sum_4
        * mx_ggx_pdf(vec2(0.25071993), N, X, vd.viewWorld, vd.lightWorld.xyz)) + 1.0;
    vec3 ratio_2 = fresnel * (milk_reflection_ggx_compensation
        * mx_ggx_smith_lobe(vec2(0.25071993), frame, vd.viewWorld, vd.lightWorld.xyz)) / sum_10;
    float metal_reflection_ggx_smith_lobe = mx_ggx_smith_lobe(vec2(0.29886922), frame, vd.viewWorld, vd.lightWorld.xyz);
    float sum_11 = vd.lightWorld.w * (sum_7 / sum_8
        * mx_ggx_pdf(vec2(0.29886922), N, X, vd.viewWorld, vd.lightWorld.xyz)) + 1.0;
    vec3 ratio_3 = metal_reflection_ggx_compensation * mx_fresnel_schlick(cosine, metal_constant)
        * metal_reflection_ggx_smith_lobe / sum_11;
    vec3 choice_3 = is_equal_2 ? vec3(1.0) : choice == 5.0 ? ratio_3 * exp(-(way_2 * (choice_2 + vec3(0.2))))
        : vec3(0.0);
    vec3 choice_4 = is_equal ? vec3(1.0) : choice == 2.0 ? vec3(0.0) : choice == 3.0 ? exp(-(way_2 * choice_2))
        * ratio_2 : choice_3;
    out5 = vec4(choice == 0.0 ? ratio : choice_4, 0.0);
    float chance = fract(vd.random.w * 4096.0);
    float sum_12 = 0.0;
    vec3 light = vec3(0.0);
    vec3 L_3 = vec3(0.0);
    float distance_ = 0.0;
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L_4;
        float intensity;
        int light_type = u_lightData[i].type;
        vec3 d = u_lightData[i].position - vd.positionWorld;
        float magnitude_d = length(d);
        if (light_type == 1) {
            L_4 = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
        } else {
            vec3 to_light = normalize(d);
            L_4 = to_light;
            float ratio_4 = u_lightData[i].intensity / pow(magnitude_d + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = ratio_4;
            } else {
                float spot_light_difference = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(spot_light_difference, u_lightData[i].inner_angle,
                    -dot(u_lightData[i].direction, to_light)) * ratio_4 : 0.0;
            }
        }
        float cosine_2 = sqrt(clamp(dot(vd.viewWorld, L_4) * 0.5 + 0.500001, 0.0, 1.0));
        vec3 fresnel_2 = mx_fresnel_schlick(cosine_2, vec3(0.04));
        vec3 coat_reflection_slab_reflection_bsdf_eval = coat_reflection_ggx_compensation * fresnel_2
            * mx_ggx_smith_lobe(vec2(0.01), frame, vd.viewWorld, L_4);
        float c_3 = dot(N, L_4);
        float way_3 = inversesqrt(c_3 * c_3 + 1.25) * 1.5;
        vec3 milk_reflection_slab_reflection_bsdf_eval = milk_reflection_ggx_compensation * fresnel_2
            * mx_ggx_smith_lobe(vec2(0.25071993), frame, vd.viewWorld, L_4);
        vec3 metal_reflection_product = metal_reflection_ggx_compensation
            * mx_fresnel_schlick(cosine_2, metal_constant);
        vec3 metal_reflection_slab_reflection_bsdf_eval = metal_reflection_product
            * mx_ggx_smith_lobe(vec2(0.29886922), frame, vd.viewWorld, L_4);
        vec3 choice_5 = is_equal_2 ? vec3(1.0) : choice == 5.0 ? metal_reflection_slab_reflection_bsdf_eval
            * exp(-((choice_2 + vec3(0.2)) * way_3)) : vec3(0.0);
        vec3 choice_6 = is_equal ? vec3(1.0) : choice == 2.0 ? vec3(0.0) : choice == 3.0 ? exp(-(choice_2 * way_3))
            * milk_reflection_slab_reflection_bsdf_eval : choice_5;
        vec3 product_2 = u_lightData[i].color * intensity
            * (choice == 0.0 ? coat_reflection_slab_reflection_bsdf_eval : choice_6);
        float greater_6 = max(dot(product_2, vec3(0.33333334)), 0.0);
        sum_12 += greater_6;
        if (sum_12 * chance < greater_6) {
            L_3 = L_4;
            distance_ = light_type == 1 ? 1e30 : light_type == 2 ? magnitude_d : light_type == 3 ? magnitude_d : 1e30;
            light = product_2 / greater_6;
        }
        if (greater_6 > 0.0) {
            float ratio_5 = (sum_12 * chance - greater_6) / (sum_12 - greater_6);
            chance = sum_12 * chance < greater_6 ? sum_12 * chance / greater_6 : ratio_5;
        }
    }
    out6 = vec4(L_3, distance_);
    out7 = vec4(sum_12 * light, 0.0);
    out9 = vec4(is_equal ? vec3(0.0) : is_equal_2 ? vec3(0.19811778, 0.19958141, 0.19990106) : vec3(0.0), 0.0);
    float choice_7 = choice < 2.0 ? 2.0 : choice < 3.0 ? 3.0 : choice < 4.0 ? 4.0 : choice < 5.0 ? 5.0 : choice < 6.0
        ? 6.0 : -1.0;
    float choice_8 = drops_is_below && choice < 1.0 ? 1.0 : choice_7;
    float choice_9 = drops_is_below && choice < 0.0 ? 0.0 : choice_8;
    out10 = vec4(is_equal ? coat_medium_constant : is_equal_2 ? vec3(0.2) : vec3(0.0), choice_9);
    vec3 choice_10 = drops_is_below ? (drops_is_below ? is_below ? coat_reflection_throughput : vec3(1.0) : vec3(1.0))
        * exp(-(way * coat_medium_constant)) : vec3(1.0);
    vec3 product_3 = choice_10 * (is_below ? milk_reflection_throughput : vec3(1.0)) * exp(-vec3(way * 0.2));
    float choice_11 = choice > 4.0 ? 4.0 : drops_is_below && choice > 1.0 ? 1.0 : -1.0;
    out11 = vec4(product_3 * (is_below ? metal_reflection_throughput : vec3(1.0)) * (is_below ? vec3(0.0) : vec3(1.0)),
        choice_11);
    out12 = vec4(0.0, 0.0, 0.0, -2.0);
}
