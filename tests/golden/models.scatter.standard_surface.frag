#version 450
// standard_surface · surfacematerial · mxgen 0.1 · vulkan · reduced · 2 closures · 0 textures

layout(set = 0, binding = 0, std140) uniform PrivateUniforms {
    int u_numActiveLightSources;
};
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
layout(set = 0, binding = 2, std140) uniform LightData_block { LightData u_lightData[3]; };
struct VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
    vec3 tangentWorld;
    vec3 viewWorld;
    vec4 random;
    vec4 lightWorld;
};
VertexData vd;
vec4 out1;
vec4 out2;
vec4 out3;
vec4 out4;
vec4 out5;
vec4 out6;
vec4 out7;

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
float mx_fresnel_permittivity(const float cosine, const float re)
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
// Here area = 0.0016000002.
float mx_ggx_distribution(const vec3 e)
{
    return 1.0 / (0.005026549 * dot(e, e) * dot(e, e));
}

// Masking and shadowing of the directions v and l over 4 cos_v, each with the roughness in its direction (Heitz 2014,
// equations 80 and 99).
// Here alpha = vec2(0.04).
float mx_ggx_smith_visibility(const vec3 v, const vec3 l)
{
    return 0.5 * l.z / (v.z * length(vec3(l.xy * 0.04, l.z)) + l.z * length(vec3(v.xy * 0.04, v.z)));
}

// Reflectance of a dielectric that faces the viewer.
float mx_fresnel_dielectric_facing(const float ior)
{
    float r = (1.0 - ior) / (1.0 + ior);
    return r * r;
}

// Factor that gives back the light of multiple scattering (Turquin 2019, equations 14 and 16).
// Here model = "dielectric", k = vec3(0.0), f90 = vec3(1.0), film = 0.0, film_ior = 1.5.
vec3 mx_ggx_compensation(const vec2 albedo, const vec3 n)
{
    return vec3(1.0) + mix(vec3(mx_fresnel_dielectric_facing(n.x)), vec3(1.0), vec3(0.04761905))
        * (1.0 / albedo.x - 1.0);
}

// A normal of those visible from v, at any length (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps"): v is stretched by the roughness and has the length `reach`, `around` is (cos, sin) of the turn around z, and
// `depth` how far the normal lies below the top of the cap, v.z + reach at most.
vec3 mx_ggx_cap(const vec2 around, const float depth, const vec3 v, const float reach)
{
    return v + vec3(sqrt(depth * (2.0 * reach - depth)) * around, reach - depth);
}

// A unit normal of those visible from v, from two random numbers xi.
// Here alpha = vec2(0.04).
vec3 mx_ggx_visible(const vec3 v, const vec2 xi)
{
    vec3 stretch = vec3(0.04, 0.04, 1.0);
    float reach = length(vec3(v.xy * 0.04, v.z));
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
// Here roughness = vec2(0.04), by_direction = false, mode = 1, model = "dielectric", k = vec3(0.0), f90 = vec3(1.0),
// exponent = 0.0, film = 0.0, film_ior = 1.5.
void mx_ggx_scatter(const vec3 N, const vec3 X, const vec3 V, const vec3 xi, const vec3 n, out vec3 L, out vec3 weight,
    out float pdf)
{
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 h = mx_ggx_visible(v, xi.xy);
    vec3 l = reflect(-v, h);
    float density = 2.0 / (v.z + length(vec3(v.xy * 0.04, v.z)));
    L = frame * l;
    weight = vec3(0.0);
    pdf = 0.0;
    if (l.z <= 0.0)
        return;
    weight = vec3(mx_fresnel_permittivity(clamp(dot(v, h), 1e-8, 1.0), n.x * n.x))
        * (mx_ggx_smith_visibility(v, l) * 4.0 / density) * mx_ggx_compensation(mx_ggx_albedo_fit(v.z), n);
    pdf = 0.25;
    pdf *= density * mx_ggx_distribution(h / vec3(0.04, 0.04, 1.0));
}

// The lobe of the facets from L to V, without Fresnel's factor, with masking by direction.
// Here roughness = vec2(0.04).
float mx_ggx_smith_lobe(const mat3 frame, const vec3 V, const vec3 L)
{
    return mx_ggx_distribution(normalize(V + L) * frame / vec3(0.04, 0.04, 1.0))
        * mx_ggx_smith_visibility(max(V * frame, vec3(-1.0, -1.0, 1e-8)), max(L * frame, vec3(-1.0, -1.0, 1e-8)));
}

// Density of the directions L that mx_ggx_scatter takes.
// Here roughness = vec2(0.04), mode = 1, model = "dielectric", k = vec3(0.0), f90 = vec3(1.0), exponent = 0.0,
// film = 0.0, film_ior = 1.5.
float mx_ggx_pdf(const vec3 N, const vec3 X, const vec3 V, const vec3 L)
{
    mat3 frame = mx_frame(faceforward(N, -V, N), X);
    vec3 v = max(V * frame, vec3(-1.0, -1.0, 1e-8));
    vec3 l = L * frame;
    if (l.z <= 0.0)
        return 0.0;
    vec3 h = normalize(v + l);
    if (dot(v, h) <= 0.0)
        return 0.0;
    return 2.0 / (v.z + length(vec3(v.xy * 0.04, v.z))) * mx_ggx_distribution(h / vec3(0.04, 0.04, 1.0)) * 0.25;
}

void scatter()
{
    vec3 axis = normalize(vd.normalWorld);
    // SR_standard_surface
    float axis_dot_lobe_view = dot(axis, vd.viewWorld);
    vec2 albedo = mx_ggx_albedo_fit(max(abs(axis_dot_lobe_view), 1e-8));
    float eta = axis_dot_lobe_view < 0.0 ? 0.6666667 : 1.5;
    float scaled_eta = eta * eta;
    float r = (1.0 - eta) / (eta + 1.0);
    float ggx_compensation = mix(r * r, 1.0, 0.04761905) * (1.0 / albedo.x - 1.0) + 1.0;
    float dielectric_bsdf_albedo = mx_fresnel_permittivity(max(1.0 - pow(albedo.y, 0.2), 1e-8), scaled_eta) * albedo.x
        * ggx_compensation;
    float reflection_share = max(dielectric_bsdf_albedo * 0.9 + 0.1, 0.0);
    float diffuse_share = max((1.0 - dielectric_bsdf_albedo) * 0.82, 0.0);
    float shares = reflection_share + diffuse_share;
    float pick = shares * vd.random.w;
    vec3 L = vec3(0.0);
    float inside = 0.0;
    vec3 weight = vec3(0.0);
    float density = 0.0;
    vec3 medium = vec3(1.0);
    vec3 coat_tangent = normalize(vd.tangentWorld);
    if (pick >= 0.0 && pick < reflection_share) {
        vec3 reflection_L, reflection_weight;
        float reflection_pdf;
        mx_ggx_scatter(axis, coat_tangent, vd.viewWorld, vd.random.xyz, vec3(eta), reflection_L, reflection_weight,
            reflection_pdf);
        L = reflection_L;
        weight = reflection_weight * (shares / reflection_share);
        bool is_in_front = axis_dot_lobe_view * dot(axis, reflection_L) > 0.0;
        inside = is_in_front ? 0.0 : 1.0;
        density = is_in_front ? reflection_pdf * (reflection_share / shares) : 0.0;
    }
    pick -= reflection_share;
    vec3 facing = faceforward(axis, -vd.viewWorld, axis);
    if (pick >= 0.0 && pick < diffuse_share) {
        mat3 any_frame = mx_frame(facing, abs(facing.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
        vec2 polar = sqrt(vd.random.x) * cos((vd.random.y - vec2(0.0, 0.25)) * 6.2831855);
        vec3 diffuse_L = any_frame * vec3(polar, sqrt(1.0 - vd.random.x));
        L = diffuse_L;
        float facing_dot_diffuse_l = dot(facing, diffuse_L);
        float pdf = max(facing_dot_diffuse_l, 0.0) / 3.1415927;
        weight = vec3((1.0 - dielectric_bsdf_albedo)
            * (max(facing_dot_diffuse_l, 1e-8) * 0.31830987 * 0.8 / max(pdf, 1e-8)) * (shares / diffuse_share));
        density = pdf * (diffuse_share / shares);
    }
    out1 = vec4(0.0, 0.0, 0.0, 1.0);
    out2 = vec4(L, inside);
    out3 = vec4(weight, density);
    out4 = vec4(medium, 0.0);
    float reflection_product = ggx_compensation
        * mx_fresnel_permittivity(sqrt(clamp(dot(vd.viewWorld, vd.lightWorld.xyz) * 0.5 + 0.500001, 0.0, 1.0)),
        scaled_eta);
    mat3 frame = mx_frame(facing, coat_tangent);
    float reflection_both = vd.lightWorld.w
        * (reflection_share / shares * mx_ggx_pdf(axis, coat_tangent, vd.viewWorld, vd.lightWorld.xyz)) + 1.0;
    vec3 reflection_balanced = vec3(reflection_product * mx_ggx_smith_lobe(frame, vd.viewWorld, vd.lightWorld.xyz)
        / reflection_both);
    float facing_dot_l = dot(facing, vd.lightWorld.xyz);
    float diffuse_both = vd.lightWorld.w * (diffuse_share / shares * (max(facing_dot_l, 0.0) / 3.1415927)) + 1.0;
    float diffuse_balanced = (1.0 - dielectric_bsdf_albedo) * (max(facing_dot_l, 1e-8) * 0.31830987 * 0.8)
        / diffuse_both;
    out5 = vec4((axis_dot_lobe_view * dot(axis, vd.lightWorld.xyz) > 0.0 ? reflection_balanced : vec3(0.0))
        + diffuse_balanced, 0.0);
    float chance = fract(vd.random.w * 4096.0);
    float brightness_sum = 0.0;
    vec3 light = vec3(0.0);
    vec3 light_L = vec3(0.0);
    float light_distance = 0.0;
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        vec3 L_2;
        float intensity;
        float away;
        int light_type = u_lightData[i].type;
        if (light_type == 1) {
            L_2 = -u_lightData[i].direction;
            intensity = u_lightData[i].intensity;
            away = 1e30;
        } else {
            vec3 d = u_lightData[i].position - vd.positionWorld;
            vec3 to_light = normalize(d);
            L_2 = to_light;
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
        float reflection_product_2 = ggx_compensation
            * mx_fresnel_permittivity(sqrt(clamp(dot(vd.viewWorld, L_2) * 0.5 + 0.500001, 0.0, 1.0)), scaled_eta);
        vec3 dielectric_bsdf_eval = vec3(reflection_product_2 * mx_ggx_smith_lobe(frame, vd.viewWorld, L_2));
        float diffuse_product = (1.0 - dielectric_bsdf_albedo) * (max(dot(facing, L_2), 1e-8) * 0.31830987 * 0.8);
        vec3 response = (axis_dot_lobe_view * dot(axis, L_2) > 0.0 ? dielectric_bsdf_eval : vec3(0.0))
            + diffuse_product;
        vec3 lit = u_lightData[i].color * intensity * response;
        float brightness = max(dot(lit, vec3(0.33333334)), 0.0);
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
    out6 = vec4(light_L, light_distance);
    out7 = vec4(brightness_sum * light, 0.0);
}
