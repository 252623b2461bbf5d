// SPDX-License-Identifier: Apache-2.0
/*
 * Names of files in a document: their prefix, and interface tokens in square brackets
 * (specification, "Filename Substitutions"). Those in angle brackets and braces stay.
 */
#define _POSIX_C_SOURCE 200809L
#include "render/bake_plan.h"

#include "program/cli.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

bool bake_is_set(const char *file)
{
    return strchr(file, '<') || strchr(file, '{');
}

/* ---- Tokens ---- */

bool bake_is_token(const mxg_document *document, mxg_element element)
{
    return strcmp(bake_element(document, element).category, "token") == 0;
}

static mxg_element token_below(const mxg_document *document, mxg_element parent, const char *name)
{
    mxg_element child = bake_element(document, parent).first_child;
    while (child) {
        mxg_element_info info = bake_element(document, child);
        if (bake_is_token(document, child) && strcmp(info.name, name) == 0)
            return child;
        child = info.next;
    }
    return 0;
}

/*
 * The value of the token that an element sees under a name: its own or that of an element around
 * it. A token can name another one. NULL: there is none, or a definition's nodes have it.
 */
static const char *find_token(const mxg_document *document, mxg_element at, const char *name)
{
    for (;;) {
        mxg_element token = token_below(document, at, name);
        const char *other = token ? bake_attribute(document, token, "interfacename") : NULL;
        if (token && !other)
            return bake_attribute(document, token, "value");
        name = other ? other : name;
        if (!at || bake_is_definition(document, at))
            return NULL;
        at = bake_element(document, at).parent;
    }
}

const char *bake_token_value(const mxg_document *document, mxg_element token)
{
    mxg_element_info info = bake_element(document, token);
    return find_token(document, info.parent, info.name);
}

/* Tokens that are not there stay as they are. The caller frees the text. */
static char *substitute(const mxg_document *document, mxg_element element, const char *from)
{
    static const char name_chars[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";
    char *out = NULL;
    size_t size;
    FILE *text = open_memstream(&out, &size);
    while (text && *from) {
        size_t len = *from == '[' ? strspn(from + 1, name_chars) : 0;
        char *name = len && from[1 + len] == ']' ? cli_copy(from + 1, len) : NULL;
        const char *value = name ? find_token(document, element, name) : NULL;
        if (value)
            fputs(value, text);
        else
            fputc(*from, text);
        from += value ? len + 2 : 1;
        free(name);
    }
    if (!text || fclose(text) != 0)
        memory_fail();
    return out;
}

/* ---- Paths ---- */

char *bake_file_path(const mxg_document *document, const char *path, mxg_element element,
                     const char *file)
{
    const char *prefix = bake_inherited(document, element, "fileprefix"),
               *from = bake_element(document, element).file;
    char *named = cli_format("%s%s", prefix ? prefix : "", file),
         *whole = substitute(document, element, named);
    char *out = cli_beside(from ? from : path, whole);
    free(named);
    free(whole);
    return out;
}
