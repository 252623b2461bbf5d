// SPDX-License-Identifier: Apache-2.0
/*
 * Triangles with what shaders read at their corners. Meshes are made by formulas (shapes.c) or read
 * from files (import.c).
 */
#ifndef MXG_RENDER_MESH_H
#define MXG_RENDER_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct vertex {
    float position[3], normal[3], tangent[3];
    float texcoord[2];
    float parameter[2]; /* of the surface: what attributes of no file are linear in */
};

struct mesh {
    struct vertex *vertices;
    uint32_t *indices; /* triangles, counter-clockwise from outside */
    uint32_t num_vertices, num_indices;
};

/* What a mesh may lack and gets made. */
enum mesh_part { MESH_NORMALS = 1, MESH_TEXCOORDS = 2, MESH_TANGENTS = 4 };

bool mesh_allocate(struct mesh *mesh, uint32_t num_vertices, uint32_t num_indices);
void mesh_finish(struct mesh *mesh);

/*
 * Makes the parts of `missing`: normals are averaged over the triangles at a vertex, texture
 * coordinates projected along the axis that a triangle faces, tangents follow the texture
 * coordinates. False: out of memory.
 */
bool mesh_complete(struct mesh *mesh, unsigned missing);

/* The sum of the triangles' areas. */
double mesh_area(const struct mesh *mesh);

/* Moves and scales the mesh into the unit sphere about the origin. */
void mesh_fit(struct mesh *mesh);

/* Cuts each triangle into four until there are `wanted` of them. False: out of memory. */
bool mesh_subdivide(struct mesh *mesh, uint32_t wanted);

/*
 * Indices of the triangles from the farthest to the nearest to `eye`, in the mesh's space; malloc,
 * NULL: out of memory.
 */
uint32_t *mesh_sorted(const struct mesh *mesh, const double eye[3]);

/* shapes.c: the shape of that name; `detail` multiplies its number of cells each way. */
const char *const *shape_names(void); /* NULL behind the last */
bool shape_make(const char *name, unsigned detail, struct mesh *out);

/*
 * import.c: reads a file of OBJ, glTF or another form that Assimp knows. Parts that it made are
 * told in *out_made. On failure false, with an id and a text of what is wrong.
 */
struct mesh_fault {
    const char *id;
    char text[256];
};
bool mesh_import(const char *path, struct mesh *out, unsigned *out_made, struct mesh_fault *fault);

#endif
