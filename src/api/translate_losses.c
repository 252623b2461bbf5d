// SPDX-License-Identifier: Apache-2.0
/*
 * Inputs that a translation loses. Each input that the document sets is a uniform, while the others
 * have their values: it is lost if the old surface reads it and nothing that the new one reads
 * does. Where a chain leads through other models, the inputs of the surfaces between are looked at
 * in the same way, because a part of an input may be lost there: a hue, while its brightness stays.
 */
#include "api/translate.h"

/* ---- Dependences ---- */

/* Marks the sources that a value reads. */
static void mark_sources(struct translation *t, ir_ref root, bool *marks)
{
    if (!root)
        return;
    const struct ir_graph *graph = &t->value->graph;
    const uint8_t *needed = ir_mark(graph, &root, 1, t->arena);
    for (ir_ref ref = 1; ref <= root; ref++) {
        uint32_t source = needed[ref] ? translate_source_of(t, graph, ref) : t->sources.len;
        if (source < t->sources.len)
            marks[source] = true;
    }
}

/* The sources that an output of a step depends on, with uniforms as translate_build has them. */
static bool *dependences_of(struct translation *t, unsigned step, const char *output, uint32_t more)
{
    bool *marks = ARENA_ARRAY(t->arena, bool, t->sources.len + 1);
    mark_sources(t, translate_build(t, step, output, more), marks);
    return marks;
}

/* The output of the last step for an input that the new surface has and reads; NULL: it is none. */
static const char *output_of(const struct translated_input *input)
{
    bool has = input->is_set && !*input->port.defaultgeomprop;
    return has ? input->output : NULL;
}

/* By input: what it may depend on, whatever values the others have; NULL: it is not set. */
static bool **find_dependences(struct translation *t)
{
    bool **all = ARENA_ARRAY(t->arena, bool *, t->inputs.len + 1);
    for (uint32_t i = 0; i < t->inputs.len; i++) {
        const char *output = output_of(&t->inputs.items[i]);
        if (output)
            all[i] = dependences_of(t, t->chain.len, output, TRANSLATE_ALL_INPUTS);
    }
    return all;
}

/*
 * True if the new surface depends on a source while the others have their values. `all` tells which
 * inputs may, so that the others need no generation.
 */
static bool stays(struct translation *t, bool *const *all, uint32_t source)
{
    bool found = t->sources.items[source].is_used;
    for (uint32_t i = 0; i < t->inputs.len && !found; i++)
        found = all[i] && all[i][source]
                && dependences_of(t, t->chain.len, output_of(&t->inputs.items[i]), source)[source];
    return found;
}

/* True if an output of the first step depends on a source. */
static bool is_read(struct translation *t, uint32_t source)
{
    mxg_nodedef info = {.size = sizeof info};
    bool found = false;
    mxg_document_nodedef(t->document, t->chain.items[0], &info);
    for (uint32_t i = 0; i < info.num_outputs && !found; i++) {
        mxg_port output = {.size = sizeof output};
        mxg_document_port(t->document, t->chain.items[0], info.num_inputs + i, &output);
        found = dependences_of(t, 1, output.name, source)[source];
    }
    return found;
}

/*
 * The value of a source that needs no counterpart: the default. But the first step may have another
 * one for an input that none of its outputs reads: 0 for the radius of light below the surface,
 * where the new model has none.
 */
static const char *value_of_none(struct translation *t, uint32_t index)
{
    struct source_input *source = &t->sources.items[index];
    mxg_port own;
    source->has_other =
        *source->port.value
        && translate_find_port(t, t->chain.items[0], source->port.name, false, &own)
        && !translate_is_default(&source->port, t->document->layer.doc.strings, own.value)
        && !is_read(t, index);
    return source->has_other ? own.value : source->port.value;
}

static bool matters(struct translation *t, uint32_t index, const char *none)
{
    const struct source_input *source = &t->sources.items[index];
    mxg_port port = source->port;
    port.value = none;
    return source->is_connected || !source->has_other
               ? translate_is_authored(t, source)
               : !translate_is_default(&port, t->document->layer.doc.strings,
                                       translate_value_of(t, source));
}

/* The value that the old surface has. */
static const char *value_of(struct translation *t, const char *name)
{
    const struct source_input *source = t->sources.items;
    while (strcmp(source->port.name, name) != 0)
        source++;
    return source->is_connected ? NULL : translate_value_of(t, source);
}

/*
 * True if the shader of a surface reads a source, and is another one than with the value that needs
 * no counterpart. A source that the geometry fills has no uniform, so a connection counts.
 */
static bool changes(struct translation *t, uint32_t index, const char *none)
{
    const struct source_input *source = &t->sources.items[index];
    const char *name = source->port.name;
    if (source->is_connected && *source->port.defaultgeomprop)
        return true;
    return translate_surface_reads(t, 0, name, translate_uniforms(t, index))
           && (source->is_connected || !*none
               || translate_surface_differs(t, 0, name, translate_value_of(t, source), none,
                                            translate_uniforms(t, TRANSLATE_CONNECTED)));
}

/*
 * Why a source that is set matters to a surface of a definition: its shader reads it, or programs
 * that know more of the model. NULL: it does nothing.
 */
static const char *use_of(struct translation *t, uint32_t index, uint32_t definition,
                          const char *none)
{
    const char *name = t->sources.items[index].port.name;
    if (changes(t, index, none))
        return "changes this surface";
    if (strcmp(name, "displacement") == 0)
        return "moves the vertices";
    return translate_is_for_others(t, definition, name)
                   && !translate_is_off(t, definition, name, value_of)
               ? "is for other programs"
               : NULL;
}

/* By source: why it is lost; NULL: it is not. `definition` is that of the surface. */
static const char **find_lost(struct translation *t, uint32_t definition)
{
    const char **lost = ARENA_ARRAY(t->arena, const char *, t->sources.len + 1);
    bool *const *all = find_dependences(t);
    for (uint32_t i = 0; i < t->sources.len; i++) {
        const char *none = value_of_none(t, i);
        if (matters(t, i, none) && !stays(t, all, i))
            lost[i] = use_of(t, i, definition, none);
    }
    return lost;
}

/* `source`: the input of the document; NULL, or without an element: it is a default. */
static void tell(const struct translation *t, const struct source_input *source, const char *input,
                 const char *category, const char *use)
{
    elem_id place = source && source->element ? source->element : t->surface;
    diag_add(t->diags, DIAG_ID_translation_loss, doc_name_place(&t->document->layer.doc, place),
             input, category, use, t->model);
}

/* ---- Surfaces between ---- */

/* The value of an input of the surface that a step makes. */
static struct source_input source_between(struct translation *t, unsigned step,
                                          const mxg_port *port)
{
    struct source_input source = {.port = *port, .type = value_type_of(port->type)};
    struct value_nodes nodes = t->nodes;
    const char *output = translate_output_name(t, port->name);
    mxg_port found;
    struct operand value;
    if (source.type == VALUE_NONE || *port->defaultgeomprop
        || !translate_find_port(t, t->chain.items[step - 1], output, true, &found))
        return source;
    ir_ref root = translate_build(t, step, output, TRANSLATE_CONNECTED);
    if (!root)
        return source;
    memset(&nodes.nodes, 0, sizeof nodes.nodes); /* of this value alone */
    memset(&nodes.table, 0, sizeof nodes.table);
    bool is_known = !value_nodes_add(&nodes, &t->value->graph, root, source.type, &value)
                    && value.kind == OPERAND_CONSTANT;
    if (!is_known)
        value = value_zero(source.type);
    struct text text;
    text_init(&text, t->arena);
    value_write(&value, &text);
    source.text = text_cstr(&text);
    source.is_connected = !is_known;
    return source;
}

/*
 * Finds the first input of the document that an input between depends on, of its type if there is
 * one; NULL: it comes from defaults. False: one of them is told already.
 */
static bool find_origin(struct translation *t, unsigned step, const struct source_input *between,
                        const char *const *lost, const struct source_input **out)
{
    const char *output = translate_output_name(t, between->port.name);
    const bool *marks = dependences_of(t, step, output, TRANSLATE_ALL_INPUTS);
    uint32_t first = t->sources.len, alike = first;
    *out = NULL;
    for (uint32_t i = t->sources.len; i-- > 0;) {
        if (!marks[i] || !translate_is_authored(t, &t->sources.items[i])
            || !dependences_of(t, step, output, i)[i])
            continue;
        if (lost[i])
            return false;
        first = i;
        alike = t->sources.items[i].type == between->type ? i : alike;
    }
    first = alike < t->sources.len ? alike : first;
    if (first < t->sources.len)
        *out = &t->sources.items[first];
    return true;
}

/* A surface that a step makes, on the way to the model. */
struct between {
    const char *model;
    uint32_t definition, num_inputs;
    struct source_input *inputs;
    const char **lost; /* by input */
};

static void read_between(struct translation *t, unsigned step, struct between *b)
{
    mxg_nodedef info = {.size = sizeof info};
    mxg_document_nodedef(t->document, b->definition, &info);
    b->num_inputs = info.num_inputs;
    b->inputs = ARENA_ARRAY(t->arena, struct source_input, info.num_inputs + 1);
    for (uint32_t i = 0; i < info.num_inputs; i++) {
        mxg_port port = {.size = sizeof port};
        mxg_document_port(t->document, b->definition, i, &port);
        b->inputs[i] = source_between(t, step, &port);
    }
}

static void forget_draft(struct translation *t)
{
    mxg_result_destroy(t->value); /* it refers to the draft */
    mxg_document_destroy(t->draft);
    t->value = NULL;
    t->draft = NULL;
}

/* Finds what the rest of the chain loses, as if the surface between were the document's. */
static void find_lost_between(struct translation *t, unsigned step, struct between *b)
{
    struct translation kept = *t;
    t->whole_draft = t->draft;
    t->draft = NULL;
    t->sources.items = b->inputs;
    t->sources.len = t->sources.cap = b->num_inputs;
    t->chain.items += step;
    t->chain.len -= step;
    translate_make_draft(t, b->definition);
    b->lost = find_lost(t, b->definition);
    forget_draft(t);
    t->draft = t->whole_draft;
    t->whole_draft = NULL;
    t->sources = kept.sources;
    t->chain = kept.chain;
}

static void report_between(struct translation *t, unsigned step, const char *const *lost)
{
    struct between b = {0};
    for (uint32_t i = 0; i < t->steps.len; i++)
        if (t->steps.items[i].definition == t->chain.items[step - 1])
            b.model = t->steps.items[i].to;
    if (!b.model || !translate_find_surface(t, b.model, &b.definition))
        return;
    read_between(t, step, &b);
    find_lost_between(t, step, &b);
    for (uint32_t i = 0; i < b.num_inputs; i++) {
        const struct source_input *origin;
        if (!b.lost[i] || !find_origin(t, step, &b.inputs[i], lost, &origin)
            || !(origin || b.inputs[i].has_other))
            continue;
        struct text path;
        text_init(&path, t->arena);
        doc_path(&t->document->layer.doc, t->surface, '/', &path);
        text_fmt(&path, "/%s", b.inputs[i].port.name);
        tell(t, origin, text_cstr(&path), b.model, b.lost[i]);
    }
}

void translate_report_losses(struct translation *t)
{
    const struct document *doc = &t->document->layer.doc;
    const char *category = str_text(doc->strings, doc_element(doc, t->surface)->category);
    const char *const *lost = find_lost(t, mxg_document_find_nodedef(t->document, t->surface));
    for (uint32_t i = 0; i < t->sources.len; i++)
        if (lost[i])
            tell(t, &t->sources.items[i], t->sources.items[i].port.name, category, lost[i]);
    for (unsigned step = 1; step < t->chain.len; step++)
        report_between(t, step, lost);
}
