// SPDX-License-Identifier: Apache-2.0
/* Finds the definition of a node element. */
#include "library/library.h"

#include "base/hash.h"

#include <assert.h>

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

uint32_t library_first_of_node(const struct library *layer, str_id node)
{
    uint32_t hash = hash_pair(node, 0);
    for (uint32_t at = hash, found; (found = table_next(&layer->node_table, hash, &at));)
        if (layer->nodedefs.items[found - 1].node == node)
            return found - 1;
    return LIBRARY_NONE;
}

enum fit { FIT_EXACT, FIT_EXTRA_INPUTS, FIT_NOT };

struct candidate {
    enum fit fit;
    const char *reason; /* for FIT_NOT: a format with up to two strings */
    str_id a, b, c;
};

static struct candidate misfit(const char *reason, str_id a, str_id b, str_id c)
{
    return (struct candidate){FIT_NOT, reason, a, b, c};
}

static struct candidate fit_version(const struct library *lib, const struct nodedef *def,
                                    elem_id node)
{
    str_id version = doc_attr_value(&lib->doc, node, STR_version);
    if (version && version != def->version)
        return misfit("its version is '%s', but the node requests '%s'", def->version, version, 0);
    if (!version && def->version && !def->is_default_version)
        return misfit("version '%s' is not the default; request it with version=\"%s\"",
                      def->version, def->version, 0);
    return (struct candidate){FIT_EXACT, NULL, 0, 0, 0};
}

static struct candidate fit_outputs(const struct library *lib, const struct nodedef *def,
                                    const struct port *ports, elem_id node)
{
    str_id type = doc_attr_value(&lib->doc, node, STR_type);
    if (def->num_outputs == 0)
        return misfit("it has no output with a valid type", 0, 0, 0);
    if (!type)
        return (struct candidate){FIT_EXACT, NULL, 0, 0, 0};
    if (def->num_outputs > 1 && type == STR_multioutput)
        return (struct candidate){FIT_EXACT, NULL, 0, 0, 0};
    const struct port *out = &ports[def->num_inputs];
    assert(out->type != DOC_TYPE_NONE);
    if (def->num_outputs == 1 && library_type(lib, type) == out->type)
        return (struct candidate){FIT_EXACT, NULL, 0, 0, 0};
    str_id has = def->num_outputs == 1 ? library_type_name(lib, out->type) : STR_multioutput;
    return misfit("its output is %s, but the node has type %s", has, type, 0);
}

static struct candidate fit_inputs(const struct library *lib, uint32_t id, const struct port *ports,
                                   elem_id node)
{
    struct candidate result = {FIT_EXACT, NULL, 0, 0, 0};
    for (elem_id child = doc_element(&lib->doc, node)->first_child; child;
         child = doc_element(&lib->doc, child)->next) {
        const struct element *input = doc_element(&lib->doc, child);
        if (input->kind != KIND_INPUT)
            continue;
        int index = library_find_input(lib, id, input->name);
        const struct port *port = index < 0 ? NULL : &ports[index];
        str_id type = doc_attr_value(&lib->doc, child, STR_type);
        if (!port)
            result =
                (struct candidate){FIT_EXTRA_INPUTS, "it has no input '%s'", input->name, 0, 0};
        else if (type && library_type(lib, type) != port->type)
            return misfit("its input '%s' is %s, but the node gives %s", input->name,
                          library_type_name(lib, port->type), type);
    }
    return result;
}

static struct candidate fit(const struct library *lib, uint32_t id, elem_id node, bool any_version)
{
    const struct nodedef *def = library_nodedef(lib, id);
    const struct port *ports = library_ports(lib, id, NULL);
    struct candidate c = fit_outputs(lib, def, ports, node);
    if (c.fit == FIT_NOT)
        return c;
    struct candidate inputs = fit_inputs(lib, id, ports, node);
    if (inputs.fit == FIT_NOT || any_version)
        return inputs;
    c = fit_version(lib, def, node);
    return c.fit == FIT_NOT ? c : inputs;
}

static void report_unknown_inputs(const struct library *lib, uint32_t id, elem_id node,
                                  struct diag_list *diags)
{
    const struct nodedef *def = library_nodedef(lib, id);
    const struct port *ports = library_ports(lib, id, NULL);
    for (elem_id child = doc_element(&lib->doc, node)->first_child; child;
         child = doc_element(&lib->doc, child)->next) {
        const struct element *input = doc_element(&lib->doc, child);
        if (input->kind != KIND_INPUT || library_find_input(lib, id, input->name) >= 0)
            continue;
        struct diag_guess guess;
        bool may_guess = diag_guess_begin(&guess, diags, text_of(lib, input->name));
        for (unsigned i = 0; may_guess && i < def->num_inputs; i++)
            diag_guess_add(&guess, text_of(lib, ports[i].name));
        diag_add(diags, DIAG_ID_unknown_input, doc_place(&lib->doc, child), text_of(lib, def->node),
                 text_of(lib, input->name), diag_guess_text(&guess));
    }
}

static void report_candidate(const struct library *lib, const struct nodedef *def,
                             const struct candidate *c, struct diag_list *diags)
{
    assert(c->fit == FIT_NOT);
    const char *args[3] = {text_of(lib, c->a), text_of(lib, c->b), text_of(lib, c->c)};
    struct text reason;
    text_init(&reason, diags->arena);
    unsigned arg = 0;
    for (const char *p = c->reason; *p; p++) {
        if (p[0] == '%' && p[1] == 's') {
            assert(arg < sizeof args / sizeof *args);
            text_str(&reason, args[arg++]);
            p++;
        } else {
            text_char(&reason, *p);
        }
    }
    diag_add(diags, DIAG_ID_nodedef_candidate, doc_place(&lib->doc, def->element),
             text_of(lib, def->name), text_cstr(&reason));
}

struct misfits {
    uint32_t *items; /* ids of definitions */
    uint32_t len, cap;
};

/*
 * Collects the definitions of the node's name that do not match: either those with the node's type,
 * or the others.
 */
static void collect_misfits(const struct library *lib, elem_id node, bool of_type,
                            struct arena *arena, struct misfits *misfits)
{
    str_id category = doc_element(&lib->doc, node)->category;
    for (const struct library *layer = lib; layer; layer = layer->base)
        for (uint32_t own = library_first_of_node(layer, category); own != LIBRARY_NONE;
             own = layer->nodedefs.items[own].next_same_node) {
            uint32_t id = layer->base_nodedefs + own;
            bool gives =
                fit_outputs(lib, library_nodedef(lib, id), library_ports(lib, id, NULL), node).fit
                != FIT_NOT;
            if (gives == of_type && fit(lib, id, node, false).fit == FIT_NOT)
                vec_push(arena, misfits, id);
        }
}

enum { MAX_CANDIDATES = 5 }; /* in one report */

/* If some candidates have the node's type, reports only these. */
static void report_candidates(const struct library *lib, elem_id node, struct diag_list *diags)
{
    str_id category = doc_element(&lib->doc, node)->category;
    diag_add(diags, DIAG_ID_no_matching_nodedef, doc_place(&lib->doc, node),
             text_of(lib, category));
    struct misfits misfits = {0};
    collect_misfits(lib, node, true, diags->arena, &misfits);
    uint32_t of_type = misfits.len;
    collect_misfits(lib, node, false, diags->arena, &misfits);
    assert(of_type <= misfits.len);
    uint32_t shown = of_type ? of_type : misfits.len;
    shown = shown < MAX_CANDIDATES ? shown : MAX_CANDIDATES;
    assert(shown <= misfits.len);
    for (uint32_t i = 0; i < shown; i++) {
        struct candidate c = fit(lib, misfits.items[i], node, false);
        report_candidate(lib, library_nodedef(lib, misfits.items[i]), &c, diags);
    }
    if (shown < misfits.len)
        diag_add(diags, DIAG_ID_more_candidates, doc_place(&lib->doc, node), misfits.len - shown,
                 text_of(lib, category));
}

static void report_unknown_node(const struct library *lib, elem_id node, struct diag_list *diags)
{
    const char *name = text_of(lib, doc_element(&lib->doc, node)->category);
    struct diag_guess guess;
    bool may_guess = diag_guess_begin(&guess, diags, name);
    for (const struct library *layer = may_guess ? lib : NULL; layer; layer = layer->base)
        for (uint32_t i = 0; i < layer->nodedefs.len; i++)
            if (library_first_of_node(layer, layer->nodedefs.items[i].node) == i)
                diag_guess_add(&guess, text_of(lib, layer->nodedefs.items[i].node));
    diag_add(diags, DIAG_ID_unknown_node, doc_place(&lib->doc, node), name,
             diag_guess_text(&guess));
}

const char *library_suggest_nodedef(const struct library *lib, str_id name, struct diag_list *diags)
{
    struct diag_guess guess;
    bool may_guess = diag_guess_begin(&guess, diags, text_of(lib, name));
    for (const struct library *layer = may_guess ? lib : NULL; layer; layer = layer->base)
        for (uint32_t i = 0; i < layer->nodedefs.len; i++)
            diag_guess_add(&guess, text_of(lib, layer->nodedefs.items[i].name));
    return diag_guess_text(&guess);
}

static uint32_t match_explicit(const struct library *lib, elem_id node, str_id name,
                               struct diag_list *diags)
{
    uint32_t id = library_nodedef_by_name(lib, name);
    if (id == LIBRARY_NONE) {
        diag_add(diags, DIAG_ID_unknown_nodedef, doc_attr_place(&lib->doc, node, STR_nodedef),
                 text_of(lib, name), library_suggest_nodedef(lib, name, diags));
        return LIBRARY_NONE;
    }
    const struct nodedef *def = library_nodedef(lib, id);
    assert(def->name == name);
    str_id category = doc_element(&lib->doc, node)->category;
    if (def->node != category)
        diag_add(diags, DIAG_ID_nodedef_of_other_node, doc_attr_place(&lib->doc, node, STR_nodedef),
                 text_of(lib, name), text_of(lib, def->node), text_of(lib, category));
    struct candidate c = fit(lib, id, node, true);
    if (c.fit == FIT_NOT) {
        report_candidates(lib, node, diags);
        return LIBRARY_NONE;
    }
    if (c.fit == FIT_EXTRA_INPUTS)
        report_unknown_inputs(lib, id, node, diags);
    return id;
}

uint32_t library_match(const struct library *lib, elem_id node, struct diag_list *diags)
{
    str_id explicit_name = doc_attr_value(&lib->doc, node, STR_nodedef);
    if (explicit_name)
        return match_explicit(lib, node, explicit_name, diags);
    str_id category = doc_element(&lib->doc, node)->category;
    uint32_t with_extra = LIBRARY_NONE;
    bool known = false;
    for (const struct library *layer = lib; layer; layer = layer->base)
        for (uint32_t own = library_first_of_node(layer, category); own != LIBRARY_NONE;
             own = layer->nodedefs.items[own].next_same_node) {
            known = true;
            struct candidate c = fit(lib, layer->base_nodedefs + own, node, false);
            if (c.fit == FIT_EXACT)
                return layer->base_nodedefs + own;
            if (c.fit == FIT_EXTRA_INPUTS && with_extra == LIBRARY_NONE)
                with_extra = layer->base_nodedefs + own;
        }
    assert(with_extra == LIBRARY_NONE || known);
    if (with_extra != LIBRARY_NONE)
        report_unknown_inputs(lib, with_extra, node, diags);
    else if (known)
        report_candidates(lib, node, diags);
    else
        report_unknown_node(lib, node, diags);
    return with_extra;
}
