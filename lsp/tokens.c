// SPDX-License-Identifier: Apache-2.0
/* The meaning of parts of the text for colours: nodes, types, names and references, numbers. */
#include "lsp/handlers.h"
#include "lsp/named_elements.h"
#include "lsp/wire.h"

#include <string.h>

/* The legend in methods.c has these in this order. */
enum token_type {
    TOKEN_FUNCTION,
    TOKEN_TYPE,
    TOKEN_VARIABLE,
    TOKEN_PARAMETER,
    TOKEN_NUMBER,
    TOKEN_KEYWORD
};
enum { TOKEN_DECLARATION = 1 };

/* Tokens as numbers, each relative to the one before. */
struct tokens {
    const struct lsp_query *query;
    json_t *data;
    struct position last;
};

/* A token stands in one line. */
static void add(struct tokens *tokens, struct span span, enum token_type type, int modifiers)
{
    const struct text *text = tokens->query->text;
    bool is_utf8 = tokens->query->session->is_utf8;
    struct position start = text_position(text, span.start, is_utf8),
                    end = text_position(text, span.end, is_utf8);
    if (span.start >= span.end || start.line != end.line)
        return;
    uint32_t lines = start.line - tokens->last.line,
             columns = lines ? start.column : start.column - tokens->last.column;
    const uint32_t numbers[] = {lines, columns, end.column - start.column, (uint32_t)type,
                                (uint32_t)modifiers};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i)
        json_array_append_new(tokens->data, json_integer(numbers[i]));
    tokens->last = start;
}

static bool is_number(const struct text *text, struct span value)
{
    for (uint32_t at = value.start; at < value.end; ++at)
        if (!strchr("0123456789.,-+eE \t", text->bytes[at]))
            return false;
    return value.start < value.end;
}

static void add_attribute(struct tokens *tokens, uint32_t element,
                          const struct model_attribute *attribute)
{
    const struct lsp_query *query = tokens->query;
    bool is_port = query_is(query, element, "input") || query_is(query, element, "output")
                   || query_is(query, element, "token");
    if (query_equals(query->text, attribute->name, "name"))
        add(tokens, attribute->value, is_port ? TOKEN_PARAMETER : TOKEN_VARIABLE,
            TOKEN_DECLARATION);
    else if (query_equals(query->text, attribute->name, "type"))
        add(tokens, attribute->value, TOKEN_TYPE, 0);
    else if (query_equals(query->text, attribute->name, "interfacename")
             || query_equals(query->text, attribute->name, "output"))
        add(tokens, attribute->value, TOKEN_PARAMETER, 0);
    else if (names_is_reference(query, element, attribute))
        add(tokens, attribute->value, TOKEN_VARIABLE, 0);
    else if (query_equals(query->text, attribute->name, "value")
             && is_number(query->text, attribute->value))
        add(tokens, attribute->value, TOKEN_NUMBER, 0);
}

json_t *handle_tokens(struct lsp_session *session, const json_t *params, struct lsp_error *error)
{
    struct lsp_query query;
    if (!lsp_query(session, params, &query, error))
        return NULL;
    struct tokens tokens = {.query = &query, .data = json_array()};
    for (uint32_t i = 0; i < query.model->num_elements; ++i) {
        const struct model_element *element = &query.model->elements[i];
        if (element->is_comment)
            continue;
        add(&tokens, element->name, query_is_node(&query, i) ? TOKEN_FUNCTION : TOKEN_KEYWORD, 0);
        for (uint32_t a = 0; a < element->num_attributes; ++a)
            add_attribute(&tokens, i, &query.model->attributes[element->first_attribute + a]);
    }
    return json_pack("{s:o}", "data", tokens.data);
}
