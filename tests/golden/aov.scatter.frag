#version 450
// Paint · surfacematerial · mxgen 0.1 · vulkan · reduced · 3 closures · 0 textures

struct VertexData {
    vec3 normalObject;
    vec3 normalWorld;
    vec3 viewWorld;
    vec4 random;
    vec4 lightWorld;
    vec3 normalMoved;
    vec2 texcoord_0;
};
VertexData vd;
vec4 out8;
vec4 out1;
vec4 out2;
vec4 out3;
vec4 out4;
vec4 out5;
vec3 aov_diffuse;
vec3 aov_glow;
vec3 aov_base_albedo;
vec2 aov_uv;
vec4 aov_weights;
int aov_is_paint;
int aov_id;
vec3 aov_normal;
vec3 aov_weight_diffuse;
vec3 aov_response_diffuse;

// Axes of the tangent space around N with x along X: `w * frame` enters it, `frame * w` leaves it.
mat3 mx_frame(const vec3 N, const vec3 X)
{
    mat3 frame;
    frame[0] = normalize(X - dot(X, N) * N);
    frame[1] = cross(N, frame[0]);
    frame[2] = N;
    return frame;
}

void scatter()
{
    out8 = vec4(normalize(vd.normalWorld) * vd.texcoord_0.x, 0.0);
    float pick = vd.random.w * 0.4;
    vec3 L = vec3(0.0);
    float inside = 0.0;
    vec3 weight = vec3(0.0);
    vec3 diffuse_weight = vec3(0.0);
    float density = 0.0;
    vec3 medium = vec3(1.0);
    vec3 N = normalize(vd.normalMoved);
    // SR/base
    vec3 facing = faceforward(N, -vd.viewWorld, N);
    // SR
    const vec3 base_constant = vec3(0.8, 0.1, 0.1);
    if (pick >= 0.0 && pick < 0.4) {
        mat3 any_frame = mx_frame(facing, abs(facing.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
        vec2 polar = sqrt(vd.random.x) * cos((vd.random.y - vec2(0.0, 0.25)) * 6.2831855);
        vec3 diffuse_L = any_frame * vec3(polar, sqrt(1.0 - vd.random.x));
        L = diffuse_L;
        float facing_dot_diffuse_l = dot(facing, diffuse_L);
        float pdf = max(facing_dot_diffuse_l, 0.0) / 3.1415927;
        vec3 diffuse_weight_2 = max(facing_dot_diffuse_l, 1e-8) * 0.31830987 * base_constant / max(pdf, 1e-8);
        weight = diffuse_weight_2;
        diffuse_weight = diffuse_weight_2;
        density = pdf;
    }
    out1 = vec4(0.1, 0.2, 0.3, 0.5);
    out2 = vec4(L, inside);
    out3 = vec4(weight, density);
    out4 = vec4(medium, 0.0);
    float facing_dot_l = dot(facing, vd.lightWorld.xyz);
    float both = vd.lightWorld.w * (max(facing_dot_l, 0.0) / 3.1415927) + 1.0;
    vec3 response = max(facing_dot_l, 1e-8) * 0.31830987 * base_constant / both;
    out5 = vec4(response, 0.0);
    aov_diffuse = vec3(0.0);
    aov_glow = vec3(0.1, 0.2, 0.3);
    aov_base_albedo = base_constant;
    aov_uv = vd.texcoord_0;
    aov_weights = vec4(0.1, 0.2, 0.3, 0.4);
    aov_is_paint = 1;
    aov_id = 7;
    aov_normal = normalize(vd.normalObject);
    aov_weight_diffuse = diffuse_weight;
    aov_response_diffuse = response;
}
