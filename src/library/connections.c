// SPDX-License-Identifier: Apache-2.0
/* Resolves names to elements: the connections of a node's inputs. */
#include "base/hash.h"
#include "library/library.h"

#include <assert.h>

static const char *text_of(const struct library *lib, str_id id)
{
    return str_text(&lib->strings, id);
}

/*
 * A child by name, as `from` refers to it: inside a namespace the qualified name takes precedence
 * (specification, "Namespaces").
 */
static elem_id find_named(const struct library *lib, elem_id scope, str_id name, elem_id from)
{
    bool is_global = from >= lib->doc.first_element && lib->doc.is_global;
    str_id space = is_global ? STR_EMPTY : doc_inherited_attr(&lib->doc, from, STR_namespace);
    if (space) {
        char qualified[512];
        size_t space_len = str_len(&lib->strings, space), name_len = str_len(&lib->strings, name);
        if (space_len + name_len + 1 <= sizeof qualified) {
            memcpy(qualified, text_of(lib, space), space_len);
            qualified[space_len] = ':';
            memcpy(qualified + space_len + 1, text_of(lib, name), name_len);
            str_id id = str_find(&lib->strings, qualified, space_len + 1 + name_len);
            elem_id found = id ? doc_child(&lib->doc, scope, id) : 0;
            if (found)
                return found;
        }
    }
    return doc_child(&lib->doc, scope, name);
}

bool library_is_unique(const struct library *lib, elem_id element, elem_id from, str_id attr,
                       struct diag_list *diags)
{
    elem_id second = doc_second_of_name(&lib->doc, element);
    if (!second)
        return true;
    const char *name = text_of(lib, doc_element(&lib->doc, element)->name);
    diag_add(diags, DIAG_ID_ambiguous_name, doc_attr_place(&lib->doc, from, attr), name);
    diag_add(diags, DIAG_ID_defined_here, doc_name_place(&lib->doc, element), name);
    diag_add(diags, DIAG_ID_defined_here, doc_name_place(&lib->doc, second), name);
    return false;
}

static elem_id root_of(const struct library *lib, elem_id element)
{
    return library_of_element(lib, element)->doc.root;
}

/*
 * limit of elements to search for suggestions, because each generation of a large document may
 * search
 */
enum { MAX_SEARCHED = 4096, MAX_SEARCHED_LATER = 64 /* after many suggestions */ };

/* A suggestion from the named children of a scope. */
static const char *suggest_child(const struct library *lib, elem_id scope, int kind, str_id name,
                                 struct diag_list *diags)
{
    struct diag_guess guess;
    elem_id e = diag_guess_begin(&guess, diags, text_of(lib, name))
                    ? doc_element(&lib->doc, scope)->first_child
                    : 0;
    for (unsigned searched = 0; e && searched < MAX_SEARCHED;
         e = doc_element(&lib->doc, e)->next, searched++) {
        const struct element *child = doc_element(&lib->doc, e);
        if (child->name && child->kind == kind)
            diag_guess_add(&guess, text_of(lib, child->name));
    }
    return diag_guess_text(&guess);
}

/*
 * Reports a node in another nodegraph: connections do not reach into nodegraphs, but authors try.
 */
static void report_elsewhere(const struct library *lib, elem_id root, elem_id scope, str_id name,
                             struct diag_list *diags)
{
    const struct document *doc = &lib->doc;
    elem_id e = diag_may_guess(diags) ? doc_element(doc, root)->first_child : 0;
    for (unsigned searched = 0; e && searched < MAX_SEARCHED;
         e = doc_element(doc, e)->next, searched++) {
        bool is_other = e != scope && doc_element(doc, e)->kind == KIND_NODEGRAPH;
        elem_id node = is_other ? doc_child_of_kind(doc, e, KIND_NODE, name) : 0;
        if (!node)
            continue;
        diag_add(diags, DIAG_ID_in_other_graph, doc_place(doc, node),
                 text_of(lib, doc_element(doc, e)->name));
        return;
    }
}

static const struct binding bind_error = {.kind = BIND_ERROR};

static void report_assumed(const struct library *lib, elem_id port, const char *of, str_id output,
                           struct diag_list *diags)
{
    const char *name = text_of(lib, output);
    diag_add(diags, DIAG_ID_output_needed, doc_place(&lib->doc, port), of, name, name);
}

/* Where there is one output, the name that a port gives is ignored (specification, "Inputs"). */
static void report_ignored(const struct library *lib, elem_id port, elem_id of, str_id output,
                           struct diag_list *diags)
{
    str_id ignored = doc_attr_value(&lib->doc, port, STR_output);
    diag_add(diags, DIAG_ID_output_ignored, doc_attr_place(&lib->doc, port, STR_output),
             text_of(lib, doc_element(&lib->doc, of)->name), text_of(lib, output),
             text_of(lib, ignored));
}

/*
 * Chooses an output if the document does not: the first one of the type, otherwise the first, as in
 * MaterialX.
 */
static int assume_output(const struct port *outputs, unsigned num_outputs, doc_type type)
{
    for (unsigned i = 0; i < num_outputs; i++)
        if (outputs[i].type == type)
            return (int)i;
    return 0;
}

/* The end of the message that an output is missing: a suggestion, or the outputs that exist. */
struct missing_output {
    struct diag_guess guess;
    bool may_guess;
    struct text names;
    unsigned count;
};

static void begin_missing(struct missing_output *m, const char *name, struct diag_list *diags)
{
    *m = (struct missing_output){.may_guess = false};
    m->may_guess = diag_guess_begin(&m->guess, diags, name);
    text_init(&m->names, diags->arena);
}

static void add_existing(struct missing_output *m, const char *name)
{
    enum { MAX_LISTED = 16 };
    if (m->may_guess)
        diag_guess_add(&m->guess, name);
    if (m->count < MAX_LISTED)
        text_fmt(&m->names, "%s'%s'", m->count ? ", " : "; it has ", name);
    else if (m->count == MAX_LISTED)
        text_str(&m->names, ", …");
    m->count++;
}

static const char *end_missing(struct missing_output *m)
{
    const char *suggestion = diag_guess_text(&m->guess);
    if (!m->count)
        return "; it has none";
    return *suggestion ? suggestion : text_cstr(&m->names);
}

int library_resolve_output(const struct library *lib, elem_id port, elem_id node, str_id output,
                           doc_type type, struct diag_list *diags)
{
    if (!output && doc_attr_value(&lib->doc, node, STR_type) != STR_multioutput)
        return 0;
    uint32_t id = library_match(lib, node, diags);
    if (id == LIBRARY_NONE)
        return -1;
    const struct nodedef *def = library_nodedef(lib, id);
    const struct port *outputs = library_ports(lib, id, NULL) + def->num_inputs;
    const char *name = text_of(lib, doc_element(&lib->doc, node)->name);
    int index = output ? library_find_output(lib, id, output)
                       : assume_output(outputs, def->num_outputs, type);
    assert(index < def->num_outputs);
    if (!output && def->num_outputs > 1)
        report_assumed(lib, port, name, outputs[index].name, diags);
    if (index < 0) {
        struct missing_output missing;
        begin_missing(&missing, text_of(lib, output), diags);
        for (unsigned i = 0; i < def->num_outputs; i++)
            add_existing(&missing, text_of(lib, outputs[i].name));
        diag_add(diags, DIAG_ID_dangling_output, doc_attr_place(&lib->doc, port, STR_output), name,
                 text_of(lib, output), end_missing(&missing));
    }
    return index;
}

static str_id output_type(const struct library *lib, elem_id node, int output,
                          struct diag_list *diags)
{
    str_id type = doc_attr_value(&lib->doc, node, STR_type);
    if (library_type(lib, type) && type != STR_multioutput)
        return type;
    uint32_t id = library_match(lib, node, diags);
    if (id == LIBRARY_NONE)
        return 0;
    const struct nodedef *def = library_nodedef(lib, id);
    assert((uint32_t)output < def->num_outputs);
    return library_type_name(lib,
                             library_ports(lib, id, NULL)[def->num_inputs + (uint32_t)output].type);
}

/* The place of a port's connection. */
static struct diag_place connection_place(const struct document *doc, elem_id port)
{
    static const str_id attrs[] = {STR_nodename, STR_nodegraph, STR_interfacename};
    for (size_t i = 0; i < sizeof attrs / sizeof *attrs; i++)
        if (doc_attr(doc, port, attrs[i]))
            return doc_attr_place(doc, port, attrs[i]);
    return doc_attr_place(doc, port, STR_output);
}

static bool is_convertible(const struct library *lib, str_id from, str_id to, struct arena *arena)
{
    struct text name;
    text_init(&name, arena);
    text_fmt(&name, "ND_convert_%s_%s", text_of(lib, from), text_of(lib, to));
    str_id id = str_find(&lib->strings, name.data, name.len);
    return id && library_nodedef_by_name(lib, id) != LIBRARY_NONE;
}

static void report_type(const struct library *lib, elem_id port, doc_type want, str_id have,
                        elem_id at, struct diag_list *diags)
{
    str_id wanted = library_type_name(lib, want);
    bool is_output = doc_element(&lib->doc, port)->kind == KIND_OUTPUT;
    /* of an output, the type is wrong more often than the source */
    diag_add(diags, DIAG_ID_type_mismatch,
             is_output ? doc_attr_place(&lib->doc, port, STR_type)
                       : connection_place(&lib->doc, port),
             is_output ? "output" : "input", text_of(lib, doc_element(&lib->doc, port)->name),
             text_of(lib, wanted), text_of(lib, have));
    diag_add(diags, DIAG_ID_connected_here, doc_name_place(&lib->doc, at),
             text_of(lib, doc_element(&lib->doc, at)->name));
    if (is_convertible(lib, have, wanted, diags->arena))
        diag_add(diags, DIAG_ID_convert_between, doc_place(&lib->doc, port), text_of(lib, wanted),
                 text_of(lib, have));
}

/* The name of an output that a port gives; 0: none, or it is ignored. */
static str_id name_of_output(const struct library *lib, elem_id port, elem_id node,
                             struct diag_list *diags)
{
    str_id name = doc_attr_value(&lib->doc, port, STR_output);
    struct diag_list unheard;
    diag_list_init_unheard(&unheard, diags->arena);
    uint32_t id = name ? library_match(lib, node, &unheard) : LIBRARY_NONE;
    if (id == LIBRARY_NONE || library_nodedef(lib, id)->num_outputs != 1
        || library_find_output(lib, id, name) == 0)
        return name;
    const struct nodedef *def = library_nodedef(lib, id);
    report_ignored(lib, port, node, library_ports(lib, id, NULL)[def->num_inputs].name, diags);
    return 0;
}

/* True if a port of this type, or of any, may be connected to what has another type. */
static bool is_fitting(const struct library *lib, elem_id port, doc_type type, doc_type have)
{
    bool is_input = doc_element(&lib->doc, port)->kind == KIND_INPUT;
    return type == DOC_TYPE_NONE || have == type || (is_input && library_accepts(type, have));
}

static struct binding bind_node(const struct library *lib, elem_id port, elem_id node,
                                doc_type type, struct diag_list *diags)
{
    int output = library_resolve_output(lib, port, node, name_of_output(lib, port, node, diags),
                                        type, diags);
    str_id have = output >= 0 ? output_type(lib, node, output, diags) : 0;
    if (!have)
        return bind_error;
    if (!is_fitting(lib, port, type, library_type(lib, have))) {
        report_type(lib, port, type, have, node, diags);
        return bind_error;
    }
    return (struct binding){
        .kind = BIND_NODE, .output = (uint8_t)output, .ref = node, .element = port};
}

/* Reports that a nodegraph has no output `name`. */
static void report_output(const struct library *lib, elem_id port, elem_id graph, str_id name,
                          struct diag_list *diags)
{
    struct missing_output missing;
    begin_missing(&missing, text_of(lib, name), diags);
    unsigned most = missing.may_guess ? MAX_SEARCHED : MAX_SEARCHED_LATER, searched = 0;
    for (elem_id e = doc_element(&lib->doc, graph)->first_child; e && searched < most;
         e = doc_element(&lib->doc, e)->next, searched++)
        if (doc_element(&lib->doc, e)->kind == KIND_OUTPUT)
            add_existing(&missing, text_of(lib, doc_element(&lib->doc, e)->name));
    diag_add(diags, DIAG_ID_dangling_output, doc_attr_place(&lib->doc, port, STR_output),
             text_of(lib, doc_element(&lib->doc, graph)->name), text_of(lib, name),
             end_missing(&missing));
}

/* The <output> of a nodegraph that `port` selects with its `output` attribute, or by its type. */
static elem_id graph_output(const struct library *lib, elem_id port, elem_id graph, doc_type type,
                            struct diag_list *diags)
{
    str_id name = doc_attr_value(&lib->doc, port, STR_output);
    elem_id output = name ? doc_child_of_kind(&lib->doc, graph, KIND_OUTPUT, name) : 0;
    if (output)
        return library_is_unique(lib, output, port, STR_output, diags) ? output : 0;
    const char *graph_name = text_of(lib, doc_element(&lib->doc, graph)->name);
    const struct doc_outputs all = doc_outputs(&lib->doc, graph, STR_EMPTY);
    str_id wanted = name || type == DOC_TYPE_NONE ? STR_EMPTY : library_type_name(lib, type);
    elem_id fitting = all.second && wanted ? doc_outputs(&lib->doc, graph, wanted).first : 0;
    if (all.second && !fitting && wanted == STR_filename)
        fitting = doc_outputs(&lib->doc, graph, STR_string).first;
    elem_id assumed = fitting ? fitting : all.first;
    if (!all.first)
        diag_add(diags, DIAG_ID_dangling_output, doc_place(&lib->doc, port), graph_name, "out",
                 "; it has none");
    if (all.second && name) {
        report_output(lib, port, graph, name, diags);
        return 0;
    }
    if (all.second)
        report_assumed(lib, port, graph_name, doc_element(&lib->doc, assumed)->name, diags);
    else if (all.first && name)
        report_ignored(lib, port, graph, doc_element(&lib->doc, all.first)->name, diags);
    return assumed;
}

elem_id library_inner_output(const struct library *lib, uint32_t nodedef, unsigned output,
                             const struct document *doc, elem_id graph)
{
    const struct nodedef *def = library_nodedef(lib, nodedef);
    assert(output < def->num_outputs);
    const struct port *ports = library_ports(lib, nodedef, NULL) + def->num_inputs;
    elem_id named = doc_child_of_kind(doc, graph, KIND_OUTPUT, ports[output].name);
    if (named || def->num_outputs > 1)
        return named;
    return doc_outputs(doc, graph, STR_EMPTY).first;
}

/* The connection attributes of a port. */
struct port_source {
    str_id node, graph, interface, output;
    bool has_value;
};

static struct port_source read_port(const struct document *doc, elem_id port)
{
    struct port_source source = {0};
    const struct attribute *attrs = doc_attrs(doc, port);
    for (uint32_t i = 0; i < doc_element(doc, port)->num_attrs; i++) {
        str_id value = attrs[i].value;
        switch (attrs[i].name) {
        case STR_nodename: source.node = value; break;
        case STR_nodegraph: source.graph = value; break;
        case STR_interfacename: source.interface = value; break;
        case STR_output: source.output = value; break;
        case STR_value: source.has_value = true; break;
        default: break;
        }
    }
    return source;
}

/* For a port with a nodename or nodegraph: the output of the nodegraph, or 0 with *out. */
static elem_id follow_name(const struct library *lib, elem_id port, elem_id scope,
                           const struct port_source *source, doc_type type, struct binding *out,
                           struct diag_list *diags)
{
    const struct document *doc = &lib->doc;
    elem_id target = source->node ? find_named(lib, scope, source->node, port) : 0;
    if (!target && source->graph && !(target = find_named(lib, scope, source->graph, port)))
        target = find_named(lib, root_of(lib, port), source->graph, port);
    str_id attr = source->node ? STR_nodename : STR_nodegraph;
    if (target && !library_is_unique(lib, target, port, attr, diags))
        return 0;
    if (target && doc_element(doc, target)->kind == KIND_NODE) {
        *out = bind_node(lib, port, target, type, diags);
        return 0;
    }
    if (target && doc_element(doc, target)->kind == KIND_NODEGRAPH)
        return graph_output(lib, port, target, type, diags);
    str_id missing = source->node ? source->node : source->graph;
    diag_add(diags, source->node ? DIAG_ID_dangling_nodename : DIAG_ID_dangling_nodegraph,
             doc_attr_place(doc, port, source->node ? STR_nodename : STR_nodegraph),
             text_of(lib, missing),
             suggest_child(lib, scope, source->node ? KIND_NODE : KIND_NODEGRAPH, missing, diags));
    if (source->node)
        report_elsewhere(lib, root_of(lib, port), scope, source->node, diags);
    return 0;
}

/* Follows a port that names an output of the document. */
static elem_id follow_output(const struct library *lib, elem_id port, str_id output,
                             struct diag_list *diags)
{
    elem_id root = root_of(lib, port),
            target = doc_child_of_kind(&lib->doc, root, KIND_OUTPUT, output);
    if (!target)
        diag_add(diags, DIAG_ID_dangling_output, doc_attr_place(&lib->doc, port, STR_output),
                 "the document", text_of(lib, output),
                 suggest_child(lib, root, KIND_OUTPUT, output, diags));
    return target && library_is_unique(lib, target, port, STR_output, diags) ? target : 0;
}

/*
 * True if an interfacename in a graph refers to the graph's own inputs: no definition, whose
 * arguments would reach it, has the input.
 */
static bool is_plain_input(const struct library *lib, elem_id graph, str_id input)
{
    if (doc_element(&lib->doc, graph)->kind != KIND_NODEGRAPH)
        return true;
    uint32_t nodedef = library_implemented_nodedef(lib, graph);
    return !doc_attr(&lib->doc, graph, STR_nodedef)
           && (nodedef == LIBRARY_NONE || library_find_input(lib, nodedef, input) < 0);
}

/* The next port of the chain, or 0 with *out at its end. */
static elem_id follow(const struct library *lib, elem_id port, doc_type type, struct binding *out,
                      struct diag_list *diags)
{
    const struct document *doc = &lib->doc;
    const struct element *element = doc_element(doc, port);
    const struct element *owner = doc_element(doc, element->parent);
    /*
     * The scope of a node's input is the nodegraph of the node; of an interface input, the parent
     * of the nodegraph; of an output, its nodegraph. A port at the top of a document has no parent
     * scope.
     */
    elem_id scope =
        element->kind == KIND_OUTPUT || !owner->parent ? element->parent : owner->parent;
    struct port_source source = read_port(doc, port);
    *out = bind_error;
    if (source.node || source.graph)
        return follow_name(lib, port, scope, &source, type, out, diags);
    if (source.interface) {
        elem_id input = doc_child_of_kind(doc, scope, KIND_INPUT, source.interface);
        bool is_plain = is_plain_input(lib, scope, source.interface);
        if (input && is_plain) {
            return library_is_unique(lib, input, port, STR_interfacename, diags) ? input : 0;
        }
        if (owner->kind == KIND_NODEGRAPH && element->kind == KIND_INPUT && is_plain) {
            /* exporters of USD write it; in MaterialX it refers to the input itself */
            diag_add(diags, DIAG_ID_interfacename_ignored,
                     doc_attr_name_place(doc, port, STR_interfacename),
                     text_of(lib, element->name));
            *out = (struct binding){.kind = source.has_value ? BIND_VALUE : BIND_DEFAULT,
                                    .element = port};
            return 0;
        }
        *out = (struct binding){.kind = BIND_INTERFACE, .ref = source.interface, .element = port};
        return 0;
    }
    if (source.output && element->kind == KIND_INPUT)
        return follow_output(lib, port, source.output, diags);
    *out = (struct binding){.kind = source.has_value ? BIND_VALUE : BIND_DEFAULT, .element = port};
    return 0;
}

void library_drive(struct library_drives *drives, struct arena *arena, struct library_drive drive)
{
    uint32_t hash = hash_pair(drive.owner, drive.input);
    for (uint32_t at = hash, found; (found = table_next(&drives->table, hash, &at));) {
        struct library_drive *known = &drives->items.items[found - 1];
        if (known->owner == drive.owner && known->input == drive.input) {
            known->source = drive.source;
            return;
        }
    }
    vec_push(arena, &drives->items, drive);
    table_add(&drives->table, arena, hash, drives->items.len);
}

elem_id library_driver(const struct library_drives *drives, elem_id owner, str_id input)
{
    uint32_t hash = hash_pair(owner, input);
    for (uint32_t at = hash, found; drives && (found = table_next(&drives->table, hash, &at));) {
        const struct library_drive *known = &drives->items.items[found - 1];
        if (known->owner == owner && known->input == input)
            return known->source;
    }
    return 0;
}

/* The port that drives an interface input of a plain nodegraph, or the input itself. */
static elem_id driven(const struct library *lib, const struct library_drives *drives, elem_id port)
{
    const struct element *e = drives && port ? doc_element(&lib->doc, port) : NULL;
    elem_id source = e && e->kind == KIND_INPUT ? library_driver(drives, e->parent, e->name) : 0;
    return source ? source : port;
}

/*
 * The nodes of a nodegraph that implements a definition see each other and the inputs of the
 * definition. Reports a source elsewhere, to which the chain of a port leads.
 */
static bool is_in_reach(const struct library *lib, elem_id port, elem_id source,
                        struct diag_list *diags)
{
    const struct document *doc = &lib->doc;
    elem_id scope = doc_element(doc, source)->parent, e = doc_element(doc, port)->parent;
    if (doc_element(doc, port)->kind == KIND_INPUT)
        e = doc_element(doc, e)->parent; /* an input of a nodegraph sees what stands beside it */
    for (; e && e != scope; e = doc_element(doc, e)->parent) {
        if (doc_element(doc, e)->kind != KIND_NODEGRAPH
            || library_implemented_nodedef(lib, e) == LIBRARY_NONE || doc_is_within(doc, source, e))
            continue;
        elem_id named = doc_element(doc, source)->kind == KIND_NODE ? source : scope;
        diag_add(diags, DIAG_ID_outside_definition, doc_place(doc, port),
                 text_of(lib, doc_element(doc, named)->name),
                 text_of(lib, doc_element(doc, e)->name));
        return false;
    }
    return true;
}

/* LIBRARY_NONE: the end is not known yet. */
static uint32_t find_chain(const struct library_chains *chains, elem_id port, doc_type type)
{
    uint32_t hash = hash_pair(port, type);
    for (uint32_t at = hash, found; (found = table_next(&chains->table, hash, &at));)
        if (chains->items.items[found - 1].port == port
            && chains->items.items[found - 1].type == type)
            return found - 1;
    return LIBRARY_NONE;
}

/*
 * The next port of the chain, of which the type *type is wanted; 0 with *end at its end. Behind a
 * string a string is wanted.
 */
static elem_id next_port(const struct library *lib, elem_id port, doc_type *type,
                         const struct library_drives *drives, struct binding *end,
                         struct diag_list *diags)
{
    elem_id next = driven(lib, drives, follow(lib, port, *type, end, diags));
    str_id name = next && *type != DOC_TYPE_NONE ? doc_attr_value(&lib->doc, next, STR_type) : 0;
    doc_type have = name ? library_type(lib, name) : *type;
    if (is_fitting(lib, port, *type, have)) {
        *type = have;
        return next;
    }
    report_type(lib, port, *type, name, next, diags);
    *end = bind_error;
    return 0;
}

struct binding library_resolve_port(const struct library *lib, elem_id port, doc_type type,
                                    struct resolve_out *out, struct diag_list *diags)
{
    struct library_chains *chains = &out->chains;
    struct binding end = bind_error;
    uint32_t first = chains->items.len, found = LIBRARY_NONE;
    for (elem_id at = port; found == LIBRARY_NONE
                            && (at = next_port(lib, at, &type, out->drives, &end, diags)) != 0;) {
        found = find_chain(chains, at, type);
        if (found == LIBRARY_NONE) {
            vec_push(out->arena, &chains->items, (struct library_chain){at, type, bind_error});
            table_add(&chains->table, out->arena, hash_pair(at, type), chains->items.len);
        }
    }
    if (found != LIBRARY_NONE)
        end = chains->items.items[found].end;
    if (found != LIBRARY_NONE && found >= first) /* this chain comes back to itself */
        diag_add(diags, DIAG_ID_cycle, doc_place(&lib->doc, port),
                 text_of(lib, doc_element(&lib->doc, chains->items.items[found].port)->name));
    for (uint32_t i = first; i < chains->items.len; i++)
        chains->items.items[i].end = end;
    bool has_scope = end.kind == BIND_NODE || end.kind == BIND_INTERFACE;
    elem_id source = end.kind == BIND_NODE ? end.ref : end.element;
    return !has_scope || is_in_reach(lib, port, source, diags) ? end : bind_error;
}

/* An input of another type is reported; whether its source exists is another question. */
static struct binding resolve_input(const struct library *lib, elem_id input, doc_type type,
                                    struct resolve_out *out, struct diag_list *diags)
{
    doc_type said = library_type(lib, doc_attr_value(&lib->doc, input, STR_type));
    bool is_wrong = said && said != type;
    struct binding b =
        library_resolve_port(lib, input, is_wrong ? DOC_TYPE_NONE : type, out, diags);
    return is_wrong ? bind_error : b;
}

/* Replaces the bindings of the driven inputs. */
static void drive_node(const struct library *lib, const struct graph_node *node,
                       struct resolve_out *out, struct diag_list *diags)
{
    const struct nodedef *def = library_nodedef(lib, node->nodedef);
    const struct port *ports = library_ports(lib, node->nodedef, NULL);
    for (unsigned i = 0; i < def->num_inputs; i++) {
        elem_id source = library_driver(out->drives, node->element, ports[i].name);
        if (source)
            out->bindings.items[node->first_binding + i] =
                resolve_input(lib, source, ports[i].type, out, diags);
    }
}

struct graph_node library_resolve_node(const struct library *lib, elem_id node,
                                       struct resolve_out *out, struct diag_list *diags)
{
    struct graph_node result = {.element = node,
                                .nodedef = library_match(lib, node, diags),
                                .first_binding = out->bindings.len};
    if (result.nodedef == LIBRARY_NONE)
        return result;
    const struct nodedef *def = library_nodedef(lib, result.nodedef);
    const struct port *ports = library_ports(lib, result.nodedef, NULL);
    struct binding *bindings = vec_extend(out->arena, &out->bindings, def->num_inputs);
    for (unsigned i = 0; i < def->num_inputs; i++)
        bindings[i] = (struct binding){.kind = BIND_DEFAULT};
    for (elem_id e = doc_element(&lib->doc, node)->first_child; e;
         e = doc_element(&lib->doc, e)->next) {
        const struct element *input = doc_element(&lib->doc, e);
        int port =
            input->kind == KIND_INPUT ? library_find_input(lib, result.nodedef, input->name) : -1;
        if (port < 0)
            continue;
        assert((unsigned)port < def->num_inputs);
        if (library_driver(out->drives, node, input->name))
            continue;
        struct binding b = resolve_input(lib, e, ports[port].type, out, diags);
        out->bindings.items[result.first_binding + (unsigned)port] = b;
    }
    if (out->drives)
        drive_node(lib, &result, out, diags);
    assert(out->bindings.len == result.first_binding + def->num_inputs);
    return result;
}
