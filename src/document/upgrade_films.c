// SPDX-License-Identifier: Apache-2.0
/*
 * 1.39: a thin film is two inputs of the BSDF below it instead of a layer above it. Layers with a
 * film on top disappear, and the BSDFs below them get the film's inputs. A BSDF that others read,
 * too, stays as it is for them: the layer gets a copy of it.
 */
#include "document/upgrade.h"

enum { MAX_COPIED = 64 }; /* children of a BSDF that is copied; BSDFs of MaterialX have ten */

struct films {
    struct upgrade *u;
    size_t num; /* of elements before the upgrade of films; what it adds has no entries below */
    elem_id *bypass; /* by element: the replacement of a removed layer */
    bool *visited;   /* a BSDF takes only the outermost film */
    bool *needed;    /* films and copied BSDFs with other references */
    bool *copied;
    uint32_t *num_readers;
    VEC(elem_id) stack;
};

static size_t own_index(const struct films *f, elem_id element)
{
    return element - f->u->doc->first_element;
}

static bool is_old(const struct films *f, elem_id element)
{
    return element && own_index(f, element) < f->num;
}

static bool takes_film(const struct upgrade *u, elem_id node)
{
    elem_id mode = upgrade_child(u, node, "scatter_mode");
    bool can = upgrade_is_category(u, node, "dielectric_bsdf")
               || upgrade_is_category(u, node, "conductor_bsdf")
               || upgrade_is_category(u, node, "generalized_schlick_bsdf");
    return can && !(mode && upgrade_is(u, doc_attr_value(u->doc, mode, STR_value), "T"));
}

static void count_readers(struct films *f)
{
    for (elem_id e = upgrade_first(f->u); e; e = upgrade_next(f->u, e)) {
        elem_id source = doc_is_port(f->u->doc, e) ? upgrade_upstream(f->u, e) : 0;
        if (source)
            f->num_readers[own_index(f, source)]++;
    }
}

static void push_upstream(struct films *f, elem_id node)
{
    struct document *doc = f->u->doc;
    for (elem_id e = doc_element(doc, node)->first_child; e; e = doc_element(doc, e)->next) {
        elem_id upstream = upgrade_upstream(f->u, e);
        if (is_old(f, upstream) && !f->visited[own_index(f, upstream)])
            vec_push(doc->arena, &f->stack, upstream);
    }
}

static void give_film(struct upgrade *u, elem_id film, elem_id node)
{
    upgrade_copy_input(u, upgrade_child(u, film, "thickness"), node, "thinfilm_thickness", NULL);
    upgrade_copy_input(u, upgrade_child(u, film, "ior"), node, "thinfilm_ior", NULL);
    upgrade_note(u, node,
                 "<thin_film_bsdf> is now the inputs 'thinfilm_thickness' and 'thinfilm_ior'");
}

static void apply_film(struct films *f, elem_id film, elem_id base)
{
    struct upgrade *u = f->u;
    bool is_applied = false;
    f->stack.len = 0;
    vec_push(u->doc->arena, &f->stack, base);
    while (f->stack.len) {
        elem_id node = vec_pop(&f->stack);
        if (f->visited[own_index(f, node)])
            continue;
        f->visited[own_index(f, node)] = true;
        push_upstream(f, node);
        if (!takes_film(u, node))
            continue;
        if (f->num_readers[own_index(f, node)] > 1)
            upgrade_tell_loss(u, node, "other nodes read '%s', too, and get its film",
                              doc_name(u->doc, node));
        give_film(u, film, node);
        is_applied = true;
    }
    if (!is_applied)
        upgrade_tell_loss(u, film, "no BSDF below '%s' takes a film, so it is left out",
                          doc_name(u->doc, film));
}

/* True if the film may have a copy of the base, which others read. */
static bool is_copied(const struct films *f, elem_id base)
{
    uint32_t num = 0;
    for (elem_id e = doc_element(f->u->doc, base)->first_child; e && num <= MAX_COPIED;
         e = doc_element(f->u->doc, e)->next)
        num++;
    return f->num_readers[own_index(f, base)] > 1 && takes_film(f->u, base) && num <= MAX_COPIED;
}

static elem_id copy_base(struct films *f, elem_id layer, elem_id base)
{
    struct upgrade *u = f->u;
    struct document *doc = u->doc;
    struct text name;
    text_init(&name, doc->arena);
    text_fmt(&name, "%s_film", doc_name(doc, layer));
    elem_id copy =
        upgrade_add_node(u, layer, text_cstr(&name),
                         str_text(doc->strings, doc_element(doc, base)->category), STR_BSDF);
    for (uint32_t i = 0; i < doc_element(doc, base)->num_attrs; i++) {
        struct attribute attr = doc_attrs(doc, base)[i];
        if (attr.name != STR_name)
            doc_set_attr(doc, copy, attr.name, attr.value);
    }
    for (elem_id e = doc_element(doc, base)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_INPUT)
            upgrade_copy_input(u, e, copy, doc_name(doc, e), NULL);
    return copy;
}

static elem_id connected(const struct upgrade *u, elem_id node, const char *input)
{
    elem_id port = upgrade_child(u, node, input);
    return port ? upgrade_upstream(u, port) : 0;
}

static elem_id bypass_of(const struct films *f, elem_id node)
{
    return is_old(f, node) ? f->bypass[own_index(f, node)] : 0;
}

/* Follows the replacements of removed layers, with path compression. */
static elem_id bypassed(struct films *f, elem_id node)
{
    elem_id base = node, next;
    while ((next = bypass_of(f, base)) != 0)
        base = next;
    for (; (next = bypass_of(f, node)) != 0; node = next)
        f->bypass[own_index(f, node)] = base;
    return base;
}

/* A port reads what replaces a layer. */
static void redirect(struct films *f, elem_id port)
{
    struct upgrade *u = f->u;
    elem_id upstream = upgrade_upstream(u, port), node = doc_element(u->doc, port)->parent;
    if (!is_old(f, upstream))
        return;
    if (bypass_of(f, upstream))
        doc_set_attr(u->doc, port, STR_nodename, doc_element(u->doc, bypassed(f, upstream))->name);
    if (!bypass_of(f, node))
        f->needed[own_index(f, upstream)] = true;
}

static void replace_layer(struct films *f, elem_id layer)
{
    elem_id top = connected(f->u, layer, "top"), base = connected(f->u, layer, "base");
    if (!top || !base || !upgrade_is_category(f->u, top, "thin_film_bsdf"))
        return;
    if (is_copied(f, base)) {
        f->copied[own_index(f, base)] = true;
        base = copy_base(f, layer, base);
        give_film(f->u, top, base);
    } else {
        apply_film(f, top, base);
    }
    if (bypassed(f, base) != layer) /* otherwise the layers form a cycle, which stays */
        f->bypass[own_index(f, layer)] = base;
}

static bool is_unused(const struct films *f, elem_id element)
{
    if (!is_old(f, element) || f->needed[own_index(f, element)])
        return false;
    return f->copied[own_index(f, element)] || upgrade_is_category(f->u, element, "thin_film_bsdf");
}

void upgrade_thin_films(struct upgrade *u)
{
    struct document *doc = u->doc;
    if (!str_find(doc->strings, "thin_film_bsdf", 14))
        return;
    size_t num = doc->elements.len;
    struct films f = {.u = u,
                      .num = num,
                      .bypass = ARENA_ARRAY(doc->arena, elem_id, num),
                      .visited = ARENA_ARRAY(doc->arena, bool, num),
                      .needed = ARENA_ARRAY(doc->arena, bool, num),
                      .copied = ARENA_ARRAY(doc->arena, bool, num),
                      .num_readers = ARENA_ARRAY(doc->arena, uint32_t, num)};
    count_readers(&f);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        if (upgrade_is_node(u, e) && upgrade_is_category(u, e, "layer"))
            replace_layer(&f, e);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        if (doc_is_port(doc, e))
            redirect(&f, e);
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e))
        if (bypass_of(&f, e) || is_unused(&f, e))
            doc_remove_element(doc, e);
}
