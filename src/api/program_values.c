// SPDX-License-Identifier: Apache-2.0
/* The values of a program as bytes: its own, and those of another document. */
#include "api/generation.h"

/* The element of a path in the document itself, without the layers below. */
static elem_id find_own(const struct document *doc, const char *path, size_t len)
{
    elem_id element = doc_find(doc, path, len);
    return doc_has_element(doc, element) ? element : 0;
}

/* True if both documents have the same node or graph around the input. */
static bool has_same_owner(const mxg_result *program, const struct document *doc, const char *path)
{
    const struct document *before = &program->document->layer.doc;
    const char *slash = strrchr(path, '/');
    size_t len = slash ? (size_t)(slash - path) : 0;
    elem_id now = find_own(doc, path, len), then = find_own(before, path, len);
    return now && then
           && strcmp(str_text(doc->strings, doc_element(doc, now)->category),
                     str_text(before->strings, doc_element(before, then)->category))
                  == 0;
}

static bool is_connected(const struct document *doc, elem_id input)
{
    return doc_attr(doc, input, STR_nodename) || doc_attr(doc, input, STR_nodegraph)
           || doc_attr(doc, input, STR_interfacename) || doc_attr(doc, input, STR_output);
}

/* The name of a space from which colours are converted; "": they stay as they are. */
static const char *converted_space(const mxg_result *program, const char *space)
{
    const char *working = str_text(&program->strings, program->colorspace);
    space = library_canonical_space(space);
    return strcmp(space, "none") == 0 || strcmp(space, library_canonical_space(working)) == 0
               ? ""
               : space;
}

static bool is_same(const char *a, const char *b)
{
    return strcmp(a, b) == 0;
}

/*
 * True if the value of the input is in the colour space and the unit of the program, which has
 * their conversions compiled in, and counts: a geometric property is read in place of any value.
 */
static bool has_same_meaning(const mxg_result *program, const struct document *doc,
                             const struct shader_variable *v, elem_id input)
{
    const struct strpool *now = doc->strings, *then = &program->strings;
    const char *unit = "", *type = "", *space = "", *value_type = str_text(then, v->doc_type);
    if (input) {
        unit = str_text(now, doc_attr_value(doc, input, STR_unit));
        type = str_text(now, doc_attr_value(doc, input, STR_unittype));
        space = str_text(now, doc_inherited_attr(doc, input, STR_colorspace));
    }
    bool is_color = doc_type_is_color(doc_type_of(str_find(now, value_type, strlen(value_type))));
    return !(input && doc_attr_value(doc, input, STR_defaultgeomprop))
           && is_same(unit, str_text(then, v->unit)) && is_same(type, str_text(then, v->unittype))
           && (!is_color
               || is_same(converted_space(program, space),
                          converted_space(program, str_text(then, v->colorspace))));
}

/* The text of the value that the document has for a variable, or of its default. NULL: none. */
static const char *value_text(const mxg_result *program, const struct document *doc,
                              const struct shader_variable *v)
{
    const char *path = str_text(&program->strings, v->path);
    elem_id input = find_own(doc, path, strlen(path));
    if (!has_same_owner(program, doc, path) || (input && is_connected(doc, input))
        || !has_same_meaning(program, doc, v, input))
        return NULL;
    const char *type = str_text(&program->strings, v->doc_type);
    const struct attribute *value = input ? doc_attr(doc, input, STR_value) : NULL;
    if (input && strcmp(str_text(doc->strings, doc_attr_value(doc, input, STR_type)), type) != 0)
        return NULL;
    if (!value && v->definition && v->definition < doc->first_element
        && !doc_attr_value(doc, v->definition, STR_defaultgeomprop))
        value = doc_attr(doc, v->definition, STR_value);
    return value ? str_text(doc->strings, value->value) : NULL;
}

static bool read_value(const mxg_result *program, const struct document *doc,
                       const struct shader_variable *v, struct ir_value *out)
{
    const char *text = value_text(program, doc, v);
    doc_type type = doc_type_of(str_find(doc->strings, str_text(&program->strings, v->doc_type),
                                         str_len(&program->strings, v->doc_type)));
    return text && type && doc_parse_value(type, text, strlen(text), NULL, out)
           && out->type == v->type;
}

/* Writes the values of the document, if it has all. */
static mxg_status pack_values(const mxg_result *program, const mxg_document *document,
                              mxg_block block, void *bytes)
{
    const struct shader *shader = &program->shader;
    const struct document *doc = &document->layer.doc;
    struct ir_value value;
    for (unsigned writes = 0; writes < 2;
         writes++) { /* first a test, so that all or nothing is written */
        if (writes)
            block_pack(program, block, bytes);
        for (uint32_t i = shader->interface.first_of_block[block];
             i < shader->interface.first_of_block[block + 1]; i++) {
            const struct shader_variable *v = result_variable(program, i);
            if (!v->path)
                continue;
            if (!read_value(program, doc, v, &value))
                return MXG_ERROR_DOCUMENT;
            if (writes)
                block_write_words(v, value.w, (char *)bytes + v->offset);
        }
    }
    return MXG_OK;
}

mxg_status mxg_result_pack_block(const mxg_result *result, const mxg_document *document,
                                 mxg_block block, void *bytes, size_t capacity)
{
    size_t size = result ? block_size(result, block) : 0;
    if (!size || !bytes || capacity < size
        || (document && document->layer.base != result->document->layer.base))
        return MXG_ERROR_ARGUMENT;
    if (document)
        return pack_values(result, document, block, bytes);
    block_pack(result, block, bytes);
    return MXG_OK;
}
