#version 450
// M · surfacematerial · mxgen 0.1 · glsl · reduced · 3 closures · 0 textures

uniform vec3 u_viewPosition = vec3(0.0);
uniform int u_numActiveLightSources = 0;
uniform mat4 u_envMatrix = mat4(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
uniform float u_envLightIntensity = 1.0;
struct LightData {
    int type;
    vec3 position;
    vec3 color;
};
uniform LightData u_lightData[3];
uniform sampler2D u_envIrradiance;
in VertexData {
    vec3 positionWorld;
    vec3 normalWorld;
} vd;
out vec4 out1;

const float M_FLOAT_EPS = 1e-8;
const float M_PI = 3.1415926535897932;
float mx_square(float a) { return a * a; }
vec2 mx_square(vec2 a) { return a * a; }
vec3 mx_square(vec3 a) { return a * a; }
struct BSDF { vec3 response; vec3 throughput; };
#define EDF vec3
struct lightshader { vec3 intensity; vec3 direction; };
const int CLOSURE_TYPE_REFLECTION = 1;
const int CLOSURE_TYPE_TRANSMISSION = 2;
const int CLOSURE_TYPE_INDIRECT = 3;
const int CLOSURE_TYPE_EMISSION = 4;
struct ClosureData { int closureType; vec3 L; vec3 V; vec3 N; vec3 P; float occlusion; };
// A factor of another emission.
void tinted_edf(ClosureData closureData, vec3 tint, EDF base, out EDF result)
{
    result = vec3(0.0);
    if (closureData.closureType == CLOSURE_TYPE_EMISSION)
        result = base * tint * abs(dot(closureData.N, closureData.V));
}

// Included by several files, in the shader once.
#define HALF_PI (M_PI * 0.5)

float shape(float x)
{
    return mx_square(x) * HALF_PI;
}


void bulb(LightData light, vec3 position, out lightshader result)
{
    vec3 away = light.position - position;
    result.direction = normalize(away);
    result.intensity = light.color / max(mx_square(length(away)), M_FLOAT_EPS) * shape(1.0);
}



vec3 facing(vec3 N, vec3 V)
{
    return dot(N, V) < 0.0 ? -N : N;
}



// A soft lobe over its base: it answers for the light, for the surroundings and for light from behind.
void soft_bsdf(ClosureData closureData, float weight, vec3 color, vec3 normal, int shape_of, inout BSDF bsdf)
{
    vec3 N = facing(normal, closureData.V);
    float rim = shape(1.0 - clamp(dot(N, closureData.V), 0.0, 1.0));
    bsdf.throughput = vec3(1.0 - weight * rim);
    if (closureData.closureType == CLOSURE_TYPE_REFLECTION) {
        float cosine = clamp(dot(N, closureData.L), 0.0, 1.0);
        bsdf.response = color * weight * (shape_of == 1 ? rim : cosine) * closureData.occlusion;
    } else if (closureData.closureType == CLOSURE_TYPE_INDIRECT) {
        bsdf.response = color * weight * rim * textureLod(u_envIrradiance, N.xy, 0.0).rgb * u_envLightIntensity;
    } else if (closureData.closureType == CLOSURE_TYPE_TRANSMISSION) {
        bsdf.response = color * weight * 0.1;
    }
}

// The angle, over pi, with this sine and cosine; the cosine is not negative. It errs by 2.9e-5 at most.
float mx_half_turn(const float sine, const float cosine)
{
    return sine * (0.4999709 + cosine * (cosine * (0.2302802 + cosine * (0.0398298 * cosine - 0.1351235)) - 0.3164252));
}

// The square of the distance of the unit direction d from the vertical axis, never 0.
float mx_map_square(const vec3 d)
{
    return d.x * d.x + (d.z * d.z + 1e-16);
}

// The point of the latitude-longitude picture for the unit direction d, to a tenth of a texel in 4096.
vec2 mx_map_point(const vec3 d)
{
    float square = mx_map_square(d);
    float stretch = inversesqrt(square);
    return vec2(fract((d.z > 0.0 ? -0.5 : 0.5) * (mx_half_turn(d.x * stretch, abs(d.z) * stretch) + 0.5) + 0.25),
        0.5 - mx_half_turn(d.y, square * stretch));
}

void main()
{
    vec3 V = normalize(u_viewPosition - vd.positionWorld);
    vec3 N = normalize(vd.normalWorld);
    ClosureData closure_data = ClosureData(4, vec3(0.0), V, N, vd.positionWorld, 1.0);
    vec3 tinted = vec3(0.0);
    tinted_edf(closure_data, vec3(1.0, 0.5, 0.5), vec3(0.25, 0.5, 0.75), tinted);
    vec3 color = tinted;
    // lights
    vec3 facing_2 = faceforward(N, -V, N);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // soft, diffuse
        lightshader bulb_2;
        bulb(u_lightData[i], vd.positionWorld, bulb_2);
        ClosureData soft_closure_data = ClosureData(1, bulb_2.direction, V, N, vd.positionWorld, 1.0);
        BSDF soft = BSDF(vec3(0.0), vec3(1.0));
        soft_bsdf(soft_closure_data, 0.8, vec3(0.5), N, 1, soft);
        vec3 response = soft.response + soft.throughput * (max(dot(bulb_2.direction, facing_2), 1e-8) * 0.05729578);
        color += (u_lightData[i].type == 1 ? bulb_2.intensity : vec3(0.0)) * response;
    }
    // environment: soft, diffuse
    ClosureData soft_closure_data = ClosureData(3, vec3(0.0), V, N, vd.positionWorld, 1.0);
    BSDF soft = BSDF(vec3(0.0), vec3(1.0));
    soft_bsdf(soft_closure_data, 0.8, vec3(0.5), N, 1, soft);
    vec3 diffuse_response = u_envLightIntensity * 0.18
        * (soft.throughput * textureLod(u_envIrradiance, mx_map_point(normalize(mat3(u_envMatrix) * facing_2)),
        0.0).xyz);
    ClosureData soft_closure_data_2 = ClosureData(2, vec3(0.0), V, N, vd.positionWorld, 1.0);
    BSDF soft_2 = BSDF(vec3(0.0), vec3(1.0));
    soft_bsdf(soft_closure_data_2, 0.8, vec3(0.5), N, 1, soft_2);
    color += diffuse_response + (soft.response + soft_2.response);
    out1 = vec4(color, 1.0);
}
