// SPDX-License-Identifier: Apache-2.0
/*
 * Before a library is written as an image, each of its shading models is generated with every input
 * variable, and what its functions became is taken down: most materials use a model that way, for
 * them the image has it ready (lang/fragment.h). And once more with nothing known of the normals
 * either: what the model and its lights became then is right for any inputs that are no constants.
 */
#include "api/generation.h"

#include <stdio.h>

static bool is_model(const struct library *lib, const struct nodedef *def)
{
    const struct port *ports = lib->ports.items + def->first_port;
    if (def->num_outputs != 1 || ports[def->num_inputs].type != DOC_TYPE_surfaceshader)
        return false;
    for (uint32_t i = def->first_impl; i != LIBRARY_NONE; i = lib->impls.items[i].next)
        if (lib->impls.items[i].kind == IMPL_GRAPH)
            return true;
    return false;
}

/*
 * Nodes of which nothing is known, for inputs that are normals and the like, and what connects
 * these inputs to them.
 */
static void write_properties(const struct library *lib, const struct nodedef *def, unsigned model,
                             struct text *nodes, struct text *inputs)
{
    const struct port *ports = lib->ports.items + def->first_port;
    for (uint32_t i = 0; i < def->num_inputs; i++) {
        if (!ports[i].geomprop)
            continue;
        const char *type = str_text(&lib->strings, library_type_name(lib, ports[i].type));
        text_fmt(nodes,
                 "<geompropvalue name=\"any%u_%u\" type=\"%s\"><input name=\"geomprop\" "
                 "type=\"string\" value=\"any%u\"/></geompropvalue>\n",
                 model, i, type, i);
        text_fmt(inputs, "<input name=\"%s\" type=\"%s\" nodename=\"any%u_%u\"/>",
                 str_text(&lib->strings, ports[i].name), type, model, i);
    }
}

static void write_model(const struct library *lib, const struct nodedef *def, const char *name,
                        unsigned number, const char *inputs, struct text *out)
{
    const char *node = str_text(&lib->strings, def->node);
    text_fmt(out, "<%s name=\"%s%u\" type=\"surfaceshader\" nodedef=\"%s\">%s</%s>\n", node, name,
             number, str_text(&lib->strings, def->name), inputs, node);
}

/* A document with two nodes of each. */
static unsigned write_models(const struct library *lib, struct text *out)
{
    unsigned count = 0;
    text_str(out, "<materialx version=\"1.39\">\n");
    for (uint32_t i = 0; i < lib->nodedefs.len; i++) {
        const struct nodedef *def = &lib->nodedefs.items[i];
        struct text inputs;
        text_init(&inputs, out->arena);
        if (!is_model(lib, def))
            continue;
        write_properties(lib, def, count, out, &inputs);
        write_model(lib, def, "model", count, "", out);
        write_model(lib, def, "open", count, text_cstr(&inputs), out);
        count++;
    }
    text_str(out, "</materialx>\n");
    return count;
}

struct rehearsal {
    struct lang_recorder *recorder;
    struct generation *generation;
    bool is_open; /* with unknown properties */
    bool failed;  /* no memory; told when nothing is held any more that a jump would forget */
};

static void record(void *arg)
{
    struct rehearsal *rehearsal = arg;
    struct generation *g = rehearsal->generation;
    if (!generation_start(g))
        return;
    rehearsal->recorder->num_globals = 0;
    rehearsal->recorder->version_ids.len = 0;
    rehearsal->recorder->of_graphs = rehearsal->is_open;
    g->result->unit.recorder = rehearsal->recorder;
    if (generation_build(g)) /* a model with errors is told when it is used */
        (void)(generation_emit(g) && generation_finish(g));
}

/* The recorder's memory is not the generation's: its jumps end here. */
static void record_safely(struct generation *g)
{
    struct rehearsal *rehearsal = g->user_data;
    rehearsal->generation = g;
    rehearsal->failed = !mem_try(rehearsal->recorder->arena->mem, record, rehearsal);
}

static void rehearse(mxg_context *context, const mxg_document *document, unsigned index,
                     struct rehearsal *rehearsal)
{
    char name[32];
    snprintf(name, sizeof name, "%s%u", rehearsal->is_open ? "open" : "model", index);
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    desc.element = name;
    mxg_result *result = NULL;
    struct mem *mem = rehearsal->recorder->arena->mem;
    jmp_buf *trap = mem->trap;
    if (generation_run(context, document, &desc, record_safely, rehearsal, &result)
        == MXG_ERROR_MEMORY)
        rehearsal->failed = true;
    mem->trap = trap; /* a jump of the generation's own passes by the trap of record_safely */
    mxg_result_destroy(result);
}

void library_rehearse(struct mxg_library *library, struct lang_recorder *recorder,
                      struct arena *arena)
{
    mxg_context *context = library->object.context;
    mxg_document *document = NULL;
    struct rehearsal rehearsal = {.recorder = recorder};
    struct text models;
    lang_recorder_init(recorder, arena, &library->layer.unit, library->layer.nodedefs.len);
    text_init(&models, arena);
    unsigned count = write_models(&library->layer, &models);
    mxg_status status =
        mxg_document_parse(context, library, "models", models.data, models.len, &document);
    rehearsal.failed = status == MXG_ERROR_MEMORY;
    for (unsigned i = 0; i < 2 * count && document && !rehearsal.failed; i++) {
        rehearsal.is_open = i >= count;
        rehearse(context, document, i % count, &rehearsal);
    }
    mxg_document_destroy(document);
    if (rehearsal.failed)
        mem_fail(arena->mem);
}
