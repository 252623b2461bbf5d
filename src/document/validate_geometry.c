// SPDX-License-Identifier: Apache-2.0
/*
 * Geometry names and patterns (MaterialX Geometry Extensions, "Geometry Representation" and
 * "Geometry Name Expressions").
 */
#include "document/validate_elements.h"

/* One name of a list: [text, end) without surrounding blanks. */
struct geometry_name {
    const char *text, *end;
};

/* The end of the name at `text`. A comma inside braces or brackets is part of the name. */
static const char *name_end(const char *text)
{
    char until = 0;
    for (; *text && (until || *text != ','); text++) {
        if (*text == until)
            until = 0;
        else if (!until)
            until = *text == '[' ? ']' : *text == '{' ? '}' : 0;
    }
    return text;
}

static struct geometry_name trimmed(const char *text, const char *end)
{
    while (text < end && (*text == ' ' || *text == '\t' || *text == '\n'))
        text++;
    while (text < end && (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\n'))
        end--;
    return (struct geometry_name){text, end};
}

/* The fault of the brackets of one kind; NULL: none. */
static const char *bracket_fault(struct geometry_name name, char open, char close,
                                 const char *unclosed, const char *unopened, const char *empty)
{
    const char *begin = NULL;
    for (const char *c = name.text; c < name.end; c++) {
        if (*c == open && !begin)
            begin = c;
        else if (*c == close && !begin)
            return unopened;
        else if (*c == close && c == begin + 1)
            return empty;
        else if (*c == close)
            begin = NULL;
    }
    return begin ? unclosed : NULL;
}

static bool has_blank(struct geometry_name name)
{
    for (const char *c = name.text; c < name.end; c++)
        if (*c == ' ' || *c == '\t' || *c == '\n')
            return true;
    return false;
}

/* '//' matches any depth. Three slashes have no meaning, and a slash at the end lacks a name. */
static const char *slash_fault(struct geometry_name name)
{
    for (const char *c = name.text; c + 2 < name.end; c++)
        if (c[0] == '/' && c[1] == '/' && c[2] == '/')
            return "has three '/' in a row";
    size_t len = (size_t)(name.end - name.text);
    bool ends_in_one = len > 1 && name.end[-1] == '/' && name.end[-2] != '/';
    return ends_in_one ? "ends with '/'" : NULL;
}

static const char *fault_of(struct geometry_name name)
{
    if (name.text == name.end)
        return "has an empty name in the list";
    const char *fault = bracket_fault(name, '[', ']', "has a '[' without ']'",
                                      "has a ']' without '['", "has nothing between '[' and ']'");
    if (!fault)
        fault = bracket_fault(name, '{', '}', "has a '{' without '}'", "has a '}' without '{'",
                              "has nothing between '{' and '}'");
    if (!fault && has_blank(name))
        fault = "has a blank inside a name; commas separate names";
    return fault ? fault : slash_fault(name);
}

/* The fault of the first invalid name in a list. */
static const char *list_fault(const char *text)
{
    for (;; text++) {
        const char *end = name_end(text), *fault = fault_of(trimmed(text, end));
        if (fault || !*end)
            return fault;
        text = end;
    }
}

bool doc_is_geometry(const struct document *doc, elem_id element, str_id attr)
{
    if (attr == STR_geom || attr == STR_includegeom || attr == STR_excludegeom
        || attr == STR_viewergeom)
        return true;
    if (attr != STR_value || doc_element(doc, element)->kind == KIND_NODE)
        return false;
    str_id type = doc_attr_value(doc, element, STR_type);
    return type == STR_geomname || type == STR_geomnamearray;
}

const char *doc_prefixed_geometry(const struct document *doc, elem_id element, str_id attr,
                                  struct arena *arena)
{
    const char *names = str_text(doc->strings, doc_attr_value(doc, element, attr)),
               *prefix = str_text(doc->strings, doc_inherited_attr(doc, element, STR_geomprefix));
    if (!*prefix)
        return names;
    struct text out;
    text_init(&out, arena);
    for (const char *end; *names; names = end + (*end == ',')) {
        end = name_end(names);
        struct geometry_name name = trimmed(names, end);
        if (name.text < name.end)
            text_fmt(&out, "%s%s%.*s", out.len ? ", " : "", prefix, (int)(name.end - name.text),
                     name.text);
    }
    return text_cstr(&out);
}

void validate_geometry(struct validation *v, elem_id element)
{
    const struct element *e = doc_element(v->doc, element);
    const struct attribute *attrs = doc_attrs(v->doc, element);
    for (uint32_t i = 0; i < e->num_attrs; i++) {
        if (!attrs[i].value || !doc_is_geometry(v->doc, element, attrs[i].name))
            continue;
        const char *text = str_text(v->doc->strings, attrs[i].value);
        const char *fault = list_fault(text);
        if (fault)
            diag_add(v->diags, DIAG_ID_bad_geometry_name,
                     doc_attr_place(v->doc, element, attrs[i].name), text, fault);
    }
}
