// SPDX-License-Identifier: Apache-2.0
/*
 * Source for genglsl, read as portable: $tokens with a fixed text become this text, and the
 * functions that MaterialX's generators put above the source are an include at its end, where it
 * moves no line. Source with other tokens stays verbatim.
 */
#include "library/index_priv.h"

#include <assert.h>

static const char prelude_name[] = "mxgen/prelude.glsl";

/* The target whose source is close to the portable language. */
static const char portable_target[] = "genglsl";

static const char prelude[] =
#define PRELUDE(text) text
#include "library/prelude.def"
    ;

static const struct {
    const char *token, *text;
} fixed_tokens[] = {
    {"$texSamplerSignature", "sampler2D tex_sampler"},
    {"$texSamplerSampler2D", "tex_sampler"},
};

str_id index_replace_token(struct indexer *ix, const char *text, size_t len, const char *token,
                           const char *replacement)
{
    struct text out;
    text_init(&out, ix->arena);
    for (const char *p = text, *end = text + len, *at; p < end; p = at + strlen(token)) {
        at = strstr(p, token);
        text_mem(&out, p, (size_t)((at ? at : end) - p));
        if (!at)
            break;
        text_str(&out, replacement);
    }
    return str_intern(&ix->lib->strings, out.data, out.len);
}

const char *index_include_path(struct indexer *ix, const char *from, const char *path)
{
    static const char token[] = "$fileTransformUv";
    const char *suffix = strrchr(from, '.');
    struct text name;
    if (!strstr(path, token))
        return path;
    text_init(&name, ix->arena);
    text_fmt(&name, "mx_transform_uv%s", suffix ? suffix : "");
    return index_text(ix, index_replace_token(ix, path, strlen(path), token, text_cstr(&name)));
}

static bool read_portable(void *user_data, const char *from, const char *ref, const char **out_name,
                          const char **out_text, size_t *out_len, const char **out_reason)
{
    struct indexer *ix = user_data;
    if (strcmp(ref, prelude_name) == 0) {
        *out_name = ref;
        *out_text = prelude;
        *out_len = sizeof prelude - 1;
        return true;
    }
    if (!ix->reader->read(ix->reader->user_data, from, index_include_path(ix, from, ref), out_name,
                          out_text, out_len, out_reason))
        return false;
    for (size_t i = 0; i < sizeof fixed_tokens / sizeof *fixed_tokens; i++) {
        str_id text = index_replace_token(ix, *out_text, *out_len, fixed_tokens[i].token,
                                          fixed_tokens[i].text);
        *out_text = index_text(ix, text);
        *out_len = str_len(&ix->lib->strings, text);
    }
    struct text with_prelude;
    text_init(&with_prelude, ix->arena);
    text_mem(&with_prelude, *out_text, *out_len);
    text_fmt(&with_prelude, "\n#include \"%s\"\n", prelude_name);
    *out_text = text_cstr(&with_prelude);
    *out_len = with_prelude.len;
    return true;
}

bool index_has_prelude(const struct indexer *ix, const struct implementation *impl)
{
    return ix->reader && impl->target && strcmp(index_text(ix, impl->target), portable_target) == 0;
}

bool library_is_portable(const struct library *lib, const struct implementation *impl)
{
    if (!impl->target || impl->kind == IMPL_DYNAMIC)
        return true;
    bool is_read = impl->kind == IMPL_EXPRESSION || impl->kind == IMPL_FUNCTION;
    return is_read && strcmp(str_text(&lib->strings, impl->target), portable_target) == 0;
}

uint32_t index_parse_with_prelude(struct indexer *ix, const char *from, const char *ref,
                                  struct diag_place where, struct diag_list *diags)
{
    const struct lang_reader reader = {.user_data = ix, .read = read_portable};
    return lang_parse_file(&ix->lib->unit, &reader, from, ref ? ref : prelude_name, where, diags);
}
