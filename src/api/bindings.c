// SPDX-License-Identifier: Apache-2.0
/* Bindings: the layers of the primitives of a scene under a look. */
#include "api/scene.h"
#include "bind/drive.h"

#include <assert.h>

struct bind_job {
    mxg_bindings *result;
    mxg_bindings_desc desc;
    struct arena scratch;
};

static void resolve(void *arg)
{
    struct bind_job *job = arg;
    mxg_bindings *result = job->result;
    struct object *object = &result->object;
    const struct library *lib = &result->document->layer;
    const struct document *doc = &lib->doc;
    const struct bind_options options = {.solo = job->desc.solo,
                                         .mute = job->desc.mute,
                                         .num_solo = job->desc.num_solo,
                                         .num_mute = job->desc.num_mute};
    struct diag_list *diags = &object->diagnostics.list;
    const struct scene *scene = &result->scene->scene;
    /*
     * A stage of USD says itself what is bound, and may bind nothing; so does one without any
     * document. Beside bindings of the stage nobody has to choose one of several looks.
     */
    uint32_t num_looks = look_count(doc);
    bool is_said = scene->num_bindings || scene->layer.prims.len;
    bool needs_look = job->desc.look || num_looks == 1
                      || (num_looks ? !scene->num_bindings
                                    : !is_said && doc_element(doc, doc->root)->first_child);
    elem_id look = needs_look ? look_choose(doc, job->desc.look, diags) : 0;
    if (needs_look && !look)
        return;
    const mxg_bindings *previous = job->desc.previous;
    const struct bindings *before = NULL, *facts = NULL;
    if (previous && previous->is_resolved) {
        before = &previous->bindings;
        facts = previous->facts.states.len ? &previous->facts : NULL;
    }
    bind_resolve(&result->bindings, lib, look, scene, before, &options, &object->arena,
                 &job->scratch, diags);
    bind_facts(&result->facts, lib, look, scene, facts, &object->arena, &job->scratch, diags);
    if (!options.num_solo && !options.num_mute)
        bind_check_drives(&result->bindings, lib, &job->scratch, diags);
    result->is_resolved = true;
}

/* The instances that the document names become primitives: a change of the scene. */
static void add_instances(void *arg)
{
    struct bind_job *job = arg;
    struct mxg_scene *scene = job->result->scene;
    uint32_t num = scene->scene.prims.len;
    scene_add_instances(&scene->scene, &job->result->document->layer.doc);
    scene->version += scene->scene.prims.len != num;
}

mxg_status mxg_bindings_create(mxg_context *context, const mxg_document *document, mxg_scene *scene,
                               const mxg_bindings_desc *desc, mxg_bindings **out_bindings)
{
    struct bind_job job = {.desc = MXG_BINDINGS_DESC_INIT};
    if (out_bindings)
        *out_bindings = NULL;
    if (!context || !document || !scene || !out_bindings
        || (desc && !struct_read(&job.desc, sizeof job.desc, desc))
        || (job.desc.previous && job.desc.previous->scene != scene))
        return MXG_ERROR_ARGUMENT;
    struct object *below = (struct object *)(uintptr_t)&document->object; /* never const itself */
    mxg_bindings *result = object_new(context, sizeof *result, below);
    if (!result)
        return MXG_ERROR_MEMORY;
    result->document = document;
    result->scene = scene;
    object_ref(&scene->object);
    job.result = result;
    arena_init(&job.scratch, &result->object.mem);
    mxg_status status = scene_has_instancers(&scene->scene)
                            ? object_run(&scene->object, add_instances, &job)
                            : MXG_OK;
    result->version = scene->version;
    if (status == MXG_OK)
        status = object_run(&result->object, resolve, &job);
    arena_finish(&job.scratch);
    bindings_finish(&result->bindings);
    bindings_finish(&result->facts);
    object_settle(&result->object);
    if (status != MXG_OK) {
        mxg_bindings_destroy(result);
        return status;
    }
    *out_bindings = result;
    return object_status(&result->object);
}

void mxg_bindings_destroy(mxg_bindings *bindings)
{
    if (!bindings)
        return;
    mxg_scene *scene = bindings->scene;
    object_unref(&bindings->object);
    object_unref(&scene->object);
}

const mxg_diagnostics *mxg_bindings_diagnostics(const mxg_bindings *bindings)
{
    return bindings ? &bindings->object.diagnostics : NULL;
}

/* ---- Queries ---- */

/* True if there are layers, of the scene as it is. */
static bool is_valid(const mxg_bindings *bindings)
{
    return bindings && bindings->is_resolved && bindings->version == bindings->scene->version;
}

/* The state of a primitive by its number in the interface; NULL: there is none. */
static const struct bind_state *state_of(const mxg_bindings *bindings, uint32_t primitive)
{
    if (!is_valid(bindings) || !has_primitive(bindings->scene, primitive))
        return NULL;
    return bind_state_of(&bindings->bindings, primitive + 1);
}

uint32_t mxg_bindings_num_layers(const mxg_bindings *bindings, uint32_t primitive)
{
    const struct bind_state *state = state_of(bindings, primitive);
    return state ? state->num_items : 0;
}

static mxg_layer describe(const struct bindings *b, prim_id prim, const struct bind_item *item)
{
    static const mxg_layer_kind kinds[] = {
        [ITEM_LAYER] = MXG_LAYER,
        [ITEM_PRODUCT] = MXG_LAYER_PRODUCT,
        [ITEM_OVERRIDE] = MXG_LAYER_OVERRIDE,
        [ITEM_VERTICAL] = MXG_LAYER_VERTICAL,
        [ITEM_VOLUME] = MXG_LAYER_VOLUME,
        [ITEM_LIGHT] = MXG_LAYER_LIGHT,
    };
    const struct document *doc = b->look.doc;
    const struct look_assign *a = &b->look.assigns.items[item->assign];
    struct diag_place place = look_assign_place(&b->look, a);
    prim_id from = bind_prim_at(b, prim, item->level);
    return (mxg_layer){
        .kind = kinds[item->kind],
        .slot = b->look.names.items[a->name].text,
        .material = doc_name(doc, a->target),
        .is_nodegraph = a->kind == ASSIGN_GRAPH,
        .product = item->kind == ITEM_PRODUCT ? bind_product_names[item->product] : "",
        .from = from ? from - 1 : MXG_NONE,
        .look = a->look ? doc_name(doc, a->look) : "",
        .assign = a->binding ? b->scene->bindings.items[a->binding - 1].property
                             : doc_name(doc, a->element),
        .file = place.file ? place.file : "",
        .line = place.line,
    };
}

mxg_status mxg_bindings_layer(const mxg_bindings *bindings, uint32_t primitive, uint32_t index,
                              mxg_layer *out)
{
    if (index >= mxg_bindings_num_layers(bindings, primitive))
        return MXG_ERROR_ARGUMENT;
    const struct bindings *b = &bindings->bindings;
    const struct bind_item *items = &b->items.items[state_of(bindings, primitive)->first_item];
    mxg_layer full = describe(b, primitive + 1, &items[index]);
    return struct_write(out, &full, sizeof full);
}

uint32_t mxg_bindings_num_stacks(const mxg_bindings *bindings)
{
    return is_valid(bindings) ? bindings->bindings.stacks.len : 0;
}

uint32_t mxg_bindings_num_resolved_primitives(const mxg_bindings *bindings)
{
    return bindings && bindings->is_resolved ? bindings->bindings.num_resolved : 0;
}

uint32_t mxg_bindings_stack(const mxg_bindings *bindings, uint32_t primitive)
{
    const struct bind_state *state = state_of(bindings, primitive);
    return state ? state->stack : MXG_NONE;
}

size_t mxg_bindings_stack_name(const mxg_bindings *bindings, uint32_t stack, char *buffer,
                               size_t capacity)
{
    char name[BIND_STACK_NAME_SIZE];
    if (stack >= mxg_bindings_num_stacks(bindings))
        return 0;
    bind_stack_name(&bindings->bindings, stack, name);
    return text_copy(name, strlen(name), buffer, capacity);
}

/* ---- Facts ---- */

static const struct bind_state *facts_of(const mxg_bindings *bindings, uint32_t primitive)
{
    bool has_facts = state_of(bindings, primitive) && bindings->facts.states.len;
    return has_facts ? bind_state_of(&bindings->facts, primitive + 1) : NULL;
}

uint32_t mxg_bindings_num_facts(const mxg_bindings *bindings, uint32_t primitive)
{
    const struct bind_state *state = facts_of(bindings, primitive);
    return state ? state->num_items : 0;
}

mxg_status mxg_bindings_fact(const mxg_bindings *bindings, uint32_t primitive, uint32_t index,
                             mxg_fact *out)
{
    _Static_assert((int)MXG_FACT_VISIBILITY == FACT_VISIBILITY, "facts have the same numbers");
    if (index >= mxg_bindings_num_facts(bindings, primitive))
        return MXG_ERROR_ARGUMENT;
    const struct bindings *b = &bindings->facts;
    const struct bind_item *item =
        &b->items.items[facts_of(bindings, primitive)->first_item + index];
    const struct document *doc = b->look.doc;
    const struct look_assign *assign = &b->look.assigns.items[item->assign];
    elem_id fact = assign->target;
    bool is_visibility = bind_fact_kind(doc, fact) == FACT_VISIBILITY;
    struct diag_place place = doc_place(doc, fact);
    prim_id from = bind_prim_at(b, primitive + 1, item->level);
    mxg_fact full = {
        .kind = (mxg_fact_kind)bind_fact_kind(doc, fact),
        .name = bind_fact_name(doc, fact),
        .type =
            is_visibility ? "boolean" : str_text(doc->strings, doc_attr_value(doc, fact, STR_type)),
        .value = assign->value ? assign->value
                               : str_text(doc->strings, doc_attr_value(doc, fact, STR_value)),
        .target = assign->fact_target,
        .from = from ? from - 1 : MXG_NONE,
        .file = place.file,
        .line = place.line,
    };
    return struct_write(out, &full, sizeof full);
}

/* ---- Texts ---- */

struct write_job {
    const mxg_bindings *bindings;
    mxg_bindings_format format;
    uint32_t primitive;
    bool (*write)(void *user_data, const char *data, size_t size);
    void *user_data;
    bool is_stopped;
    uint32_t num_lost;
};

static void flush_text(void *user_data, struct text *out)
{
    struct write_job *job = user_data;
    if (!job->is_stopped && out->len)
        job->is_stopped = !job->write(job->user_data, out->data, out->len);
    out->len = 0;
}

static void write_all(void *arg, struct arena *scratch)
{
    struct write_job *job = arg;
    struct text out;
    text_init(&out, scratch);
    struct bind_writer writer = {.b = &job->bindings->bindings,
                                 .out = &out,
                                 .scratch = scratch,
                                 .flush = flush_text,
                                 .user_data = job,
                                 .colour = job->format == MXG_BINDINGS_TABLE_COLOUR};
    bind_writer_init(&writer);
    switch (job->format) {
    case MXG_BINDINGS_JSON: bind_write_json(&writer); break;
    case MXG_BINDINGS_USDA: job->num_lost = bind_write_usda(&writer); break;
    default: bind_write_table(&writer); break;
    }
    flush_text(job, &out);
}

mxg_status mxg_bindings_write(const mxg_bindings *bindings, mxg_bindings_format format,
                              bool (*write)(void *user_data, const char *data, size_t size),
                              void *user_data)
{
    if (!is_valid(bindings) || !write || (unsigned)format > MXG_BINDINGS_USDA)
        return MXG_ERROR_ARGUMENT;
    struct write_job job = {bindings, format, 0, write, user_data, false, 0};
    mxg_status status = context_run(bindings->object.context, write_all, &job);
    return status == MXG_OK && job.num_lost ? MXG_ERROR_DOCUMENT : status;
}

static void write_reasons(void *arg, struct arena *scratch)
{
    struct write_job *job = arg;
    struct text out;
    text_init(&out, scratch);
    bind_explain(&job->bindings->bindings, job->primitive + 1, scratch, &out);
    flush_text(job, &out);
}

mxg_status mxg_bindings_write_reasons(const mxg_bindings *bindings, uint32_t primitive,
                                      bool (*write)(void *user_data, const char *data, size_t size),
                                      void *user_data)
{
    if (!state_of(bindings, primitive) || !write)
        return MXG_ERROR_ARGUMENT;
    struct write_job job = {bindings, MXG_BINDINGS_TABLE, primitive, write, user_data, false, 0};
    return context_run(bindings->object.context, write_reasons, &job);
}
