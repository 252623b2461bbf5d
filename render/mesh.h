// SPDX-License-Identifier: Apache-2.0
/* Triangles with vertex attributes. Meshes come from formulas (shapes.c) or files (site.h). */
#ifndef MXG_RENDER_MESH_H
#define MXG_RENDER_MESH_H

#include <mxgen/mxgen.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct vertex {
    float position[3], normal[3], tangent[3];
    float texcoord[2];
    float parameter[2]; /* surface coordinates; attributes without a file are linear in them */
};

struct mesh {
    struct vertex *vertices;
    uint32_t *indices; /* triangles, counter-clockwise seen from outside */
    uint32_t num_vertices, num_indices;
};

/* Parts that a mesh may lack; mesh_complete adds them. */
enum mesh_part { MESH_NORMALS = 1, MESH_TEXCOORDS = 2, MESH_TANGENTS = 4 };

/* Parts that some objects of a mesh lack, and those that all lack: bits of enum mesh_part. */
struct mesh_parts {
    unsigned some, all;
};

void mesh_allocate(struct mesh *mesh, uint32_t num_vertices, uint32_t num_indices);
void mesh_finish(struct mesh *mesh);

/*
 * Adds the parts of `missing`: averages normals over the triangles at a vertex, projects texture
 * coordinates along the axis that a triangle faces, derives tangents from texture coordinates,
 * which vertices of equal position, normal and texture coordinates share. Projected texture
 * coordinates need a vertex for each corner: vertex i is then the former indices[i].
 */
void mesh_complete(struct mesh *mesh, unsigned missing);
/*
 * Makes texture coordinates and tangents again, after a mesh moved that has a vertex for each
 * corner.
 */
void mesh_project(struct mesh *mesh);
/* Gives each corner a vertex of its own: vertex i is then the former indices[i]. */
void mesh_split(struct mesh *mesh);

/* The total area of the triangles. */
double mesh_area(const struct mesh *mesh);

/* The mean of the vertices. */
void mesh_centre(const struct mesh *mesh, double out[3]);

/* Moves and scales the mesh into the unit sphere about the origin. */
void mesh_fit(struct mesh *mesh);

/* Splits each triangle into four. */
void mesh_quarter(struct mesh *mesh);
/* Splits values of the vertices as mesh_quarter splits this mesh. The caller frees them. */
float (*mesh_quarter_values(const struct mesh *mesh, float (*values)[4]))[4];
/* Splits each triangle into four until there are `wanted` triangles. */
void mesh_subdivide(struct mesh *mesh, uint32_t wanted);

/*
 * Gives vertices of one position one normal and tangent, so that displacement tears no edge: the
 * mean of their normals, unless they cancel out as those of a sheet's two sides.
 */
void mesh_weld(struct mesh *mesh);

/*
 * The triangles sorted from far to near, seen from `eye` in the space of the mesh. The caller
 * frees them.
 */
uint32_t *mesh_sorted(const struct mesh *mesh, const double eye[3]);

/* shapes.c: the shape of that name; `detail` multiplies its number of cells in each direction. */
const char *const *shape_names(void); /* NULL after the last */
void shape_make(const char *name, unsigned detail, struct mesh *out);

#endif
