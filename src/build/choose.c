// SPDX-License-Identifier: Apache-2.0
/* Chooses the definition of a node, and the implementation of a definition for the target. */
#include "build/build_priv.h"

/*
 * 0: not for this target. Higher is better: the target itself, then inherited targets, then
 * portable, then for another target but portable.
 */
static unsigned fitness(const struct builder *b, const struct implementation *impl)
{
    if (!impl->target)
        return 2;
    bool is_portable = impl->kind == IMPL_GRAPH || library_is_portable(b->lib, impl);
    unsigned num = is_portable ? b->options->num_targets : b->options->num_languages;
    for (unsigned i = 0; i < num; i++)
        if (b->options->targets[i] == impl->target)
            return 3 + b->options->num_targets - i;
    return library_is_portable(b->lib, impl) ? 1 : 0;
}

struct choice {
    const struct implementation *best, *needy;
    unsigned fitness; /* of the best */
};

/* Source that needs a prelude gives way to any other implementation. */
static void consider(const struct builder *b, const struct implementation *impl,
                     struct choice *choice)
{
    unsigned f = fitness(b, impl);
    if (f > choice->fitness && build_uses_prelude(b, impl)) {
        choice->needy = choice->needy ? choice->needy : impl;
    } else if (f > choice->fitness) {
        choice->best = impl;
        choice->fitness = f;
    }
}

const struct implementation *build_best_implementation(struct builder *b, uint32_t nodedef)
{
    const struct implementation *code = code_implementation(b, nodedef);
    if (code)
        return code;
    struct choice choice = {0};
    /* Higher layers first: a document's implementation wins over the library's of equal fitness. */
    for (const struct library *layer = b->lib; layer; layer = layer->base) {
        for (uint32_t i = library_first_override(layer, nodedef); i != LIBRARY_NONE;) {
            const struct implementation *impl = library_impl(b->lib, i, NULL);
            assert(impl->nodedef == nodedef);
            consider(b, impl, &choice);
            i = impl->next;
        }
    }
    for (uint32_t i = library_nodedef(b->lib, nodedef)->first_impl; i != LIBRARY_NONE;) {
        const struct implementation *impl = library_impl(b->lib, i, NULL);
        assert(impl->nodedef == nodedef);
        consider(b, impl, &choice);
        i = impl->next;
    }
    return choice.best ? choice.best : choice.needy;
}

static void report_deferred(struct builder *b, const struct implementation *impl)
{
    const struct library *layer = library_of_element(b->lib, impl->element);
    assert(impl->ref + impl->count <= layer->deferred->items.len);
    assert(impl->kind == IMPL_BROKEN);
    for (uint32_t i = 0; i < impl->count; i++) {
        const struct diag *d = &layer->deferred->items.items[impl->ref + i];
        diag_repeat(b->diags, d);
    }
}

static void add_target(const struct builder *b, const struct implementation *impl,
                       struct text *targets)
{
    if (impl->target)
        text_fmt(targets, "%s%s", targets->len ? ", " : "", build_text(b, impl->target));
}

/* Names the target in a note, so that the message is one message for all targets. */
static void note_targets(struct builder *b, elem_id node)
{
    struct text names;
    text_init(&names, b->arena);
    for (size_t i = 0; i < b->options->num_targets; ++i)
        text_fmt(&names, "%s%s", i ? ", " : "", build_text(b, b->options->targets[i]));
    diag_add(b->diags, DIAG_ID_accepted_targets, doc_place(&b->lib->doc, node), text_cstr(&names));
}

static void report_missing(struct builder *b, uint32_t nodedef, elem_id node)
{
    const struct nodedef *def = library_nodedef(b->lib, nodedef);
    struct text targets, end;
    text_init(&targets, b->arena);
    text_init(&end, b->arena);
    for (const struct library *layer = b->lib; layer; layer = layer->base)
        for (uint32_t i = library_first_override(layer, nodedef); i != LIBRARY_NONE;
             i = library_impl(b->lib, i, NULL)->next)
            add_target(b, library_impl(b->lib, i, NULL), &targets);
    for (uint32_t i = def->first_impl; i != LIBRARY_NONE;) {
        const struct implementation *impl = library_impl(b->lib, i, NULL);
        add_target(b, impl, &targets);
        i = impl->next;
    }
    bool is_for_others = targets.len && b->options->num_targets;
    if (is_for_others)
        text_fmt(&end, " for this target; it has implementations for: %s", text_cstr(&targets));
    else
        text_str(&end, "; add a <nodegraph> or <implementation> with this 'nodedef'");
    diag_add(b->diags, DIAG_ID_missing_implementation, doc_place(&b->lib->doc, node),
             build_text(b, def->name), text_cstr(&end));
    if (is_for_others)
        note_targets(b, node);
    diag_add(b->diags, DIAG_ID_defined_here, doc_name_place(&b->lib->doc, def->element),
             build_text(b, def->name));
}

const struct implementation *build_choose(struct builder *b, uint32_t nodedef, elem_id node)
{
    const struct implementation *impl = build_best_implementation(b, nodedef);
    if (impl && impl->kind == IMPL_BROKEN) {
        report_deferred(b, impl);
        diag_add(b->diags, DIAG_ID_needed_by, doc_place(&b->lib->doc, node),
                 build_text(b, doc_element(&b->lib->doc, node)->name));
        return NULL;
    }
    if (!impl)
        report_missing(b, nodedef, node);
    assert(!impl || impl->nodedef == nodedef);
    return impl;
}

uint32_t build_definition_of(const struct builder *b, const char *node, str_id type)
{
    struct text name;
    text_init(&name, b->arena);
    text_fmt(&name, "ND_%s_%s", node, build_text(b, type));
    str_id id = str_find(b->shader->strings, text_cstr(&name), name.len);
    return id ? library_nodedef_by_name(b->lib, id) : LIBRARY_NONE;
}
