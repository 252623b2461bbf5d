// SPDX-License-Identifier: Apache-2.0
// Glints: an interface of a finite number of flat facets. A pixel sees the facets in its footprint; those that mirror a light to the viewer are
// so many times more, or fewer, than on an interface of countless facets. docs/slabs.md, "Glints".

// Three random numbers in [0, 1): the function pcg3d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
vec3 mx_glint_random(uvec3 key)
{
    uvec3 v = key * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3(v >> 8u) * (1.0 / 16777216.0);
}

// A number of facets whose mean is `mean`, over that mean. It has the chance of no facet, the mean and the variance of Poisson's distribution:
// where there are facets, xi spreads evenly, as wide as the variance needs.
float mx_glint_count(float mean, float xi)
{
    float some = mean < 0.01 ? mean - 0.5 * mean * mean : 1.0 - exp(-mean);
    float variance = max((1.0 + 1.0 / mean) * some - 1.0, 0.0); // of the number over its mean, where there are facets: 0.3 at most
    return xi < some ? (1.0 + sqrt(3.0 * variance) * (2.0 * xi / some - 1.0)) / some : 0.0;
}

// Facets of one normal, in steps of slope over roughness. A smaller step gives fewer and brighter glints.
const float MX_GLINT_STEP = 0.0625;

// The facets of a cell of the surface that have the slope. Each cell divides slopes by a grid of its own; one facet lights a square of it, more
// and more evenly the more facets there are.
float mx_glint_cell(vec2 place, vec2 size, vec2 level, vec2 slope, float density)
{
    vec3 shift = mx_glint_random(uvec3(ivec3(ivec2(place), int(level.x) * 64 + int(level.y))));
    vec2 at = slope / MX_GLINT_STEP + shift.xy;
    vec2 part = fract(at);
    float xi = mx_glint_random(uvec3(uvec2(ivec2(floor(at))), uint(shift.z * 16777216.0))).x;
    // GGX as a distribution of slopes (Heitz 2014, equation 85). Where it is low glints fade instead of getting ever rarer.
    float spread = 1.0 + dot(slope, slope);
    float share = MX_GLINT_STEP * MX_GLINT_STEP / (3.14159265 * min(spread * spread, 100.0));
    float mean = max(size.x * size.y * exp(density), 1.0) * share;
    vec2 slant = 1.0 - abs(2.0 * part - 1.0);
    return mx_glint_count(mean, xi) * mix(1.0, 4.0 * slant.x * slant.y, exp(-mean));
}

// The cells of one size at a point, in the triangle around it.
float mx_glint_level(vec2 level, vec2 slope, float density, vec2 uv)
{
    vec2 size = exp2(level);
    vec2 at = uv / size;
    vec2 place = floor(at);
    vec2 part = at - place;
    bool is_far = part.x + part.y > 1.0;
    vec3 corner = is_far ? vec3(1.0, 1.0, part.x + part.y - 1.0) : vec3(0.0, 0.0, 1.0 - part.x - part.y);
    vec2 weights = is_far ? 1.0 - part.yx : part;
    return corner.z * mx_glint_cell(place + corner.xy, size, level, slope, density)
         + weights.x * mx_glint_cell(place + vec2(1.0, 0.0), size, level, slope, density)
         + weights.y * mx_glint_cell(place + vec2(0.0, 1.0), size, level, slope, density);
}

// How many facets of a pixel have a slope, over the mean. Cells have the size of the footprint along u and v, or of one facet where it is
// smaller: the two next powers of two, in the triangle of the plane of both.
// slope: of the facet over the roughness; density: logarithm of the facets in a unit of uv; footprint: change of uv by a pixel, along x and y
float mx_glints(vec2 slope, float density, vec2 uv, vec4 footprint)
{
    vec2 extent = max(abs(footprint.xy), abs(footprint.zw));
    vec2 level = log2(max(extent, exp(-0.5 * density)));
    vec2 low = floor(level);
    vec2 part = level - low;
    vec2 side = part.x > part.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    float least = min(part.x, part.y);
    float most = max(part.x, part.y);
    return (1.0 - most) * mx_glint_level(low, slope, density, uv) + (most - least) * mx_glint_level(low + side, slope, density, uv)
         + least * mx_glint_level(low + 1.0, slope, density, uv);
}

// ---- one facet after the other ---------------------------------------------------------------------------------------
// Closures of a renderer do not know the light, so facets cannot be counted for it. The renderer takes many points in a pixel instead, and
// each has the facet where it lies.

// A pixel with more facets has the lobe of countless ones: a direction has more than 100 of them (MX_GLINT_STEP), so pixels stray from the
// lobe by 4 to 6 % (standard deviation), less than the noise of the renderer's own points; by 2 % with 1e6 facets.
const float MX_GLINT_COUNTLESS = 1e5;

// Whether a pixel with this footprint sees few enough facets to draw each.
bool mx_glint_has_facets(float density, vec4 footprint)
{
    float area = abs(footprint.x * footprint.w - footprint.y * footprint.z);
    return density > 0.0 && dot(footprint, footprint) > 0.0 && area * exp(density) < MX_GLINT_COUNTLESS;
}

// The normal of the facet at `uv`, above the plane z = 0: of GGX, as often as its share of the plane (Walter et al. 2007, equations 35 and 36).
vec3 mx_glint_facet(vec2 alpha, float density, vec2 uv)
{
    vec3 xi = mx_glint_random(uvec3(ivec3(ivec2(floor(uv * exp(0.5 * density))), 0)));
    float turn = 2.0 * 3.14159265 * xi.y;
    return normalize(vec3(sqrt(xi.x / (1.0 - xi.x)) * alpha * vec2(cos(turn), sin(turn)), 1.0));
}
