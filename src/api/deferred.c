// SPDX-License-Identifier: Apache-2.0
/* The deferred pipeline in a generation, for materials and for the passes that light them. */
#include "api/generation.h"

#include "parse/parse.h"
#include "slabs/bytes.h"

#include <assert.h>

static const struct lang_unit *parse_program(struct shader *shader, const struct text *text)
{
    struct lang_unit *unit = ARENA_NEW(shader->arena, struct lang_unit);
    struct diag_list faults;
    diag_list_init(&faults, shader->arena);
    lang_unit_init(unit, shader->arena, shader->strings, NULL);
    uint32_t file = lang_parse_program(unit, "mxgen", text->data, text->len, &faults);
    assert(file == 0 && !faults.num_errors);
    (void)file;
    return unit;
}

struct deferred_layout generation_storage(const struct generation *g)
{
    const struct option_value *options = g->options;
    bool is_of_rays = role_is_of_rays(g->role);
    return (struct deferred_layout){
        .storage =
            is_of_rays ? STORAGE_ROUND : (enum deferred_storage)options[OPTION_storage].number,
        .set = (uint32_t)options[OPTION_binding_set].number + 1,
        .sets = g->result->target->caps & (CAP_SETS | CAP_PROGRAM_BINDINGS),
        .has_bindings = g->result->target->syntax->in_images
                        || g->result->target->caps & (CAP_BINDINGS | CAP_PROGRAM_BINDINGS),
        .tests_late = g->result->target->tests_late,
        .any_format = g->result->target->any_format,
        .first = g->result->target->first_resource,
        .parse = g->result->target->syntax->in_images ? NULL : parse_program,
        .role = g->role,
        .diffuses = options[OPTION_sss].number != 0,
        .blurs = !is_of_rays && options[OPTION_rough_refraction].number,
        .has_occlusion = !is_of_rays && options[OPTION_occlusion_map].number,
        .has_decals = role_stores(g->role) && options[OPTION_decals].number,
    };
}

void generation_defer(struct generation *g)
{
    g->result->storage = generation_storage(g);
    if (g->stored >= CLASS_COMPLEX) {
        g->above = deferred_above(&g->result->shader);
        g->closure_host.above = &g->above;
    }
    if (role_stores(g->role)) {
        g->closure_host.store = deferred_store;
        g->closure_host.why_no_room = deferred_why_no_room;
        g->closure_host.store_data = &g->result->storage;
    }
    if (role_packs_pixel(g->role) && g->result->storage.has_decals)
        g->closure_host.painted = deferred_painted;
}

void generation_hide_misfits(struct generation *g)
{
    bool may_be_misfit = role_packs_pixel(g->role) && !g->options[OPTION_slabs].number;
    if (role_stores(g->role) && !may_be_misfit)
        g->root = build_without_hidden(g->builder, g->root);
}

static void report_misfit(struct generation *g, ir_ref misfit)
{
    const struct shader *shader = &g->result->shader;
    const struct document *doc = &g->document->layer.doc;
    uint32_t origin = ir_get(shader->graph, misfit)->origin;
    elem_id element = generation_element_of(g, origin);
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_closure_not_stored,
             doc_place(doc, element),
             str_text(shader->strings, shader->graph->origins.items[origin].name),
             str_text(doc->strings, doc_element(doc, element)->category));
}

/* The shader lights itself, because of a closure that is no slab. */
static void draw_forward(struct generation *g, ir_ref misfit)
{
    g->misfit = misfit;
    g->role = g->result->shader.role = &roles[ROLE_forward];
}

bool generation_can_store(struct generation *g)
{
    g->result->storage.max_words = g->result->slabs.after.bytes / SLAB_WORD_BYTES;
    ir_ref misfit = role_stores(g->role) ? deferred_misfit(&g->result->shader, g->root) : 0;
    if (misfit && g->role->returns == RETURNS_SLABS && g->options[OPTION_slabs].number)
        draw_forward(g, misfit);
    else if (misfit)
        report_misfit(g, misfit);
    return !misfit || g->misfit;
}

const char *generation_why_not_stored(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const struct ir_graph *graph = shader->graph;
    if (!closure_is_surface(shader, g->root))
        return "it is no surface";
    if (!g->misfit)
        return shader->reflection.not_stored;
    struct text why;
    text_init(&why, &g->scratch);
    text_fmt(
        &why, "its part '%s' is no slab",
        str_text(shader->strings, graph->origins.items[ir_get(graph, g->misfit)->origin].name));
    return text_cstr(&why);
}

void generation_tell_storage(struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    const struct document *doc = &g->document->layer.doc;
    uint32_t num_slabs = shader->reflection.stored_words && role_packs_pixel(g->role)
                             ? shader->reflection.closures.len
                             : 0;
    if (num_slabs > DEFERRED_MAX_CLOSURES)
        diag_add(&g->result->object.diagnostics.list, DIAG_ID_closures_not_stored,
                 doc_place(doc, g->element), str_text(shader->strings, shader->reflection.name),
                 (unsigned)num_slabs, (unsigned)DEFERRED_MAX_CLOSURES);
    if (shader->reflection.stored_words || (g->role->returns != RETURNS_SLABS && !g->misfit))
        return;
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_drawn_forward, doc_place(doc, g->element),
             str_text(shader->strings, shader->reflection.name), generation_why_not_stored(g));
}
