// SPDX-License-Identifier: Apache-2.0
// The structs of the path tracer's buffers: trace.c includes this file, too, so their sizes are the same there.
#define NUM_SHADOWS 2u              // rays to lights that a path casts at once
#define NUM_RAYS (1u + NUM_SHADOWS) // that media are around: the path and its shadows
struct Node { vec3 low; uint first; vec3 high; uint count; };
struct Corner { vec4 position_s, normal_t; vec3 tangent; uint object; vec3 rest; uint triangle; vec4 moved; }; // at rest: before displacement
struct Object {
    mat4 to_object;
    uint shader, blocks_light, first_value, num_triangles; // its corners' values: of each attribute in a row
    float majorant;                  // of a medium that varies: about the most of its extinction; 0: it does not vary
    uint around_eye;                 // in number i: side_of() the i-th medium that the eye is in, from the outermost; 0: there is no more
};
struct Camera {
    vec4 eye, right, up, forward;  // a ray through (x, y), each from -1 to 1, goes along forward + x * right + y * up. eye.w: how often a path
                                   // may turn; up.w: brightness of the environment; forward.w: the most media around a path
    vec4 environment[3];           // columns: from the world to the map; [0].w: a distance that nothing has; [1].w: number of this shader
    uvec4 frame;                   // width, height, first sample, number of samples
};
struct Hit { float distance; uint triangle; vec2 weights; };
// The medium that a path is in: nothing, a solid, or the body of an object (see media.glsl). Coefficients are over a unit of the world.
struct Medium {
    vec3 extinction; uint body;      // the object, and the side where light came in, see side_of(); 0: it is nothing
    vec3 scattering; float anisotropy;
    vec3 emission; uint is_volume;   // 1: at a collision the shader of the object says what happens
    vec2 level;                      // of the pile where light came in, below 0 without matter there, and the number that picked what is there
    uint triangle, collisions;       // the path starts there; since it came in or left a surface
};
// A ray to a light, and what it brings; through: what surfaces on the way to the eye and to the light let through of that.
struct Shadow {
    vec3 origin; float limit;
    vec3 direction; uint hits;
    vec3 light; uint of;
    vec3 through; uint body;         // as of Medium
    vec3 extinction; float number;
    uint around;                     // as of Path
};
struct Path {
    vec3 origin; float density;
    vec3 direction; uint turns;
    vec3 through; uint hits;
    vec3 light; uint phase;          // that later hits send to the first one, which sends `weight` of it to the eye
    vec3 weight; uint num_shadows;
    vec3 seen; uint number;          // what the first hit sends to the eye else; number of the sample
    Medium medium;
    Hit hit;                         // of a path that waits
    Hit place; vec2 matter; float depth; uint goes; // of a path in matter: where, its level, of the level's thickness, and how
    uint side, waits_for, random, waits;            // side: where it came into the matter
    uint around;                     // so many media are around the medium
    float share;                                    // of the surface in the first hit; 0: the path has the light of an AOV
    Shadow shadows[NUM_SHADOWS];
};
