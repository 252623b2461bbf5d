// SPDX-License-Identifier: Apache-2.0
// Measures one closure at many settings. A file that includes this one has defined the closure as
//
//     vec3 leaf_eval(float a, float b, vec3 V, vec3 L)       settings a, b in (0, 1)
//     vec3 leaf_refraction(float a, float b, vec3 V, vec3 L)
//     vec3 leaf_albedo(float a, float b, vec3 V)
//     vec3 leaf_sample(float a, float b, vec3 V, vec3 xi, out vec3 weight, out float pdf)
//     float leaf_pdf(float a, float b, vec3 V, vec3 L)
//     vec3 leaf_back(float a, float b, vec3 V)               about where most light is reflected,
//     vec3 leaf_through(float a, float b, vec3 V)            and where refracted
//
// around the normal +z. Settings and the angle of V come from where on the picture a pixel is.

// llvmpipe leaves all loops of a pixel after 65,535 rounds, so there must be fewer.

const float PI = 3.14159265;
const int SAMPLES = 4096;
const int ALONG = 224; // points of the quadrature from pole to pole,
const int AROUND = 112; // and around
const int A_STEPS = 6;
const int B_STEPS = 4;
const int BINS_AROUND = 16;
const int BINS_ALONG = 8;
const int DRAWS = 8192;

vec3 polar(float cosine, float phi)
{
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    return vec3(sine * cos(phi), sine * sin(phi), cosine);
}

// V at an angle from the normal, in no special plane.
vec3 view(float s)
{
    return polar(mix(0.02, 1.0, s), 0.6);
}

float largest(vec3 v)
{
    return max(v.x, max(v.y, v.z));
}

// In [0, 1), of the upper bits.
vec3 unit_numbers(uint x, uint y, uint z)
{
    return vec3(float(x >> 8), float(y >> 8), float(z >> 8)) / 16777216.0;
}

// Multiples of irrational numbers: evenly spread.
vec3 even_numbers(int i)
{
    uint n = uint(i) + 1u;
    return unit_numbers(n * 3518319155u, n * 2882110345u, n * 2360945575u);
}

// O'Neill 2014, "PCG", with the permutation RXS-M-XS: as if by chance.
uint scatter(uint x)
{
    uint word = x * 747796405u + 2891336453u;
    word = ((word >> ((word >> 28) + 4u)) ^ word) * 277803737u;
    return (word >> 22) ^ word;
}

vec3 random_numbers(int i)
{
    uint n = 3u * uint(i);
    return unit_numbers(scatter(n), scatter(n + 1u), scatter(n + 2u));
}

// Integrals of the response, refraction and density over a hemisphere, with more points near `pole`.
void integrate(float a, float b, vec3 V, vec3 pole, float side, inout vec3 eval, inout vec3 refraction, inout float density)
{
    vec3 x = normalize(cross(pole, abs(pole.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    mat3 frame = mat3(x, cross(pole, x), pole);
    for (int i = 0; i < ALONG; ++i)
    {
        float t = (float(i) + 0.5) / float(ALONG);
        float theta = PI * t * t * t;
        float area = sin(theta) * 3.0 * PI * t * t / float(ALONG) * 2.0 * PI / float(AROUND);
        for (int j = 0; j < AROUND; ++j)
        {
            vec3 L = frame * polar(cos(theta), 2.0 * PI * (float(j) + 0.5) / float(AROUND));
            if (L.z * side > 0.0)
            {
                eval += leaf_eval(a, b, V, L) * area;
                refraction += leaf_refraction(a, b, V, L) * area;
                density += leaf_pdf(a, b, V, L) * area;
            }
        }
    }
}

// Setting number i of `count`, in the middle of its part of the range.
float setting(float t, int count, int every)
{
    int i = int(t * float(A_STEPS * B_STEPS)) / every;
    return (float(i - i / count * count) + 0.5) / float(count);
}

// Along s: angles; along t: settings. The light that is scattered; how far the albedo is from what is reflected of it; what is missing in the
// integral of the density; how far the mean weight of samples is from the first.
vec4 energy(vec2 st)
{
    float a = mix(0.15, 1.0, setting(st.y, A_STEPS, 1));
    float b = setting(st.y, B_STEPS, A_STEPS);
    vec3 V = view(st.x);
    vec3 eval = vec3(0.0);
    vec3 refraction = vec3(0.0);
    float density = 0.0;
    integrate(a, b, V, leaf_back(a, b, V), 1.0, eval, refraction, density);
    integrate(a, b, V, leaf_through(a, b, V), -1.0, eval, refraction, density);
    vec3 mean = vec3(0.0);
    float valid = 0.0;
    for (int i = 0; i < SAMPLES; ++i)
    {
        vec3 weight;
        float pdf;
        leaf_sample(a, b, V, even_numbers(i), weight, pdf);
        mean += weight / float(SAMPLES);
        valid += (pdf > 0.0 ? 1.0 : 0.0) / float(SAMPLES);
    }
    return vec4(largest(eval + refraction), largest(abs(leaf_albedo(a, b, V) - eval)), density - valid,
                largest(abs(mean - eval - refraction)));
}

// Relative to the greater of both: weight · pdf and the response; the density of a sample and of its direction; f(V, L) and f(L, V); and 1
// where something is negative or no number.
vec4 agreement(vec2 st)
{
    float a = mix(0.15, 1.0, setting(st.y, A_STEPS, 1));
    float b = setting(st.y, B_STEPS, A_STEPS);
    vec3 V = view(st.x);
    vec4 worst = vec4(0.0);
    for (int i = 0; i < 256; ++i)
    {
        vec3 weight;
        float pdf;
        vec3 L = leaf_sample(a, b, V, even_numbers(i), weight, pdf);
        vec3 f = leaf_eval(a, b, V, L) + leaf_refraction(a, b, V, L);
        float density = leaf_pdf(a, b, V, L);
        if (!(pdf >= 0.0) || !(min(weight.x, min(weight.y, weight.z)) >= 0.0) || !(abs(dot(L, L) - 1.0) < 1e-3 || pdf == 0.0))
            worst.a = 1.0;
        if (pdf == 0.0 || abs(L.z) < 0.02)
            continue;
        vec3 back = leaf_eval(a, b, L, V) * abs(L.z / V.z);
        worst.x = max(worst.x, largest(abs(weight * pdf - f) / max(max(f, weight * pdf), vec3(1e-4))));
        worst.y = max(worst.y, abs(pdf - density) / max(pdf, density));
        if (L.z > 0.0)
            worst.z = max(worst.z, largest(abs(f - back) / max(max(f, back), vec3(1e-3))));
    }
    return worst;
}

// A histogram of samples over the sphere for some settings: what share of them belongs in a pixel's bin, and what share fell into it.
vec4 histogram(vec2 st)
{
    int run = int(st.y * 4.0);
    float a = run == 0 ? 0.55 : run == 1 ? 0.75 : run == 2 ? 0.95 : 0.65;
    float b = run == 0 ? 0.1 : run == 1 ? 0.4 : run == 2 ? 0.6 : 0.9;
    vec3 V = view(run == 0 ? 0.15 : run == 1 ? 0.5 : run == 2 ? 0.85 : 0.4);
    ivec2 bin = ivec2(int(st.x * float(BINS_AROUND)), int((st.y * 4.0 - float(run)) * float(BINS_ALONG)));
    vec2 size = vec2(2.0 * PI / float(BINS_AROUND), 2.0 / float(BINS_ALONG));
    float expected = 0.0;
    for (int i = 0; i < 1024; ++i)
    {
        vec2 at = (vec2(float(bin.x), float(bin.y)) + (vec2(float(i & 31), float(i >> 5)) + 0.5) / 32.0) * size;
        expected += leaf_pdf(a, b, V, polar(at.y - 1.0, at.x - PI)) * size.x * size.y / 1024.0;
    }
    float got = 0.0;
    for (int i = 0; i < DRAWS; ++i)
    {
        vec3 weight;
        float pdf;
        vec3 L = leaf_sample(a, b, V, random_numbers(i), weight, pdf);
        vec2 at = vec2(atan(L.y, L.x) + PI, L.z + 1.0) / size;
        if (pdf > 0.0 && min(int(at.x), BINS_AROUND - 1) == bin.x && min(int(at.y), BINS_ALONG - 1) == bin.y)
            got += 1.0 / float(DRAWS);
    }
    return vec4(expected, got, float(run), 1.0);
}
