// SPDX-License-Identifier: Apache-2.0
/* The scene of pictures: a mesh, a camera that goes around it, and light from a sky or a map. */
#ifndef MXG_RENDER_STUDIO_H
#define MXG_RENDER_STUDIO_H

#include "render/scene.h"

struct studio {
    const char *mesh; /* a shape's name, or a file */
    /* of the camera, in degrees; from the front, to the right and upwards */
    double azimuth, elevation;
    /* distance 0: the mesh fills the picture; degrees across the shorter side */
    double distance, fov;
    /*
     * file of a latitude-longitude map, or folder of baked ones; NULL: the built-in sky, and lights
     */
    const char *environment;
    bool prefiltered; /* shaders read maps that are filtered for their roughness */
};

#define STUDIO_DEFAULTS \
    { \
        .mesh = "ball", .azimuth = 25, .elevation = 16, .fov = 30 \
    }

struct studio_fault {
    const char *id;
    char text[512];
};

/* "AZIMUTH,ELEVATION[,DISTANCE[,FOV]]"; false where it is not. */
bool studio_parse_camera(struct studio *studio, const char *text);

/*
 * Makes the scene. *out_made: parts that the mesh's file lacks. scene_finish must follow in any
 * case.
 */
bool studio_open(const struct studio *studio, double aspect, struct scene *scene,
                 unsigned *out_made, struct studio_fault *fault);

/* Puts the camera where `studio` says, `turn` degrees further around. */
void studio_aim(const struct studio *studio, double aspect, double turn, struct scene *scene);

/* Reads the map that `studio` names, or makes the sky. */
bool studio_read_map(const struct studio *studio, struct image *out, struct studio_fault *fault);

/* The same mesh in triangles small enough to be displaced. */
bool studio_refine(const struct studio *studio, const struct mesh *mesh, struct mesh *out);

#endif
