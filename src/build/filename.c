// SPDX-License-Identifier: Apache-2.0
/*
 * File names: their prefix, and interface tokens in square brackets (specification, "Filename
 * Substitutions"). The host substitutes angle brackets and braces.
 */
#include "build/build_priv.h"

static elem_id token_of(const struct builder *b, elem_id parent, str_id name)
{
    return parent ? doc_child_of_kind(build_doc(b), parent, KIND_TOKEN, name) : 0;
}

bool build_has_tokens(const struct builder *b, elem_id node)
{
    for (elem_id e = doc_element(build_doc(b), node)->first_child; e;
         e = doc_element(build_doc(b), e)->next)
        if (doc_element(build_doc(b), e)->kind == KIND_TOKEN)
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

/* Prints the value of the token "[name"; false: no such token, after a diagnostic. */
static bool print_token(struct builder *b, const struct instance *scope, elem_id element,
                        const char *name, size_t len, struct text *out)
{
    str_id id = str_find(b->shader->strings, name, len);
    elem_id token = id ? find_token(b, scope, element, id) : 0;
    if (token)
        text_str(out, build_text(b, doc_attr_value(build_doc(b), token, STR_value)));
    else
        diag_add(b->diags, DIAG_ID_unknown_token, doc_attr_place(build_doc(b), element, STR_value),
                 arena_strndup(b->arena, name, len));
    return token != 0;
}

static void substitute(struct builder *b, const struct instance *scope, elem_id element,
                       const char *from, struct text *out)
{
    static const char name_chars[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
    while (*from) {
        size_t plain = strcspn(from, "[");
        text_mem(out, from, plain);
        from += plain;
        size_t len = *from ? strspn(from + 1, name_chars) : 0;
        bool is_token = len && from[1 + len] == ']';
        if (is_token && print_token(b, scope, element, from + 1, len, out)) {
            from += len + 2;
        } else if (*from) {
            text_char(out, *from++);
        }
    }
}

str_id build_file_name(struct builder *b, const struct instance *scope, elem_id element)
{
    str_id file = doc_attr_value(build_doc(b), element, STR_value),
           prefix = doc_inherited_attr(build_doc(b), element, STR_fileprefix);
    if (!file || (!prefix && !strchr(build_text(b, file), '[')))
        return file;
    struct text name;
    text_init(&name, b->arena);
    substitute(b, scope, element, build_text(b, prefix), &name);
    substitute(b, scope, element, build_text(b, file), &name);
    return str_intern(b->shader->strings, name.data, name.len);
}
