// SPDX-License-Identifier: Apache-2.0
#include "render/default_tokens.h"

#include "program/cli.h"
#include "program/memory.h"
#include "render/bake_plan.h"

#include <stdlib.h>
#include <string.h>

/* True if a <geominfo> of the document gives some geometry another value. */
static bool differs(const mxg_document *document, const char *name)
{
    mxg_element info = bake_element(document, 0).first_child;
    for (; info; info = bake_element(document, info).next) {
        if (strcmp(bake_element(document, info).category, "geominfo") != 0)
            continue;
        mxg_element child = bake_element(document, info).first_child;
        for (; child; child = bake_element(document, child).next)
            if (bake_is_token(document, child)
                && strcmp(bake_element(document, child).name, name) == 0)
                return true;
    }
    return false;
}

void default_tokens_find(const mxg_document *document, const mxg_context *context,
                         bool for_all_geometry, struct bind_tokens *out)
{
    *out = (struct bind_tokens){.context = context};
    mxg_element child = bake_element(document, 0).first_child;
    for (; child; child = bake_element(document, child).next) {
        const mxg_element_info info = bake_element(document, child);
        const char *value = bake_attribute(document, child, "value");
        if (strcmp(info.category, "tokendefault") != 0 || !value
            || (for_all_geometry && differs(document, info.name)))
            continue;
        MEMORY_PUSH(out->items, out->num, (struct bind_token){info.name, value});
    }
}

void default_tokens_finish(struct bind_tokens *tokens)
{
    free(tokens->items);
    *tokens = (struct bind_tokens){0};
}

/* The token whose mark a text begins with: "<id>"; NULL: none. */
static const struct bind_token *token_at(const struct bind_tokens *tokens, const char *text)
{
    for (size_t i = 0; i < tokens->num; ++i) {
        size_t len = strlen(tokens->items[i].name);
        if (strncmp(text + 1, tokens->items[i].name, len) == 0 && text[len + 1] == '>')
            return &tokens->items[i];
    }
    return NULL;
}

char *tokens_replace(const struct bind_tokens *tokens, const char *file)
{
    char *name = cli_format("%.*s", (int)strcspn(file, "<"), file);
    for (const char *at = strchr(file, '<'); at; at = strchr(at, '<')) {
        const struct bind_token *token = token_at(tokens, at);
        const char *rest = token ? at + strlen(token->name) + 2 : at + 1;
        char *more =
            cli_format("%s%s%.*s", name, token ? token->value : "<", (int)strcspn(rest, "<"), rest);
        free(name);
        name = more;
        at = rest;
    }
    return name;
}

char *default_tokens_replace(const mxg_document *document, const char *file)
{
    struct bind_tokens tokens = {0};
    if (strchr(file, '<')) /* most names have no token, and a document may have many names */
        default_tokens_find(document, NULL, true, &tokens);
    char *name = tokens_replace(&tokens, file);
    default_tokens_finish(&tokens);
    return name;
}
