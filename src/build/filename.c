// SPDX-License-Identifier: Apache-2.0
/*
 * File names: their prefix, and interface tokens in square brackets (specification, "Filename
 * Substitutions"). The host substitutes angle brackets and braces.
 */
#include "build/build_priv.h"

/* The token of a variant that stands in for a token of an element; 0: none does. */
static elem_id driver_of(const struct builder *b, elem_id owner, str_id name)
{
    elem_id source = library_driver(b->resolved.drives, owner, name);
    return source && doc_element(build_doc(b), source)->kind == KIND_TOKEN ? source : 0;
}

static elem_id token_of(const struct builder *b, elem_id parent, str_id name)
{
    elem_id driver = parent ? driver_of(b, parent, name) : 0;
    if (driver || !parent)
        return driver;
    return doc_child_of_kind(build_doc(b), parent, KIND_TOKEN, name);
}

bool build_has_tokens(const struct builder *b, elem_id node, uint32_t nodedef)
{
    const struct document *doc = build_doc(b);
    for (elem_id e = doc_element(doc, node)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_TOKEN)
            return true;
    if (!b->resolved.drives || nodedef == LIBRARY_NONE)
        return false;
    elem_id definition = library_nodedef(b->lib, nodedef)->element;
    for (elem_id e = doc_element(doc, definition)->first_child; e; e = doc_element(doc, e)->next)
        if (doc_element(doc, e)->kind == KIND_TOKEN
            && driver_of(b, node, doc_element(doc, e)->name))
            return true;
    return false;
}

/*
 * The definition that a graph implements, if a node uses the graph or the graph is generated
 * itself; 0: the graph belongs to the document's own graph.
 */
static elem_id definition_of(const struct builder *b, const struct instance *scope, elem_id graph)
{
    if (doc_element(build_doc(b), graph)->kind != KIND_NODEGRAPH)
        return 0;
    uint32_t nodedef = scope->nodedef;
    if (scope->graph != graph) {
        str_id name = doc_attr_value(build_doc(b), graph, STR_nodedef);
        nodedef = name ? library_nodedef_by_name(b->lib, name) : LIBRARY_NONE;
    }
    return nodedef == LIBRARY_NONE ? 0 : library_nodedef(b->lib, nodedef)->element;
}

/*
 * The token that an element sees under a name: its own or an ancestor's. In a definition: the token
 * of the node that uses it, else the definition's. A token can name another token with
 * `interfacename`. 0: no such token.
 */
static elem_id find_token(const struct builder *b, const struct instance *scope, elem_id at,
                          str_id name)
{
    for (; at; at = doc_element(build_doc(b), at)->parent) {
        elem_id token = token_of(b, at, name), definition = definition_of(b, scope, at);
        str_id interface = token ? doc_attr_value(build_doc(b), token, STR_interfacename) : 0;
        if (token && !interface)
            return token;
        name = interface ? interface : name;
        if (!definition)
            continue;
        token = scope->graph == at ? token_of(b, scope->node, name) : 0;
        interface = token ? doc_attr_value(build_doc(b), token, STR_interfacename) : 0;
        if (!interface && (token || (token = token_of(b, definition, name)) != 0))
            return token;
        if (!interface)
            continue;
        name = interface;
        at = scope->node;
        scope = scope->parent;
    }
    return 0;
}

/* Where the tokens of a name are sought. */
struct naming {
    struct builder *b;
    const struct instance *scope;
    elem_id element; /* that has the name */
    elem_id node;    /* whose definition has the element; 0: the element is no definition's */
};

static elem_id token_for(const struct naming *n, str_id name)
{
    const struct document *doc = build_doc(n->b);
    elem_id token = n->node ? token_of(n->b, n->node, name) : 0;
    str_id interface = token ? doc_attr_value(doc, token, STR_interfacename) : 0;
    if (interface)
        return find_token(n->b, n->scope, doc_element(doc, n->node)->parent, interface);
    return token ? token : find_token(n->b, n->scope, n->element, name);
}

/* Prints the value of the token "[name"; false: no such token, after a diagnostic. */
static bool print_token(const struct naming *n, const char *name, size_t len, struct text *out)
{
    struct builder *b = n->b;
    str_id id = str_find(b->shader->strings, name, len);
    elem_id token = id ? token_for(n, id) : 0;
    if (token)
        text_str(out, build_text(b, doc_attr_value(build_doc(b), token, STR_value)));
    else
        diag_add(b->diags, DIAG_ID_unknown_token,
                 doc_attr_place(build_doc(b), n->element, STR_value),
                 arena_strndup(b->arena, name, len));
    return token != 0;
}

static void substitute(const struct naming *n, const char *from, struct text *out)
{
    static const char name_chars[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
    while (*from) {
        size_t plain = strcspn(from, "[");
        text_mem(out, from, plain);
        from += plain;
        size_t len = *from ? strspn(from + 1, name_chars) : 0;
        bool is_token = len && from[1 + len] == ']';
        if (is_token && print_token(n, from + 1, len, out)) {
            from += len + 2;
        } else if (*from) {
            text_char(out, *from++);
        }
    }
}

static str_id name_of(const struct naming *n, str_id file)
{
    struct builder *b = n->b;
    str_id prefix = doc_inherited_attr(build_doc(b), n->element, STR_fileprefix);
    if (!file || (!prefix && !strchr(build_text(b, file), '[')))
        return file;
    struct text name;
    text_init(&name, b->arena);
    substitute(n, build_text(b, prefix), &name);
    substitute(n, build_text(b, file), &name);
    return str_intern(b->shader->strings, name.data, name.len);
}

str_id build_file_name(struct builder *b, const struct instance *scope, elem_id element)
{
    return name_of(&(struct naming){b, scope, element, 0},
                   doc_attr_value(build_doc(b), element, STR_value));
}

str_id build_default_file_name(struct builder *b, const struct instance *scope, elem_id node,
                               const struct port *port)
{
    if (!port->element)
        return port->value;
    return name_of(&(struct naming){b, scope, port->element, node}, port->value);
}
