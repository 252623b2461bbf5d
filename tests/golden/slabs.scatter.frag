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

// A cubic polynomial of x and y with the coefficients m, to which directional albedos are fitted.
float mx_bicubic(const mat4 m, const float x, const float y)
{
    return dot(vec4(1.0, x, x * x, x * x * x), m * vec4(1.0, y, y * y, y * y * y));
}

// The light that a white GGX lobe of roughness a reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5
// over it (y).
vec2 mx_ggx_albedo_fit(const float a, const float c)
{
    float x = clamp(1.0 - c - a * mx_bicubic(mat4(-0.2174, 5.3819, -3.911, 0.2674, -9.7298, 3.9904, 3.8225, -0.0277,
        36.4897, -72.9122, 58.0878, -20.917, -31.4763, 79.0768, -73.9706, 26.5429), a / (a + c), a), 0.0, 1.0);
    float u = a / (a + 0.6 * c);
    return vec2(min(1.0017 - u * u * mx_bicubic(mat4(-0.0334, 3.1441, -6.1576, 3.0758, 0.6997, 7.8981, -14.3238, 8.7382,
        4.8322, -19.1128, 28.6679, -19.7386, -8.5929, 45.206, -83.1538, 52.7528), u, a * c), 1.0), x * x * x * x * x);
}

// Schlick's curve from f0 to f90 at a cosine, less `bend` times cos (1 - cos)^6.
// Here bend = vec3(0.0), f90 = vec3(1.0), exponent = 5.0.
vec3 mx_fresnel_schlick(const float cosine, const vec3 f0)
{
    float x = 1.0 - cosine;
    return mix(f0, vec3(1.0), x * x * x * x * x);
}

// GGX distribution of normals, at a normal that the roughness stretched to e; `area` is the product of the roughness
// along x and y (Burley 2012, appendix B.2, equation 13).
float mx_ggx_distribution(const vec3 e, const float area)
{
    return 1.0 / (3.1415927 * area * dot(e, e) * dot(e, e));
}

// Masking and shadowing of the directions v and l over 4 cos_v, each with the roughness in its direction (Heitz 2014,
// equations 80 and 99).
float mx_ggx_smith_visibility(const vec3 v, const vec3 l, const vec2 alpha)
{
    return 0.5 * l.z / (v.z * length(vec3(l.xy * alpha, l.z)) + l.z * length(vec3(v.xy * alpha, v.z)));
}

// The light that a white GGX lobe reflects at the viewer's cosine c (x), and the mean of (1 - cos)^5 over it (y).
vec2 mx_ggx_albedo(const vec2 roughness, const float c)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    return mx_ggx_albedo_fit(sqrt(alpha.x * alpha.y), c);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 v, const float reach)
{
    return v + vec3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// A unit normal of those visible from v, from two random numbers xi.
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

// A direction L that the lobe reflects or refracts light from, by three random numbers xi, with the value over the
// density (`weight`) and the density (`pdf`).
// Here by_direction = false, eta = 1.5, mode = 1, model = "schlick", k = vec3(0.0), f90 = vec3(1.0), exponent = 5.0,
// film = 0.0, film_ior = 1.5.
void mx_ggx_scatter(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V, const vec3 xi, const vec3 n,
    out vec3 L, out vec3 weight, out float pdf)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 h = mx_ggx_visible(alpha, v, xi.xy);
    vec3 l = reflect(-v, h);
    float density = 2.0 / (v.z + length(vec3(v.xy * alpha, v.z)));
    L = frame * l;
    weight = vec3(0.0);
    pdf = 0.0;
    if (l.z <= 0.0)
        return;
    weight = mx_fresnel_schlick(clamp(dot(v, h), 1e-8, 1.0), n) * (mx_ggx_smith_visibility(v, l, alpha) * 4.0 / density)
        * (vec3(1.0) + mix(n, vec3(1.0), vec3(0.04761905)) * (1.0 / mx_ggx_albedo(roughness, v.z).x - 1.0));
    pdf = 0.25;
    pdf *= density * mx_ggx_distribution(h / vec3(alpha, 1.0), alpha.x * alpha.y);
}

// Light that the layer of a medium reflects and lets through (`transmitted`), with all orders of scattering, on a way:
// a is the albedo of one scattering, t the optical depth (after Kubelka and Munk 1931).
// Here a = vec3(0.990589, 0.99790716, 0.99950534), t = vec3(0.2).
vec3 mx_medium_layer(const float way, out vec3 transmitted)
{
    float x = way - 1.0;
    vec3 s = vec3(0.49529448, 0.49895358, 0.49975267) * way
        * (vec3(1.0) + 0.16666666 * (vec3(0.043278337, 0.052829146, 0.054919362)
        + x * vec3(-0.18317366, -0.19314766, -0.19532585)));
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

// Light that the layer of a medium reflects on a way.
// Here color = vec3(0.8, 0.9, 0.95), mean_free_path = vec3(0.1), g = 0.0, thickness = 0.02.
vec3 mx_medium_reflected(const float way)
{
    vec3 ignored;
    return mx_medium_layer(way, ignored);
}

// How far light goes through a medium of index 1.5, over the thickness, on its way to or from V.
float mx_way(const vec3 N, const vec3 V)
{
    float c = dot(N, V);
    return 1.5 * inversesqrt(1.25 + c * c);
}

// Reciprocal, with the albedo of the viewer's way.
// Here color = vec3(0.8, 0.9, 0.95), mean_free_path = vec3(0.1), phase_anisotropy = 0.0, thickness = 0.02.
vec3 mx_slab_thin_light(const vec3 N, const vec3 V, const vec3 L)
{
    return mx_medium_reflected(mx_way(N, V)) / vec3(0.10193972, 0.102937125, 0.103155464)
        * (mx_medium_reflected(mx_way(N, L)) * (max(dot(faceforward(N, -V, N), L), 0.0) / 3.1415927));
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
float mx_ggx_smith_lobe(const vec2 roughness, const mat3 frame, const vec3 V, const vec3 L)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    return mx_ggx_distribution(normalize(V + L) * frame / vec3(alpha, 1.0), alpha.x * alpha.y)
        * mx_ggx_smith_visibility(max(V * frame, vec3(-1.0, -1.0, 1e-8)), max(L * frame, vec3(-1.0, -1.0, 1e-8)),
        alpha);
}

// Density of the directions L that mx_ggx_scatter takes.
// Here eta = 1.5, mode = 1, model = "schlick", k = vec3(0.0), f90 = vec3(1.0), exponent = 5.0, film = 0.0,
// film_ior = 1.5.
float mx_ggx_pdf(const vec2 roughness, const vec3 N, const vec3 X, const vec3 V, const vec3 L)
{
    vec2 alpha = clamp(roughness, vec2(1e-8), vec2(1.0));
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 l = L * frame;
    if (l.z <= 0.0)
        return 0.0;
    vec3 h = normalize(v + l);
    if (dot(v, h) <= 0.0)
        return 0.0;
    return 2.0 / (v.z + length(vec3(v.xy * alpha, v.z))) * mx_ggx_distribution(h / vec3(alpha, 1.0), alpha.x * alpha.y)
        * 0.25;
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
    bool enters = vd.matter.x < 0.0;
    bool is_below_number = vd.matter.y < 0.5;
    float level = enters ? is_below_number ? 0.0 : 2.0 : vd.matter.x;
    vec3 N = normalize(vd.normalWorld);
    // metal
    float cosine = dot(N, vd.viewWorld);
    float cos_v = max(abs(cosine), 1e-8);
    // coat
    vec2 coat_reflection_albedo = mx_ggx_albedo_fit(0.01, cos_v);
    float coat_reflection_ggx_compensation = (1.0 / coat_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    vec3 coat_reflection_slab_reflection_bsdf_albedo = mx_fresnel_schlick(max(1.0 - pow(coat_reflection_albedo.y, 0.2),
        1e-8), vec3(0.04)) * (coat_reflection_albedo.x * coat_reflection_ggx_compensation);
    vec3 coat_reflection_throughput = max(vec3(1.0) - coat_reflection_slab_reflection_bsdf_albedo, 0.0);
    float coat_reflection_chance = dot(coat_reflection_slab_reflection_bsdf_albedo, vec3(0.33333334)) * 0.9 + 0.1;
    float coat_reflection_passing = max(dot(coat_reflection_throughput, vec3(0.33333334)), 0.0);
    float coat_reflection_chances = coat_reflection_chance + coat_reflection_passing;
    vec3 X = normalize(vd.tangentWorld);
    if (level == 0.0) {
        weight = coat_reflection_throughput * (coat_reflection_chances / coat_reflection_passing);
        if (coat_reflection_chances * vd.random.w < coat_reflection_chance) {
            vec3 coat_reflection_L, coat_reflection_weight;
            float coat_reflection_pdf;
            mx_ggx_scatter(vec2(0.01), N, X, vd.viewWorld, vd.random.xyz, vec3(0.04), coat_reflection_L,
                coat_reflection_weight, coat_reflection_pdf);
            L = coat_reflection_L;
            inside = 0.0;
            weight = coat_reflection_weight * (coat_reflection_chances / coat_reflection_chance);
            density = coat_reflection_pdf * (coat_reflection_chance / coat_reflection_chances);
        }
    }
    bool is_level_1 = level == 1.0;
    // milk
    float closure_way = inversesqrt(cosine * cosine + 1.25) * 1.5;
    vec3 facing = faceforward(N, -vd.viewWorld, N);
    mat3 any_frame = mx_frame(facing, abs(facing.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    vec2 polar = sqrt(vd.random.x) * cos((vd.random.y - vec2(0.0, 0.25)) * 6.2831855);
    vec3 L_2 = any_frame * vec3(polar, sqrt(1.0 - vd.random.x));
    float pdf = max(dot(facing, L_2), 0.0) / 3.1415927;
    if (is_level_1) {
        vec3 coat_medium_throughput = exp(closure_way * vec3(-0.05, -0.033333335, -0.025));
        float coat_medium_passing = max(dot(coat_medium_throughput, vec3(0.33333334)), 0.0);
        weight = coat_medium_throughput * ((coat_medium_passing + 0.1) / coat_medium_passing);
        if (vd.random.w * (coat_medium_passing + 0.1) < 0.1) {
            L = L_2;
            inside = 0.0;
            weight = vec3(0.0);
            density = pdf * (0.1 / (coat_medium_passing + 0.1));
        }
    }
    vec2 milk_reflection_albedo = mx_ggx_albedo_fit(0.25071993, cos_v);
    float milk_reflection_ggx_compensation = (1.0 / milk_reflection_albedo.x - 1.0) * 0.08571428 + 1.0;
    vec3 milk_reflection_slab_reflection_bsdf_albedo = mx_fresnel_schlick(max(1.0 - pow(milk_reflection_albedo.y, 0.2),
        1e-8), vec3(0.04)) * (milk_reflection_albedo.x * milk_reflection_ggx_compensation);
    vec3 milk_reflection_throughput = max(vec3(1.0) - milk_reflection_slab_reflection_bsdf_albedo, 0.0);
    float milk_reflection_chance = dot(milk_reflection_slab_reflection_bsdf_albedo, vec3(0.33333334)) * 0.9 + 0.1;
    float milk_reflection_passing = max(dot(milk_reflection_throughput, vec3(0.33333334)), 0.0);
    float milk_reflection_chances = milk_reflection_chance + milk_reflection_passing;
    if (level == 3.0) {
        weight = milk_reflection_throughput * (milk_reflection_chances / milk_reflection_passing);
        if (vd.random.w * milk_reflection_chances < milk_reflection_chance) {
            vec3 milk_reflection_L, milk_reflection_weight;
            float milk_reflection_pdf;
            mx_ggx_scatter(vec2(0.25071993), N, X, vd.viewWorld, vd.random.xyz, vec3(0.04), milk_reflection_L,
                milk_reflection_weight, milk_reflection_pdf);
            L = milk_reflection_L;
            inside = 0.0;
            weight = milk_reflection_weight * (milk_reflection_chances / milk_reflection_chance);
            density = milk_reflection_pdf * (milk_reflection_chance / milk_reflection_chances);
        }
    }
    bool is_level_4 = level == 4.0;
    vec2 metal_reflection_albedo = mx_ggx_albedo_fit(0.29886922, cos_v);
    const vec3 metal_constant = vec3(0.9, 0.6, 0.3);
    vec3 metal_reflection_ggx_compensation = (1.0 / metal_reflection_albedo.x - 1.0)
        * vec3(0.9047619, 0.61904764, 0.33333334) + vec3(1.0);
    vec3 metal_reflection_slab_reflection_bsdf_albedo = mx_fresnel_schlick(max(1.0
        - pow(metal_reflection_albedo.y, 0.2), 1e-8), metal_constant) * metal_reflection_albedo.x
        * metal_reflection_ggx_compensation;
    if (is_level_4) {
        vec3 milk_medium_transmitted;
        vec3 milk_medium = mx_medium_layer(closure_way, milk_medium_transmitted);
        vec3 milk_medium_throughput = milk_medium_transmitted
            / (vec3(1.0) - min(metal_reflection_slab_reflection_bsdf_albedo
            * vec3(0.10193972, 0.102937125, 0.103155464), 0.999));
        float milk_medium_chance = dot(milk_medium, vec3(0.33333334)) * 0.9 + 0.1;
        float milk_medium_passing = max(dot(milk_medium_throughput, vec3(0.33333334)), 0.0);
        float milk_medium_chances = milk_medium_chance + milk_medium_passing;
        weight = milk_medium_throughput * (milk_medium_chances / milk_medium_passing);
        if (vd.random.w * milk_medium_chances < milk_medium_chance) {
            L = L_2;
            inside = 0.0;
            weight = mx_slab_thin_light(N, vd.viewWorld, L_2) / max(pdf, 1e-8)
                * (milk_medium_chances / milk_medium_chance);
            density = pdf * (milk_medium_chance / milk_medium_chances);
        }
    }
    vec3 metal_reflection_throughput = max(vec3(1.0) - metal_reflection_slab_reflection_bsdf_albedo, 0.0);
    float metal_reflection_chance = dot(metal_reflection_slab_reflection_bsdf_albedo, vec3(0.33333334)) * 0.9 + 0.1;
    float metal_reflection_passing = max(dot(metal_reflection_throughput, vec3(0.33333334)), 0.0);
    float metal_reflection_chances = metal_reflection_chance + metal_reflection_passing;
    if (level == 5.0) {
        weight = metal_reflection_throughput * (metal_reflection_chances / metal_reflection_passing);
        if (vd.random.w * metal_reflection_chances < metal_reflection_chance) {
            vec3 metal_reflection_L, metal_reflection_weight;
            float metal_reflection_pdf;
            mx_ggx_scatter(vec2(0.29886922), N, X, vd.viewWorld, vd.random.xyz, metal_constant, metal_reflection_L,
                metal_reflection_weight, metal_reflection_pdf);
            L = metal_reflection_L;
            inside = 0.0;
            weight = metal_reflection_weight * (metal_reflection_chances / metal_reflection_chance);
            density = metal_reflection_pdf * (metal_reflection_chance / metal_reflection_chances);
        }
    }
    if (level == 6.0) {
        weight = vec3(0.0);
        if (vd.random.w * 0.1 < 0.1) {
            L = L_2;
            inside = 0.0;
            weight = vec3(0.0);
            density = pdf;
        }
    }
    out1 = vec4(level == 2.0 ? vec3(0.0, 0.1, 0.0) : vec3(0.0), 1.0);
    out2 = vec4(L, inside);
    out3 = vec4(weight, density);
    out4 = vec4(medium, 0.0);
    float half_cosine = sqrt(clamp(dot(vd.viewWorld, vd.lightWorld.xyz) * 0.5 + 0.500001, 0.0, 1.0));
    vec3 fresnel = mx_fresnel_schlick(half_cosine, vec3(0.04));
    mat3 frame = mx_frame(facing, X);
    float both = vd.lightWorld.w * (coat_reflection_chance / coat_reflection_chances
        * mx_ggx_pdf(vec2(0.01), N, X, vd.viewWorld, vd.lightWorld.xyz)) + 1.0;
    vec3 balanced = fresnel * (coat_reflection_ggx_compensation
        * mx_ggx_smith_lobe(vec2(0.01), frame, vd.viewWorld, vd.lightWorld.xyz)) / both;
    float cosine_2 = dot(N, vd.lightWorld.xyz);
    float closure_way_2 = inversesqrt(cosine_2 * cosine_2 + 1.25) * 1.5;
    const vec3 coat_medium_constant = vec3(0.05, 0.033333335, 0.025);
    vec3 extinction_above = is_below_number ? coat_medium_constant : vec3(0.0);
    float both_2 = vd.lightWorld.w * (milk_reflection_chance / milk_reflection_chances
        * mx_ggx_pdf(vec2(0.25071993), N, X, vd.viewWorld, vd.lightWorld.xyz)) + 1.0;
    vec3 balanced_2 = fresnel * (milk_reflection_ggx_compensation
        * mx_ggx_smith_lobe(vec2(0.25071993), frame, vd.viewWorld, vd.lightWorld.xyz)) / both_2;
    float metal_reflection_ggx_smith_lobe = mx_ggx_smith_lobe(vec2(0.29886922), frame, vd.viewWorld, vd.lightWorld.xyz);
    float both_3 = vd.lightWorld.w * (metal_reflection_chance / metal_reflection_chances
        * mx_ggx_pdf(vec2(0.29886922), N, X, vd.viewWorld, vd.lightWorld.xyz)) + 1.0;
    vec3 balanced_3 = metal_reflection_ggx_compensation * mx_fresnel_schlick(half_cosine, metal_constant)
        * metal_reflection_ggx_smith_lobe / both_3;
    vec3 choice = is_level_4 ? vec3(1.0) : level == 5.0
        ? balanced_3 * exp(-(closure_way_2 * (extinction_above + vec3(0.2)))) : vec3(0.0);
    vec3 choice_2 = is_level_1 ? vec3(1.0) : level == 2.0 ? vec3(0.0) : level == 3.0
        ? exp(-(closure_way_2 * extinction_above)) * balanced_2 : choice;
    out5 = vec4(level == 0.0 ? balanced : choice_2, 0.0);
    float chance = fract(vd.random.w * 4096.0);
    float brightness_sum = 0.0;
    vec3 light = vec3(0.0);
    vec3 light_L = vec3(0.0);
    float light_distance = 0.0;
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L_3;
        float intensity;
        float away;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L_3 = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
            away = 1e30;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
            vec3 to_light = normalize(d);
            L_3 = to_light;
            float magnitude_d = length(d);
            float falloff = u_lightData[i].intensity / pow(magnitude_d + 1.0, u_lightData[i].decay_rate);
            if (light_type == 2) {
                intensity = falloff;
                away = magnitude_d;
            } else {
                float edge = min(u_lightData[i].inner_angle, u_lightData[i].outer_angle) - 0.00001;
                intensity = light_type == 3
                    ? smoothstep(edge, u_lightData[i].inner_angle, -dot(u_lightData[i].direction, to_light)) * falloff
                    : 0.0;
                away = magnitude_d;
            }
        }
        float half_cosine_2 = sqrt(clamp(dot(vd.viewWorld, L_3) * 0.5 + 0.500001, 0.0, 1.0));
        vec3 fresnel_2 = mx_fresnel_schlick(half_cosine_2, vec3(0.04));
        vec3 coat_reflection_slab_reflection_bsdf_eval = coat_reflection_ggx_compensation * fresnel_2
            * mx_ggx_smith_lobe(vec2(0.01), frame, vd.viewWorld, L_3);
        float cosine_3 = dot(N, L_3);
        float closure_way_3 = inversesqrt(cosine_3 * cosine_3 + 1.25) * 1.5;
        vec3 milk_reflection_slab_reflection_bsdf_eval = milk_reflection_ggx_compensation * fresnel_2
            * mx_ggx_smith_lobe(vec2(0.25071993), frame, vd.viewWorld, L_3);
        vec3 metal_reflection_product = metal_reflection_ggx_compensation
            * mx_fresnel_schlick(half_cosine_2, metal_constant);
        vec3 metal_reflection_slab_reflection_bsdf_eval = metal_reflection_product
            * mx_ggx_smith_lobe(vec2(0.29886922), frame, vd.viewWorld, L_3);
        vec3 choice_3 = is_level_4 ? vec3(1.0) : level == 5.0
            ? metal_reflection_slab_reflection_bsdf_eval * exp(-((extinction_above + vec3(0.2)) * closure_way_3))
            : vec3(0.0);
        vec3 choice_4 = is_level_1 ? vec3(1.0) : level == 2.0 ? vec3(0.0) : level == 3.0
            ? exp(-(extinction_above * closure_way_3)) * milk_reflection_slab_reflection_bsdf_eval : choice_3;
        vec3 lit = u_lightData[i].color * intensity
            * (level == 0.0 ? coat_reflection_slab_reflection_bsdf_eval : choice_4);
        float brightness = max(dot(lit, vec3(0.33333334)), 0.0);
        brightness_sum += brightness;
        if (brightness_sum * chance < brightness) {
            light_L = L_3;
            light_distance = away;
            light = lit / brightness;
        }
        if (brightness > 0.0) {
            float ratio = (brightness_sum * chance - brightness) / (brightness_sum - brightness);
            chance = brightness_sum * chance < brightness ? brightness_sum * chance / brightness : ratio;
        }
    }
    out6 = vec4(light_L, light_distance);
    out7 = vec4(brightness_sum * light, 0.0);
    out9 = vec4(is_level_1 ? vec3(0.0) : is_level_4 ? vec3(0.19811778, 0.19958141, 0.19990106) : vec3(0.0), 0.0);
    float choice_5 = level < 2.0 ? 2.0 : level < 3.0 ? 3.0 : level < 4.0 ? 4.0 : level < 5.0 ? 5.0 : level < 6.0 ? 6.0
        : -1.0;
    float choice_6 = is_below_number && level < 1.0 ? 1.0 : choice_5;
    float next_level = is_below_number && level < 0.0 ? 0.0 : choice_6;
    out10 = vec4(is_level_1 ? coat_medium_constant : is_level_4 ? vec3(0.2) : vec3(0.0), next_level);
    vec3 choice_7 = is_below_number ? (enters ? coat_reflection_throughput : vec3(1.0))
        * exp(-(closure_way * coat_medium_constant)) : vec3(1.0);
    vec3 product = choice_7 * (enters ? milk_reflection_throughput : vec3(1.0)) * exp(-vec3(closure_way * 0.2));
    float medium_above = level > 4.0 ? 4.0 : is_below_number && level > 1.0 ? 1.0 : -1.0;
    out11 = vec4(product * (enters ? metal_reflection_throughput : vec3(1.0)) * (enters ? vec3(0.0) : vec3(1.0)),
        medium_above);
    out12 = vec4(0.0, 0.0, 0.0, -2.0);
}
