// SPDX-License-Identifier: Apache-2.0
/*
 * A file of glTF as `--stage` and `--mesh` read it: what comes of it are triangles of finite
 * vertices, with a value of each primvar for each of them, or one for all.
 */
#include "fuzz.h"

#include "program/files.h"
#include "program/scratch.h"
#include "render/site.h"

#include <math.h>

static void require_object(const struct scene_object *object)
{
    const struct mesh *mesh = &object->mesh;
    FUZZ_REQUIRE(mesh->num_indices && mesh->num_indices % 3 == 0);
    for (uint32_t i = 0; i < mesh->num_indices; i++)
        FUZZ_REQUIRE(mesh->indices[i] < mesh->num_vertices);
    for (uint32_t v = 0; v < mesh->num_vertices; v++)
        for (size_t i = 0; i < 3; i++)
            FUZZ_REQUIRE(isfinite(mesh->vertices[v].position[i]));
    for (uint32_t i = 0; i < object->num_primvars; i++)
        FUZZ_REQUIRE(object->primvars[i].num == mesh->num_vertices || object->primvars[i].num == 1);
}

static void read_stage(struct cli *cli, const char *path)
{
    struct site site;
    bool good = site_open(&site, cli, path, NULL);
    FUZZ_REQUIRE(good == (cli->report.errors == 0));
    for (uint32_t i = 0; good && i < site.num_objects; i++)
        require_object(&site.objects[i].object);
    site_close(&site);
}

static void read_mesh(struct cli *cli, const char *path)
{
    struct scene_object object;
    struct mesh_parts made;
    uint32_t errors = cli->report.errors;
    bool good = site_open_mesh(cli, path, &object, &made);
    FUZZ_REQUIRE(good == (cli->report.errors == errors));
    if (good)
        require_object(&object);
    object_finish(&object);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    static const struct command command = {"render", "FILE", "", NULL, NULL};
    struct scratch scratch;
    struct cli cli;
    int code;
    (void)heap; /* programs end where memory is exhausted */
    FUZZ_REQUIRE(scratch_make(&scratch));
    char *input = cli_format("%s/in.gltf", scratch.path);
    char *arguments[] = {"render", input, "-q", "--sandbox", NULL};
    FUZZ_REQUIRE(!files_write(input, data, size));
    FUZZ_REQUIRE(cli_start(&cli, &command, NULL, 0, CLI_LIBRARY_IS_INPUT, 4, arguments, &code));
    read_stage(&cli, input);
    read_mesh(&cli, input);
    cli_finish(&cli);
    free(input);
    scratch_remove(&scratch);
}
