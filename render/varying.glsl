// SPDX-License-Identifier: Apache-2.0
// The rest of path.glsl for media that vary: that of a volume, and that inside a surface, of which scatter() tells the coefficients at a place.

#ifdef VARIES

// Ends ways through nothing, which have no end where a mesh is open: one collision in about a thousand is one of goes_on().
bool is_due()
{
    return next_random().x < 1.0 / 1024.0;
}

// After scatter() at a place.
#ifdef VOLUME
vec3 extinction_here() { return max(out10.rgb, 0.0); }
vec3 scattering_here() { return out9.rgb; }
#else
vec3 extinction_here() { return max(out14.rgb, 0.0); }
vec3 scattering_here() { return out13.rgb; }
#endif

// A collision with the majorant is one with the medium, or with nothing, which fills the medium up to the majorant: both have weights, so that the
// mean is right where the extinction is above the majorant, too (Kutz, Habel, Li, Novak 2017, "Spectral and Decomposition Tracking for Rendering
// Heterogeneous Volumes"). scatter() has run at the place. Of a real one the weight lacks the scattering.
bool is_real(inout Path path, float majorant)
{
    vec3 part = extinction_here() / majorant, rest = 1.0 - part, scattering = scattering_here();
    bool scatters = scattering.r + scattering.g + scattering.b > 0.0;
    float real = scatters ? dot(abs(path.through), part) : 0.0, none = dot(abs(path.through), abs(rest));
    float chance = real / max(real + none, 1e-30);
    bool collides = next_random().x < chance;
    path.through *= collides ? vec3(1.0 / (majorant * chance)) : rest / max(1.0 - chance, 1e-30);
    if (!collides)
        path.phase = survives(path.through, is_due()) ? GOING : ENDED;
    return collides;
}

// A tentative collision takes light from a ray to a light (Novak, Selle, Jarosz 2014, "Residual Ratio Tracking").
void pass_collision(inout Shadow ray)
{
    uint object = ray.body / 4u - 1u;
    shade_inside(object, ray.origin, ray.direction, vec4(0.0));
    ray.through *= 1.0 - extinction_here() / objects[object].majorant;
    survives(ray.through, is_due());
}

#ifndef VOLUME
// No light of a sample comes through the surface, so only the path itself goes on.
void scatter_in_solid(inout Path path)
{
    shade_inside(path.medium.body / 4u - 1u, path.origin, path.direction, vec4(0.0));
    if (!is_real(path, majorant_of(path.medium.body)))
        return;
    path.through *= out13.rgb;
    turn_inside(path, draw_phase(out13.a, path.direction, next_random().xy));
    path.phase = goes_on(path, path.medium.collisions) ? GOING : ENDED;
}
#endif

#endif
