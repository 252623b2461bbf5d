// SPDX-License-Identifier: Apache-2.0
// The lights of the host: what the passes call (docs/hosts.md). A real host reads lists of lights, shadow maps, probes and images of the
// screen from its own descriptor sets here; this one knows where its balls stand.

const float SPACING = 2.2, RADIUS = 0.9;
const vec3 SKY = vec3(0.55, 0.65, 0.85), GROUND = vec3(0.12, 0.11, 0.1);

const int NUM_LAMPS = 4;
const vec3 LAMP_PLACES[NUM_LAMPS] = vec3[](vec3(-14.0, 7.0, 2.0), vec3(13.0, 6.0, -6.0), vec3(0.0, 5.0, 9.0), vec3(2.0, 9.0, -14.0));
const vec3 LAMP_COLORS[NUM_LAMPS] = vec3[](vec3(90.0, 70.0, 45.0), vec3(40.0, 55.0, 90.0), vec3(60.0, 60.0, 55.0), vec3(50.0, 80.0, 60.0));

vec3 nearest_ball(vec3 P)
{
    vec2 half_size = 0.5 * vec2(BALLS - 1), cell = clamp(round(P.xz / SPACING + half_size), vec2(0.0), vec2(BALLS - 1)) - half_size;
    return vec3(cell.x * SPACING, 0.0, cell.y * SPACING);
}

// True where a ball stands between a point and what is `far` away in the direction L.
bool is_hidden(vec3 P, vec3 L, float far)
{
    for (int i = 1; i < 12; i++)
    {
        float way = float(i) * 0.45 * SPACING;
        vec3 at = P + L * way, to_ball = nearest_ball(at) - P;
        float along = dot(to_ball, L);
        if (way > far || at.y > RADIUS)
            return false;
        if (along > 0.05 && along < far && dot(to_ball, to_ball) - along * along < RADIUS * RADIUS)
            return true;
    }
    return false;
}

vec3 sky(vec3 L)
{
    return mix(GROUND, SKY, smoothstep(-0.15, 0.15, L.y));
}

int mxg_light_count()
{
    return NUM_LAMPS;
}

void mxg_light(int i, vec3 P, out vec3 L, out vec3 radiance)
{
    vec3 to_lamp = LAMP_PLACES[i] - P;
    float far = length(to_lamp);
    L = to_lamp / far;
    radiance = is_hidden(P, L, far) ? vec3(0.0) : LAMP_COLORS[i] / (far * far);
}

// The part of the hemisphere that the eight balls around leave (a sphere hides cos r² / d² of it).
float mxg_ambient_occlusion(vec3 P, vec3 N)
{
    float hidden = 0.0;
    for (int i = 0; i < 9; i++)
    {
        vec3 to_ball = nearest_ball(P + vec3(float(i % 3 - 1), 0.0, float(i / 3 - 1)) * SPACING) - P;
        float away = length(to_ball);
        if (away > RADIUS * 1.02)
            hidden += max(dot(N, to_ball) / away, 0.0) * RADIUS * RADIUS / (away * away);
    }
    return clamp(1.0 - hidden, 0.0, 1.0);
}

vec3 mxg_irradiance(vec3 P, vec3 N)
{
    return mix(GROUND, SKY, 0.5 + 0.5 * N.y);
}

vec3 mxg_radiance(vec3 P, vec3 L, float roughness)
{
    vec3 light = mix(sky(L), mxg_irradiance(P, L), roughness);
    return is_hidden(P + L * 0.02, L, 8.0) ? light * mix(0.25, 0.6, roughness) : light;
}
