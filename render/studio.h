// SPDX-License-Identifier: Apache-2.0
/* The default scene: a mesh, an orbiting camera, and light from a sky or a map. */
#ifndef MXG_RENDER_STUDIO_H
#define MXG_RENDER_STUDIO_H

#include "program/cli.h"
#include "render/scene.h"

#include <mxgen/mxgen.h>

struct studio {
    const char *mesh; /* the name of a shape or a file */
    /* camera angles in degrees; from the front, to the right and upwards */
    double azimuth, elevation;
    /* distance 0: the mesh fills the picture; fov in degrees across the shorter side */
    double distance, fov;
    /* file of a latitude-longitude map, or a baked folder; NULL: the built-in sky with lights */
    const char *environment;
    bool prefiltered; /* shaders read prefiltered maps */
    struct cli *cli;  /* reads meshes, and reports their faults */
};

#define STUDIO_DEFAULTS \
    { \
        .mesh = "ball", .azimuth = 25, .elevation = 16, .fov = 30 \
    }

struct studio_fault {
    const char *id;
    char text[512];
};

/* Parses "AZIMUTH,ELEVATION[,DISTANCE[,FOV]]"; false if invalid. */
bool studio_parse_camera(struct studio *studio, const char *text);

/*
 * Makes the scene. *out_made: the parts that the mesh lacked. false after a fault, or after
 * reporting an error: the fault then has no id. Call scene_finish in any case.
 */
bool studio_open(const struct studio *studio, double aspect, struct scene *scene,
                 struct mesh_parts *out_made, struct studio_fault *fault);

/*
 * Opens a studio without a mesh: light, and the environment. `map` is the environment, which the
 * scene takes; without pixels: that of the studio.
 */
bool studio_open_light(const struct studio *studio, struct image map, struct scene *scene,
                       struct studio_fault *fault);

/* Places the camera as `studio` describes, rotated by `turn` degrees. */
void studio_aim(const struct studio *studio, double aspect, double turn, struct scene *scene);

/* Reads the map of `studio`, or makes the sky. */
bool studio_read_map(const struct studio *studio, struct image *out, struct studio_fault *fault);

/* Splits the triangles of a mesh until they are small enough for displacement. */
void studio_refine(const struct studio *studio, const struct mesh *mesh, struct mesh *out);

#endif
