// SPDX-License-Identifier: Apache-2.0
/* The objects of the surface, for each material; or those of a stage, each with its own. */
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

/* material NULL: none. */
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
    if (material)
        usd_put(usd, "rel material:binding = <%s>", material);
    usd_close(usd);
}

/* The extent of the surface along x. */
static double find_width(const struct writing *writing)
{
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < write_num_objects(writing); ++i) {
        const struct scene_object *object = write_object(writing, i);
        const struct matrix world = write_world(writing, object);
        for (uint32_t k = 0; k < object->mesh.num_vertices; ++k) {
            const float *at = object->mesh.vertices[k].position;
            double point[3] = {(double)at[0], (double)at[1], (double)at[2]};
            matrix_point(world, point, point);
            low = fmin(low, point[0]);
            high = fmax(high, point[0]);
        }
    }
    return high - low;
}

/* Each material, side by side, on the objects of the surface. */
static void put_samples(struct usd *usd, char *const *paths, struct name_table *names)
{
    const double step = 1.1 * find_width(usd->writing);
    const uint32_t num = write_num_objects(usd->writing);
    for (size_t m = 0; m < usd->flat->num_materials; ++m) {
        char *name = usd_name(names, usd->flat->materials[m].name);
        struct name_table objects = {0};
        usd_open(usd, "Xform", name);
        if (m) {
            usd_put(usd, "double3 xformOp:translate = (%.9g, 0, 0)", (double)m * step);
            usd_put(usd, "uniform token[] xformOpOrder = [\"xformOp:translate\"]");
        }
        for (uint32_t i = 0; i < num; ++i) {
            char *object = usd_name(&objects, num == 1 ? "mesh" : "part");
            put_mesh(usd, write_object(usd->writing, i), object, paths[m]);
            free(object);
        }
        usd_close(usd);
        names_finish(&objects);
        free(name);
    }
}

/* The objects that the look shows. A material of another model is none of the file. */
static void put_stage(struct usd *usd, char *const *paths, struct name_table *names)
{
    const struct dressed_site *stage = usd->writing->stage;
    for (uint32_t i = 0; i < stage->site.num_objects; ++i) {
        const struct site_dress *dress = dressed_site_dress(stage, 0, i);
        const struct scene_object *object = write_object(usd->writing, i);
        if (dress->is_hidden)
            continue;
        size_t material = flat_find_material(usd->flat, dress->material);
        char *name = usd_name(names, object->path + (*object->path == '/'));
        put_mesh(usd, object, name, material < usd->flat->num_materials ? paths[material] : NULL);
        free(name);
    }
}

void usd_put_objects(struct usd *usd, char *const *paths)
{
    struct name_table names = {0};
    bool is_new;
    names_add(&names, "Materials", &is_new); /* the scope beside them */
    (usd->writing->stage ? put_stage : put_samples)(usd, paths, &names);
    names_finish(&names);
}
