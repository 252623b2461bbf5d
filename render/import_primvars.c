// SPDX-License-Identifier: Apache-2.0
#include "render/import_primvars.h"

#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>

float (*import_add_primvar(struct scene_object *object, enum import_family family, unsigned set))[4]
{
    static const struct {
        const char *name, *type;
        unsigned components;
    } families[] = {
        [IMPORT_TEXCOORDS] = {"st", "float2", 2}, [IMPORT_COLORS] = {"displayColor", "float4", 4}};
    char *name = set ? cli_format("%s%u", families[family].name, set)
                     : cli_format("%s", families[family].name);
    struct primvar *added =
        object_add_primvar(object, name, families[family].type, families[family].components);
    free(name);
    return added->values;
}
