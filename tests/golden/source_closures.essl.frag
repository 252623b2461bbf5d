#version 300 es
// Smoke · surfacematerial · mxgen 0.1 · essl · reduced · 1 closure · 0 textures
precision highp float;
precision highp int;
precision highp sampler2D;

uniform vec3 u_viewPosition;
uniform int u_numActiveLightSources;
uniform float u_envLightIntensity;
struct LightData {
    int type;
    vec3 position;
    vec3 color;
};
uniform LightData u_lightData[3];
uniform sampler2D u_envIrradiance;
in vec3 vd_positionWorld;
in vec3 vd_normalWorld;
out vec4 out1;

const float M_FLOAT_EPS = 1e-8;
const float M_PI = 3.1415926535897932;
float mx_square(float a) { return a * a; }
vec2 mx_square(vec2 a) { return a * a; }
vec3 mx_square(vec3 a) { return a * a; }
struct BSDF { vec3 response; vec3 throughput; };
struct VDF { vec3 response; vec3 throughput; };
struct lightshader { vec3 intensity; vec3 direction; };
const int CLOSURE_TYPE_REFLECTION = 1;
const int CLOSURE_TYPE_TRANSMISSION = 2;
const int CLOSURE_TYPE_INDIRECT = 3;
struct ClosureData { int closureType; vec3 L; vec3 V; vec3 N; vec3 P; float occlusion; };
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

void smoke_vdf(ClosureData closureData, vec3 absorption, inout VDF vdf)
{
    if (closureData.closureType == CLOSURE_TYPE_TRANSMISSION)
        vdf.throughput = exp(-absorption);
}

void main()
{
    vec3 color = vec3(0.0);
    // lights
    vec3 V_direction = normalize(u_viewPosition - vd_positionWorld);
    vec3 direction = normalize(vd_normalWorld);
    // from the last light, so that drivers do not unroll the loop
    for (int i = min(u_numActiveLightSources, 3) - 1; i >= 0; --i) {
        // soft
        lightshader bulb_2;
        bulb(u_lightData[i], vd_positionWorld, bulb_2);
        ClosureData soft_closure_data = ClosureData(1, bulb_2.direction, V_direction, direction, vd_positionWorld, 1.0);
        BSDF soft = BSDF(vec3(0.0), vec3(1.0));
        soft_bsdf(soft_closure_data, 0.8, vec3(0.5), direction, 1, soft);
        color += (u_lightData[i].type == 1 ? bulb_2.intensity : vec3(0.0)) * soft.response;
    }
    // environment: soft
    ClosureData soft_closure_data = ClosureData(3, vec3(0.0), V_direction, direction, vd_positionWorld, 1.0);
    BSDF soft = BSDF(vec3(0.0), vec3(1.0));
    soft_bsdf(soft_closure_data, 0.8, vec3(0.5), direction, 1, soft);
    ClosureData closure_data = ClosureData(2, vec3(0.0), V_direction, direction, vd_positionWorld, 1.0);
    VDF smoke = VDF(vec3(0.0), vec3(1.0));
    smoke_vdf(closure_data, vec3(0.5), smoke);
    BSDF soft_2 = BSDF(vec3(0.0), vec3(1.0));
    soft_bsdf(closure_data, 0.8, vec3(0.5), direction, 1, soft_2);
    color += soft.response + exp(log(max(smoke.throughput, 1e-6))) * soft_2.response;
    out1 = vec4(color, 1.0);
}
