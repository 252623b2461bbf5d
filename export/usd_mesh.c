// SPDX-License-Identifier: Apache-2.0
/* The objects of the surface, for each material. */
#include "export/usd.h"

#include <math.h>
#include <stdlib.h>

/* Writes an attribute that has rows of numbers. */
static void put_rows(struct usd *usd, const char *declaration, const float *values, size_t stride,
                     uint32_t num, unsigned width)
{
    fprintf(usd->out, "%*s%s = [", (int)usd->depth * 4, "", declaration);
    for (uint32_t i = 0; i < num; ++i) {
        fputs(i ? ", " : "", usd->out);
        usd_put_numbers(usd, (const float *)(const void *)((const char *)values + i * stride),
                        width);
    }
    fputs("]", usd->out);
}

static void put_mesh(struct usd *usd, const struct scene_object *object, const char *name,
                     const char *material)
{
    const struct mesh *mesh = &object->mesh;
    const size_t stride = sizeof *mesh->vertices;
    usd_put(usd, "def Mesh \"%s\" (", name);
    usd_put(usd, "    prepend apiSchemas = [\"MaterialBindingAPI\"]");
    usd_put(usd, ")");
    usd_put(usd, "{");
    ++usd->depth;
    put_rows(usd, "point3f[] points", mesh->vertices->position, stride, mesh->num_vertices, 3);
    fputc('\n', usd->out);
    put_rows(usd, "normal3f[] normals", mesh->vertices->normal, stride, mesh->num_vertices, 3);
    fputs(" (interpolation = \"vertex\")\n", usd->out);
    put_rows(usd, "texCoord2f[] primvars:st", mesh->vertices->texcoord, stride, mesh->num_vertices,
             2);
    fputs(" (interpolation = \"vertex\")\n", usd->out);
    fprintf(usd->out, "%*sint[] faceVertexCounts = [", (int)usd->depth * 4, "");
    for (uint32_t i = 0; i < mesh->num_indices / 3; ++i)
        fputs(i ? ", 3" : "3", usd->out);
    fprintf(usd->out, "]\n%*sint[] faceVertexIndices = [", (int)usd->depth * 4, "");
    for (uint32_t i = 0; i < mesh->num_indices; ++i)
        fprintf(usd->out, "%s%u", i ? ", " : "", mesh->indices[i]);
    fputs("]\n", usd->out);
    usd_put(usd, "uniform token subdivisionScheme = \"none\"");
    fprintf(usd->out, "%*smatrix4d xformOp:transform = (", (int)usd->depth * 4, "");
    const struct matrix world = write_world(usd->writing, object);
    for (size_t c = 0; c < 4; ++c) { /* USD has row vectors: its rows are our columns */
        const double *m = world.m[c];
        fprintf(usd->out, "%s(%.7g, %.7g, %.7g, %.7g)", c ? ", " : "", m[0], m[1], m[2], m[3]);
    }
    fputs(")\n", usd->out);
    usd_put(usd, "uniform token[] xformOpOrder = [\"xformOp:transform\"]");
    usd_put(usd, "rel material:binding = <%s>", material);
    usd_close(usd);
}

/* The extent of the surface along x. */
static double find_width(const struct writing *writing)
{
    const struct bake_surface *surface = writing->surface;
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < surface->num_objects; ++i) {
        const struct matrix world = write_world(writing, &surface->objects[i]);
        for (uint32_t k = 0; k < surface->objects[i].mesh.num_vertices; ++k) {
            const float *at = surface->objects[i].mesh.vertices[k].position;
            double point[3] = {(double)at[0], (double)at[1], (double)at[2]};
            matrix_point(world, point, point);
            low = fmin(low, point[0]);
            high = fmax(high, point[0]);
        }
    }
    return high - low;
}

void usd_put_objects(struct usd *usd, char *const *paths)
{
    const struct bake_surface *surface = usd->writing->surface;
    const double step = 1.1 * find_width(usd->writing);
    struct name_table names = {0};
    bool is_new;
    names_add(&names, "Materials", &is_new); /* the scope beside them */
    for (size_t m = 0; m < usd->flat->num_materials; ++m) {
        char *name = usd_name(&names, usd->flat->materials[m].name);
        struct name_table objects = {0};
        usd_open(usd, "Xform", name);
        if (m) {
            usd_put(usd, "double3 xformOp:translate = (%.9g, 0, 0)", (double)m * step);
            usd_put(usd, "uniform token[] xformOpOrder = [\"xformOp:translate\"]");
        }
        for (uint32_t i = 0; i < surface->num_objects; ++i) {
            char *object = usd_name(&objects, surface->num_objects == 1 ? "mesh" : "part");
            put_mesh(usd, &surface->objects[i], object, paths[m]);
            free(object);
        }
        usd_close(usd);
        names_finish(&objects);
        free(name);
    }
    names_finish(&names);
}
