// SPDX-License-Identifier: Apache-2.0
/*
 * Implementations with source for one target, which mxgen copies into the shader: their files, and
 * the way to call their functions.
 */
#include "library/index_priv.h"

#include <assert.h>

const struct extra_input library_extra_inputs[LIBRARY_NUM_EXTRA_INPUTS] = {
    {"uv_scale", IR_TYPE_VEC2, 1.0f},
    {"uv_offset", IR_TYPE_VEC2, 0.0f},
};

bool index_is_inline(const struct indexer *ix, str_id file)
{
    return text_ends_with(index_text(ix, file), ".inline");
}

str_id index_read_source(struct indexer *ix, elem_id element, str_id file, struct diag_list *diags)
{
    const char *name, *text, *reason = "the context cannot read files";
    size_t len;
    if (!ix->reader
        || !ix->reader->read(ix->reader->user_data, index_file(ix, element), index_text(ix, file),
                             &name, &text, &len, &reason)) {
        diag_add(diags, DIAG_ID_missing_source_file,
                 doc_attr_place(&ix->lib->doc, element, STR_file), index_text(ix, file),
                 index_text(ix, doc_element(&ix->lib->doc, element)->name), reason);
        return 0;
    }
    return str_intern(&ix->lib->strings, text, len);
}

str_id index_expression(struct indexer *ix, str_id source)
{
    const char *text = index_text(ix, source);
    size_t len = str_len(&ix->lib->strings, source), trimmed = len;
    while (trimmed && strchr(" \t\r\n;", text[trimmed - 1]))
        trimmed--;
    return trimmed == len || !trimmed ? source : str_intern(&ix->lib->strings, text, trimmed);
}

/* Keeps the first fault: the reason why the source is not portable. */
static void keep_reason(struct indexer *ix, struct verbatim *verbatim,
                        const struct diag_list *faults)
{
    if (!faults->items.len)
        return;
    const struct diag *first = &faults->items.items[0];
    verbatim->reason = str_intern_z(&ix->lib->strings, first->message);
    if (first->place.file)
        verbatim->reason_file = str_intern_z(&ix->lib->strings, first->place.file);
    verbatim->reason_line = first->place.line;
    verbatim->reason_column = first->place.column;
}

/* ---- Expressions ---- */

/* The expression of each output: its own, or that of the implementation. */
static bool add_expressions(struct indexer *ix, const struct implementation *impl,
                            struct verbatim *verbatim, struct diag_list *diags)
{
    const struct document *doc = &ix->lib->doc;
    const struct nodedef *def = library_nodedef(ix->lib, impl->nodedef);
    const struct port *outputs = library_ports(ix->lib, impl->nodedef, NULL) + def->num_inputs;
    str_id file = index_attr(ix, impl->element, STR_file);
    str_id source = file && index_is_inline(ix, file)
                        ? index_read_source(ix, impl->element, file, diags)
                        : index_attr(ix, impl->element, STR_sourcecode);
    verbatim->first_expression = ix->lib->refs.len;
    for (unsigned i = 0; i < def->num_outputs; i++) {
        elem_id child = doc_child_of_kind(doc, impl->element, KIND_OUTPUT, outputs[i].name);
        str_id own = child ? doc_attr_value(doc, child, STR_sourcecode) : 0;
        if (!own && (def->num_outputs > 1 || !source)) {
            diag_add(diags, DIAG_ID_function_signature,
                     doc_attr_place(doc, impl->element, STR_sourcecode), "sourcecode",
                     index_text(ix, def->name),
                     "each output needs an <output> child with sourcecode");
            return false;
        }
        str_id expression = index_expression(ix, own ? own : source);
        vec_push(ix->arena, &ix->lib->refs, expression);
    }
    return true;
}

/* ---- Functions ---- */

/*
 * Calling conventions by the type of the first output, the nearest first. A function has the
 * parameters of its convention, then one per input (lights have none of these), then one per
 * output.
 */
enum { ALL_CONTEXTS = (1 << NUM_SOURCE_CONTEXTS) - 1 };
static const struct convention {
    doc_type type;
    const char *first, *last; /* types of parameters; NULL: any */
    const char *suffix;
    uint8_t leading;
    uint8_t convention, contexts;
    bool is_plain;
} conventions[] = {
    {DOC_TYPE_BSDF, "ClosureData", NULL, "", 1, SOURCE_CLOSURE_DATA, ALL_CONTEXTS, false},
    {DOC_TYPE_EDF, "ClosureData", NULL, "", 1, SOURCE_CLOSURE_DATA, 1 << SOURCE_EMISSION, false},
    {DOC_TYPE_VDF, "ClosureData", "BSDF", "", 1, SOURCE_CLOSURE_BSDF, 1 << SOURCE_TRANSMISSION,
     false},
    {DOC_TYPE_VDF, "ClosureData", NULL, "", 1, SOURCE_CLOSURE_DATA, 1 << SOURCE_TRANSMISSION,
     false},
    {DOC_TYPE_BSDF, NULL, NULL, "_reflection", 4, SOURCE_VALUES, 1 << SOURCE_REFLECTION, false},
    {DOC_TYPE_BSDF, NULL, NULL, "_transmission", 1, SOURCE_VALUES, 1 << SOURCE_TRANSMISSION, false},
    {DOC_TYPE_BSDF, NULL, NULL, "_indirect", 1, SOURCE_VALUES, 1 << SOURCE_INDIRECT, false},
    {DOC_TYPE_EDF, NULL, NULL, "", 2, SOURCE_VALUES, 1 << SOURCE_EMISSION, false},
    {DOC_TYPE_VDF, "vec3", NULL, "", 0, SOURCE_NOTHING, 1 << SOURCE_TRANSMISSION, false},
    {DOC_TYPE_lightshader, "LightData", NULL, "", 2, SOURCE_NOTHING, 0, false},
    /* for targets with closures */
    {DOC_TYPE_BSDF, NULL, NULL, "", 0, SOURCE_NOTHING, 0, true},
    {DOC_TYPE_EDF, NULL, NULL, "", 0, SOURCE_NOTHING, 0, true},
    {DOC_TYPE_VDF, NULL, NULL, "", 0, SOURCE_NOTHING, 0, true},
};

struct signature {
    struct indexer *ix;
    const struct implementation *impl;
    const struct nodedef *def;
    const struct port *ports;
    struct source_parameter *parameters;
    int num_parameters;
    unsigned leading;
    uint8_t extra;
};

/*
 * Types of parameters that also take a value of another type. Hardware targets pass a string as the
 * index of its word, and an int converts to float. OSL has no bool and no
 * sampler.
 */
static const struct {
    const char *target; /* NULL: all */
    ir_type_id value, parameter;
} converting[] = {
    {NULL, IR_TYPE_STRING, IR_TYPE_INT},
    {NULL, IR_TYPE_INT, IR_TYPE_FLOAT},
    {"genosl", IR_TYPE_BOOL, IR_TYPE_INT},
    {"genosl", IR_TYPE_SAMPLER, IR_TYPE_STRING},
};

static bool converts(const struct signature *s, ir_type_id value, ir_type_id parameter)
{
    const char *target = index_text(s->ix, s->impl->target);
    for (size_t i = 0; i < sizeof converting / sizeof *converting; i++)
        if (converting[i].value == value && converting[i].parameter == parameter
            && (!converting[i].target || strcmp(converting[i].target, target) == 0))
            return true;
    return value == parameter;
}

/* A parameter of a known type must take the value of its input, or give that of its output. */
static bool has_type(const struct signature *s, unsigned parameter, doc_type of_port)
{
    const struct scan_word *type = &s->parameters[parameter].type;
    ir_type_id value = library_type_ir(s->ix->lib, of_port);
    for (ir_type_id known = IR_TYPE_BOOL; known <= IR_TYPE_SAMPLER; known++)
        if (scan_is(type, ir_type_text(known)))
            return value > IR_TYPE_SAMPLER || converts(s, value, known);
    return true; /* a macro, a type of another language, or a closure */
}

/* Counts the extra parameters at the end of the inputs. */
static unsigned find_extra(struct signature *s)
{
    unsigned first = s->leading + s->def->num_inputs, n = 0;
    for (unsigned i = 0; i < LIBRARY_NUM_EXTRA_INPUTS; i++) {
        if (first + n >= (unsigned)s->num_parameters
            || !scan_is(&s->parameters[first + n].name, library_extra_inputs[i].name))
            continue;
        s->extra |= (uint8_t)(1u << i);
        n++;
    }
    return n;
}

/* NULL, or the fault of the parameters. */
static const char *signature_fault(struct signature *s, bool is_light)
{
    unsigned inputs = is_light ? 0 : s->def->num_inputs, first = s->leading + inputs;
    first += is_light ? 0 : find_extra(s);
    if (first + s->def->num_outputs != (unsigned)s->num_parameters)
        return s->leading
                   ? "it needs the parameters of the calling convention, one per input, then "
                     "one per output"
                   : "it needs one parameter per input, then one `out` parameter per output";
    for (unsigned i = 0; i < inputs; i++)
        if (!has_type(s, s->leading + i,
                      library_source_type(s->ix->lib, s->impl->element, &s->ports[i])))
            return "a parameter differs in type from its input";
    for (unsigned i = 0; i < s->def->num_outputs; i++)
        if (!has_type(s, first + i, s->ports[s->def->num_inputs + i].type))
            return "a parameter differs in type from its output";
    return NULL;
}

static const char too_long[] = "it has more than 255 parameters";

static bool check_function(struct signature *s, const char *name, bool is_light,
                           struct diag_list *diags)
{
    const char *fault =
        s->num_parameters == SOURCE_MANY_PARAMETERS ? too_long : signature_fault(s, is_light);
    if (fault)
        diag_add(diags, DIAG_ID_function_signature,
                 doc_attr_place(&s->ix->lib->doc, s->impl->element, STR_function), name,
                 index_text(s->ix, s->def->name), fault);
    return !fault;
}

static bool fits_convention(const struct signature *s, const struct convention *row)
{
    bool is_light = row->type == DOC_TYPE_lightshader;
    unsigned n = row->leading + (is_light ? 0u : s->def->num_inputs) + s->def->num_outputs;
    return s->num_parameters == (int)n
           && (!row->first || scan_is(&s->parameters[0].type, row->first))
           && (!row->last || scan_is(&s->parameters[n - 1].type, row->last));
}

/* Reads the function for a row of the conventions; false: it is absent, or has another one. */
static bool find_for_convention(struct signature *s, uint32_t file, const char *function,
                                const struct convention *row, const char **out_name)
{
    struct text name;
    text_init(&name, s->ix->arena);
    text_fmt(&name, "%s%s", function, row->suffix);
    s->num_parameters = index_source_function(s->ix, file, text_cstr(&name), s->parameters);
    s->leading = row->leading;
    if (s->num_parameters != SOURCE_NO_FUNCTION)
        *out_name = text_cstr(&name);
    return fits_convention(s, row);
}

/* Finds the calling convention of a closure or light; false after a diagnostic. */
static bool find_convention(struct signature *s, struct verbatim *verbatim, struct diag_list *diags)
{
    const char *function = index_text(s->ix, verbatim->function), *name = NULL;
    doc_type type = s->ports[s->def->num_inputs].type;
    bool is_found = false, is_long = false;
    for (size_t i = 0; i < sizeof conventions / sizeof *conventions; i++) {
        const struct convention *row = &conventions[i];
        if (row->type != type || (is_found && !(verbatim->has_suffixes && *row->suffix)))
            continue;
        bool fits = find_for_convention(s, verbatim->file, function, row, &name);
        is_long |= s->num_parameters == SOURCE_MANY_PARAMETERS;
        if (!fits)
            continue;
        if (!check_function(s, name, type == DOC_TYPE_lightshader, diags))
            return false;
        verbatim->convention = row->convention;
        verbatim->contexts |= row->contexts;
        verbatim->is_plain = row->is_plain;
        verbatim->has_suffixes = *row->suffix != '\0';
        is_found = true;
    }
    struct diag_place where = doc_attr_place(&s->ix->lib->doc, s->impl->element, STR_function);
    if (!is_found && name)
        diag_add(diags, DIAG_ID_function_signature, where, name, index_text(s->ix, s->def->name),
                 is_long
                     ? too_long
                     : "its parameters fit no calling convention of its type (docs/library.md)");
    else if (!is_found)
        diag_add(diags, DIAG_ID_missing_function, where, function, "");
    return is_found;
}

static bool add_function(struct indexer *ix, const struct implementation *impl,
                         struct verbatim *verbatim, struct diag_list *diags)
{
    struct signature s = {.ix = ix, .impl = impl, .def = library_nodedef(ix->lib, impl->nodedef)};
    s.ports = library_ports(ix->lib, impl->nodedef, NULL);
    s.parameters = ARENA_ARRAY(ix->arena, struct source_parameter, INDEX_MAX_PARAMETERS);
    ir_type_id type = library_type_ir(ix->lib, s.ports[s.def->num_inputs].type);
    const char *name = index_text(ix, verbatim->function);
    if (ir_type_is_closure(type) || type == IR_TYPE_LIGHT)
        return find_convention(&s, verbatim, diags);
    verbatim->is_plain = true;
    s.num_parameters = index_source_function(ix, verbatim->file, name, s.parameters);
    if (s.num_parameters == SOURCE_NO_FUNCTION) {
        diag_add(diags, DIAG_ID_missing_function,
                 doc_attr_place(&ix->lib->doc, impl->element, STR_function), name, "");
        return false;
    }
    bool fits = check_function(&s, name, false, diags);
    verbatim->extra = s.extra;
    return fits;
}

/* True if the last error is at the implementation, not inside a source file. */
static bool is_told_here(const struct indexer *ix, const struct implementation *impl,
                         const struct diag_list *diags)
{
    const char *file =
        diags->last < diags->items.len ? diags->items.items[diags->last].place.file : NULL;
    return file && strcmp(file, index_file(ix, impl->element)) == 0;
}

bool index_verbatim(struct indexer *ix, struct implementation *impl, const struct diag_list *faults,
                    struct diag_list *diags)
{
    str_id file = index_attr(ix, impl->element, STR_file);
    struct verbatim verbatim = {.file = LIBRARY_NONE};
    if (file && !index_is_inline(ix, file)) {
        verbatim.function = index_attr(ix, impl->element, STR_function);
        verbatim.file = index_source_file(
            ix, index_file(ix, impl->element), index_text(ix, file), index_text(ix, impl->name),
            doc_attr_place(&ix->lib->doc, impl->element, STR_file), diags);
        bool is_read =
            verbatim.file != LIBRARY_NONE && index_implied_includes(ix, impl, &verbatim, diags);
        if (!is_read && !is_told_here(ix, impl, diags))
            diag_add(diags, DIAG_ID_source_used_by, doc_place(&ix->lib->doc, impl->element),
                     index_text(ix, impl->name));
        if (!is_read)
            return false;
    }
    bool is_good = verbatim.function ? add_function(ix, impl, &verbatim, diags)
                                     : add_expressions(ix, impl, &verbatim, diags);
    if (!is_good)
        return false;
    keep_reason(ix, &verbatim, faults);
    impl->kind = IMPL_VERBATIM;
    impl->ref = ix->lib->base_verbatims + ix->lib->verbatims.len;
    vec_push(ix->arena, &ix->lib->verbatims, verbatim);
    return true;
}
