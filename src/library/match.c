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

uint32_t library_first_override(const struct library *layer, uint32_t nodedef)
{
    uint32_t hash = hash_pair(nodedef, 0);
    for (uint32_t at = hash, found; (found = table_next(&layer->overrides, hash, &at));)
        if (layer->impls.items[found - 1].nodedef == nodedef)
            return layer->base_impls + found - 1;
    return LIBRARY_NONE;
}

/* ---- Candidates ---- */

/* True if the definition has the type of the node. A type that no one knows has its own message. */
static bool gives_type(const struct library *lib, const struct nodedef *def,
                       const struct port *ports, str_id type)
{
    doc_type wanted = library_type(lib, type);
    if (def->num_outputs == 0)
        return false;
    if (type == STR_multioutput)
        return def->num_outputs > 1;
    return !wanted || (def->num_outputs == 1 && wanted == ports[def->num_inputs].type);
}

/* Numbers that are not given are 0, so "2" is "2.0" (specification, "NodeDef Elements"). */
static bool is_same_version(const char *a, const char *b)
{
    while (*a && *a == *b)
        a++, b++;
    if (*a && *b)
        return false;
    const char *rest = *a ? a : b;
    while (strncmp(rest, ".0", 2) == 0)
        rest += 2;
    return !*rest;
}

static bool has_version(const struct library *lib, const struct nodedef *def, str_id wanted)
{
    if (!wanted)
        return !def->version || def->is_default_version;
    return def->version && is_same_version(text_of(lib, wanted), text_of(lib, def->version));
}

/* A definition that gives the type of the node. Its faults are the node's. */
struct candidate {
    uint32_t nodedef;
    bool is_of_version, is_default;
    unsigned fit;         /* library_target_fit */
    bool is_for_some;     /* it is for some targets, and no target is meant */
    bool is_marked;       /* it says that it is the default, and the node asks for no version */
    unsigned wrong_types; /* inputs of another type */
    unsigned before;      /* inputs of the right type before the first of another type */
    bool has_unknown;     /* the definition lacks an input of the node */
};

static bool is_wrong_type(const struct library *lib, elem_id input, const struct port *port)
{
    doc_type type = library_type(lib, doc_attr_value(&lib->doc, input, STR_type));
    return type && type != port->type;
}

static struct candidate examine(const struct library *lib, uint32_t id, elem_id node)
{
    struct candidate c = {.nodedef = id};
    const struct nodedef *def = library_nodedef(lib, id);
    const struct port *ports = library_ports(lib, id, NULL);
    str_id wanted = doc_attr_value(&lib->doc, node, STR_version);
    c.is_of_version = has_version(lib, def, wanted);
    c.is_default = has_version(lib, def, 0);
    c.is_marked = def->is_default_version && !wanted;
    c.fit = library_target_fit(lib, id);
    c.is_for_some = def->num_targets && !lib->num_targets;
    for (elem_id child = doc_element(&lib->doc, node)->first_child; child;
         child = doc_element(&lib->doc, child)->next) {
        const struct element *input = doc_element(&lib->doc, child);
        int index = input->kind == KIND_INPUT ? library_find_input(lib, id, input->name) : -1;
        if (index < 0)
            c.has_unknown |= input->kind == KIND_INPUT;
        else if (is_wrong_type(lib, child, &ports[index]))
            c.wrong_types++;
        else
            c.before += c.wrong_types == 0;
    }
    return c;
}

static bool is_exact(const struct candidate *c)
{
    return c->nodedef != LIBRARY_NONE && c->is_of_version && !c->wrong_types && !c->has_unknown
           && !c->is_for_some;
}

/* The first of equal candidates is best. */
static bool is_better(const struct candidate *c, const struct candidate *best)
{
    if (best->nodedef == LIBRARY_NONE || c->is_of_version != best->is_of_version)
        return best->nodedef == LIBRARY_NONE || c->is_of_version;
    if (!c->is_of_version && c->is_default != best->is_default)
        return c->is_default;
    if (c->wrong_types != best->wrong_types)
        return c->wrong_types < best->wrong_types;
    if (c->wrong_types && c->before != best->before)
        return c->before > best->before;
    if (c->fit != best->fit)
        return c->fit > best->fit;
    if (c->has_unknown != best->has_unknown)
        return best->has_unknown;
    return c->is_marked && !best->is_marked;
}

/* ---- Reports ---- */

/*
 * True for an input of a definition of the same node for other targets, which this one ignores
 * (specification, "Custom Inputs").
 */
static bool is_for_others(const struct library *lib, uint32_t id, elem_id node, str_id input)
{
    str_id type = doc_attr_value(&lib->doc, node, STR_type);
    const struct nodedef *chosen = library_nodedef(lib, id), *def;
    for (const struct library *layer = lib; layer; layer = layer->base)
        for (uint32_t own = library_first_of_node(layer, chosen->node); own != LIBRARY_NONE;
             own = def->next_same_node) {
            uint32_t other = layer->base_nodedefs + own;
            def = &layer->nodedefs.items[own];
            if ((chosen->num_targets || def->num_targets)
                && library_find_input(lib, other, input) >= 0
                && gives_type(lib, def, library_ports(lib, other, NULL), type))
                return true;
        }
    return false;
}

/* Inputs that the definition lacks, or that have another type there. */
static void report_inputs(const struct library *lib, uint32_t id, elem_id node,
                          struct diag_list *diags)
{
    const struct nodedef *def = library_nodedef(lib, id);
    const struct port *ports = library_ports(lib, id, NULL);
    for (elem_id child = doc_element(&lib->doc, node)->first_child; child;
         child = doc_element(&lib->doc, child)->next) {
        const struct element *input = doc_element(&lib->doc, child);
        int index = input->kind == KIND_INPUT ? library_find_input(lib, id, input->name) : -1;
        if (index >= 0 && is_wrong_type(lib, child, &ports[index]))
            diag_add(diags, DIAG_ID_input_type, doc_attr_place(&lib->doc, child, STR_type),
                     text_of(lib, input->name), text_of(lib, def->node),
                     text_of(lib, library_type_name(lib, ports[index].type)),
                     text_of(lib, doc_attr_value(&lib->doc, child, STR_type)));
        if (index >= 0 || input->kind != KIND_INPUT || is_for_others(lib, id, node, input->name))
            continue;
        struct diag_guess guess;
        bool may_guess = diag_guess_begin(&guess, diags, text_of(lib, input->name));
        for (unsigned i = 0; may_guess && i < def->num_inputs; i++)
            diag_guess_add(&guess, text_of(lib, ports[i].name));
        diag_add(diags, DIAG_ID_unknown_input, doc_name_place(&lib->doc, child),
                 text_of(lib, def->node), text_of(lib, input->name), diag_guess_text(&guess));
    }
}

/* Words without repetition: "float, color3". */
struct word_list {
    struct text text;
    str_id *words;
    uint32_t len;
};

enum { MAX_WORDS = 64 };

static void add_word(const struct library *lib, struct word_list *list, str_id word)
{
    for (uint32_t i = 0; i < list->len; i++)
        if (list->words[i] == word)
            return;
    if (!word || list->len == MAX_WORDS)
        return;
    list->words[list->len++] = word;
    text_fmt(&list->text, "%s%s", list->len > 1 ? ", " : "", text_of(lib, word));
}

static str_id type_of(const struct library *lib, uint32_t id)
{
    const struct nodedef *def = library_nodedef(lib, id);
    if (def->num_outputs != 1)
        return def->num_outputs ? STR_multioutput : 0;
    return library_type_name(lib, library_ports(lib, id, NULL)[def->num_inputs].type);
}

static str_id version_of(const struct library *lib, uint32_t id)
{
    return library_nodedef(lib, id)->version;
}

/* Lists types or versions of a node's definitions; LIBRARY_NONE: of all its definitions. */
static const char *list_of(const struct library *lib, elem_id node, uint32_t only,
                           str_id (*get)(const struct library *, uint32_t), struct arena *arena)
{
    struct word_list list = {.words = ARENA_ARRAY(arena, str_id, MAX_WORDS)};
    text_init(&list.text, arena);
    str_id category = doc_element(&lib->doc, node)->category;
    for (const struct library *layer = lib; layer && only == LIBRARY_NONE; layer = layer->base)
        for (uint32_t own = library_first_of_node(layer, category); own != LIBRARY_NONE;
             own = layer->nodedefs.items[own].next_same_node)
            add_word(lib, &list, get(lib, layer->base_nodedefs + own));
    if (only != LIBRARY_NONE)
        add_word(lib, &list, get(lib, only));
    return list.len ? text_cstr(&list.text) : "nothing";
}

/* `only`: the definition that the node names; LIBRARY_NONE: all definitions of the node. */
static void report_type(const struct library *lib, elem_id node, uint32_t only,
                        struct diag_list *diags)
{
    const struct document *doc = &lib->doc;
    struct text who;
    text_init(&who, diags->arena);
    if (only == LIBRARY_NONE)
        text_fmt(&who, "<%s>", text_of(lib, doc_element(doc, node)->category));
    else
        text_fmt(&who, "the nodedef '%s'", text_of(lib, library_nodedef(lib, only)->name));
    diag_add(diags, DIAG_ID_no_matching_nodedef, doc_attr_place(doc, node, STR_type),
             text_cstr(&who), text_of(lib, doc_attr_value(doc, node, STR_type)),
             list_of(lib, node, only, type_of, diags->arena));
}

/* Lists the targets of the node's definitions, which are all for others. */
static void report_targets(const struct library *lib, elem_id node, struct diag_list *diags)
{
    struct word_list list = {.words = ARENA_ARRAY(diags->arena, str_id, MAX_WORDS)};
    struct text own;
    str_id category = doc_element(&lib->doc, node)->category;
    text_init(&list.text, diags->arena);
    text_init(&own, diags->arena);
    for (const struct library *layer = lib; layer; layer = layer->base)
        for (uint32_t i = library_first_of_node(layer, category); i != LIBRARY_NONE;
             i = layer->nodedefs.items[i].next_same_node)
            for (unsigned k = 0; k < layer->nodedefs.items[i].num_targets; k++)
                add_word(lib, &list, layer->refs.items[layer->nodedefs.items[i].first_target + k]);
    for (unsigned i = 0; i < lib->num_targets; i++)
        text_fmt(&own, "%s%s", i ? ", " : "", str_text(lib->target_strings, lib->targets[i]));
    diag_add(diags, DIAG_ID_definition_of_other_target, doc_place(&lib->doc, node),
             text_of(lib, category), text_cstr(&list.text));
    diag_add(diags, DIAG_ID_accepted_targets, doc_place(&lib->doc, node), text_cstr(&own));
}

static void report_version(const struct library *lib, elem_id node, struct diag_list *diags)
{
    const struct document *doc = &lib->doc;
    str_id version = doc_attr_value(doc, node, STR_version);
    struct text fault;
    text_init(&fault, diags->arena);
    if (version)
        text_fmt(&fault, "version '%s'", text_of(lib, version));
    else
        text_str(&fault, "default version");
    diag_add(diags, DIAG_ID_unknown_nodedef_version, doc_attr_place(doc, node, STR_version),
             text_of(lib, doc_element(doc, node)->category), text_cstr(&fault),
             list_of(lib, node, LIBRARY_NONE, version_of, diags->arena));
}

/* Nodes of MaterialX 1.38 that 1.39 does not have, and their successors. */
static const char *const removed_nodes[][2] = {
    {"swizzle", "<extract>, <separate3>, <combine3> or <convert>"},
    {"arrayappend", "an array value"},
    {"compare", "<ifgreatereq>, with 'in1' and 'in2' swapped,"},
    {"switchf", "<switch>"},
    {"thin_film_brdf", "the thin-film inputs of <dielectric_bsdf> or <conductor_bsdf>"},
    {"thin_film_bsdf", "the thin-film inputs of <dielectric_bsdf> or <conductor_bsdf>"},
};

static const char *advice_on_removed(const char *name, struct arena *arena)
{
    for (size_t i = 0; i < sizeof removed_nodes / sizeof *removed_nodes; i++) {
        if (strcmp(name, removed_nodes[i][0]) != 0)
            continue;
        struct text text;
        text_init(&text, arena);
        text_fmt(&text, "; MaterialX 1.39 has %s in its place", removed_nodes[i][1]);
        return text_cstr(&text);
    }
    return "";
}

/* One advice is enough. */
static const char *advice(const char *suggestion)
{
    return *suggestion ? suggestion : "; no loaded library defines it";
}

static void report_unknown_node(const struct library *lib, elem_id node, struct diag_list *diags)
{
    if (doc_is_outdated(&lib->doc, node)) {
        doc_report_outdated(&lib->doc, node, diags);
        return;
    }
    const char *name = text_of(lib, doc_element(&lib->doc, node)->category);
    const char *removed = advice_on_removed(name, diags->arena);
    struct diag_guess guess;
    bool may_guess = !*removed && diag_guess_begin(&guess, diags, name);
    for (const struct library *layer = may_guess ? lib : NULL; layer; layer = layer->base)
        for (uint32_t i = 0; i < layer->nodedefs.len; i++)
            if (library_first_of_node(layer, layer->nodedefs.items[i].node) == i)
                diag_guess_add(&guess, text_of(lib, layer->nodedefs.items[i].node));
    diag_add(diags, DIAG_ID_unknown_node, doc_place(&lib->doc, node), name,
             *removed ? removed : advice(may_guess ? diag_guess_text(&guess) : ""));
}

/* Guesses among the definitions of one node, or of all nodes (0). */
static const char *guess_nodedef(const struct library *lib, str_id name, str_id node,
                                 struct diag_list *diags)
{
    struct diag_guess guess;
    bool may_guess = diag_guess_begin(&guess, diags, text_of(lib, name));
    for (const struct library *layer = may_guess ? lib : NULL; layer; layer = layer->base)
        for (uint32_t i = 0; i < layer->nodedefs.len; i++)
            if (!node || layer->nodedefs.items[i].node == node)
                diag_guess_add(&guess, text_of(lib, layer->nodedefs.items[i].name));
    return diag_guess_text(&guess);
}

void library_report_nodedef(const struct library *lib, elem_id element, str_id name,
                            struct diag_list *diags)
{
    const struct element *e = doc_element(&lib->doc, element);
    const char *suggestion =
        e->kind == KIND_NODE ? guess_nodedef(lib, name, e->category, diags) : "";
    if (!*suggestion)
        suggestion = guess_nodedef(lib, name, 0, diags);
    diag_add(diags, DIAG_ID_unknown_nodedef, doc_attr_place(&lib->doc, element, STR_nodedef),
             text_of(lib, name), advice(suggestion));
}

/* Ends a search: the faults of the best candidate are the node's. */
static uint32_t settle(const struct library *lib, elem_id node, const struct candidate *best,
                       struct diag_list *diags)
{
    if (!best->is_of_version)
        report_version(lib, node, diags);
    str_id type = doc_attr_value(&lib->doc, node, STR_type);
    if (type && !library_type(lib, type))
        doc_report_type(&lib->doc, node, diags);
    report_inputs(lib, best->nodedef, node, diags);
    return best->nodedef;
}

static uint32_t match_explicit(const struct library *lib, elem_id node, str_id name,
                               struct diag_list *diags)
{
    uint32_t id = library_nodedef_by_name(lib, name);
    if (id == LIBRARY_NONE) {
        library_report_nodedef(lib, node, name, diags);
        return LIBRARY_NONE;
    }
    const struct nodedef *def = library_nodedef(lib, id);
    assert(def->name == name);
    str_id category = doc_element(&lib->doc, node)->category;
    if (def->node != category)
        diag_add(diags, DIAG_ID_nodedef_of_other_node, doc_attr_place(&lib->doc, node, STR_nodedef),
                 text_of(lib, name), text_of(lib, def->node), text_of(lib, category));
    if (!library_is_unique(lib, def->element, node, STR_nodedef, diags))
        return LIBRARY_NONE;
    if (!gives_type(lib, def, library_ports(lib, id, NULL),
                    doc_attr_value(&lib->doc, node, STR_type))) {
        report_type(lib, node, id, diags);
        return LIBRARY_NONE;
    }
    struct candidate c = examine(lib, id, node);
    c.is_of_version = true; /* the name includes the version */
    return settle(lib, node, &c, diags);
}

/* The result of a search for the definition of a node. */
struct search {
    struct candidate best;
    bool is_known;     /* the node has a definition */
    bool is_for_other; /* one for other targets would give the node's type */
};

static struct search search(const struct library *lib, elem_id node)
{
    struct search s = {.best = {.nodedef = LIBRARY_NONE}};
    str_id category = doc_element(&lib->doc, node)->category,
           type = doc_attr_value(&lib->doc, node, STR_type);
    const struct nodedef *def;
    for (const struct library *layer = lib; layer && !is_exact(&s.best); layer = layer->base)
        for (uint32_t own = library_first_of_node(layer, category); own != LIBRARY_NONE;
             own = def->next_same_node) {
            uint32_t id = layer->base_nodedefs + own;
            def = &layer->nodedefs.items[own];
            s.is_known = true;
            if (!def->num_targets && is_exact(&s.best) && s.best.is_marked)
                continue;
            if (!gives_type(lib, def, library_ports(lib, id, NULL), type))
                continue;
            struct candidate c = examine(lib, id, node);
            if (!c.fit)
                s.is_for_other = true;
            else if (is_better(&c, &s.best))
                s.best = c;
        }
    assert(s.best.nodedef == LIBRARY_NONE || s.is_known);
    return s;
}

uint32_t library_match(const struct library *lib, elem_id node, struct diag_list *diags)
{
    str_id explicit_name = doc_attr_value(&lib->doc, node, STR_nodedef);
    if (explicit_name)
        return match_explicit(lib, node, explicit_name, diags);
    struct search s = search(lib, node);
    if (s.best.nodedef != LIBRARY_NONE)
        return settle(lib, node, &s.best, diags);
    if (s.is_for_other)
        report_targets(lib, node, diags);
    else if (s.is_known)
        report_type(lib, node, LIBRARY_NONE, diags);
    else
        report_unknown_node(lib, node, diags);
    return LIBRARY_NONE;
}
