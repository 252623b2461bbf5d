// SPDX-License-Identifier: Apache-2.0
/*
 * Functions of libraries in a module beside the shaders, in languages that have modules. Their
 * names follow from the libraries alone, so a shader and the module agree on them.
 */
#include "shader/names.h"
#include "shader/shader.h"
#include "tree/ast.h"
#include "tree/shared_functions.h"

/* "mx_burn", and of a second function of this name "mx_burn_vec3", by its first parameter. */
static struct spell_name name_function(const struct shader *shader, struct name_set *names,
                                       uint32_t id)
{
    const struct lang_unit *layer;
    const struct lang_function *fn = lang_function(shader->unit, id, &layer);
    struct text name;
    text_init(&name, shader->arena);
    text_str(&name, str_text(shader->strings, fn->name));
    if (fn->num_params && !names_is_free(names, name.data, name.len))
        text_fmt(&name, "_%s", ir_type_text(ast_slot(layer, fn, 0)->type));
    return names_unique(names, text_cstr(&name), name.len);
}

/* By id: `qualifier` and the name in the module of each function that it has, NULL of others. */
static const char *const *name_functions(const struct shader *shader, uint32_t num,
                                         const char *qualifier)
{
    const bool *shared = lang_find_shared(shader->unit, num, shader->arena);
    const char **out = ARENA_ARRAY(shader->arena, const char *, num + 1);
    struct name_set names;
    names_init(&names, shader->arena, shader->style->syntax);
    for (uint32_t id = 0; id < num; id++) {
        if (!shared[id])
            continue;
        struct spell_name unique = name_function(shader, &names, id);
        struct text full;
        text_init(&full, shader->arena);
        text_str(&full, qualifier);
        text_mem(&full, unique.text, unique.len);
        out[id] = text_cstr(&full);
    }
    return out;
}

void shader_import_module(struct shader *shader, const char *name, uint32_t num_functions)
{
    struct text qualifier;
    text_init(&qualifier, shader->arena);
    text_fmt(&qualifier, "%s" LANG_OF_MODULE, name);
    shader->module.name = name;
    shader->unit->module = name_functions(shader, num_functions, text_cstr(&qualifier));
    shader->unit->num_module = num_functions;
}

void shader_become_module(struct shader *shader)
{
    struct lang_unit *unit = shader->unit;
    uint32_t num = unit->num_module;
    const char *const *functions = name_functions(shader, num, "");
    unit->num_module = 0; /* nobody else has the functions */
    for (uint32_t id = 0; id < num; id++)
        if (functions[id])
            lang_reach_add(&shader->stages[STAGE_PIXEL].reach, unit, id);
    unit->module = functions;
    unit->num_module = num;
    shader->module.is_shader = true;
}
