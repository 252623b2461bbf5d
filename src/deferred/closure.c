// SPDX-License-Identifier: Apache-2.0
/* The texts that list the values of a closure, from closure.def. */
#include "deferred/deferred_priv.h"

#include "base/hash.h"

static const struct {
    const char *type, *name, *doc;
} values[] = {
#define CLOSURE_VALUE(type, name, from, doc) {#type, #name, doc},
#include "deferred/closure.def"
#undef CLOSURE_VALUE
};
enum { NUM_VALUES = sizeof values / sizeof *values };

uint64_t deferred_hash_values(uint64_t hash)
{
    for (size_t i = 0; i < NUM_VALUES; i++) {
        hash = hash_stable(hash, values[i].type, strlen(values[i].type));
        hash = hash_stable(hash, values[i].name, strlen(values[i].name));
    }
    return hash;
}

void deferred_write_struct(struct text *out)
{
    text_str(out,
             "// A slab, with what lies above it: light on a way x through media weighs steady + "
             "color * pow(decay, x).\nstruct MxClosure\n{\n");
    for (size_t i = 0; i < NUM_VALUES; i++)
        text_fmt(out, "    %s %s;%s%s\n", values[i].type, values[i].name,
                 *values[i].doc ? " // " : "", values[i].doc);
    text_str(out, "};\n\n");
}

void deferred_write_put(struct text *out)
{
    text_str(out, "\nvoid mx_put_whole(MxClosure c)\n{\n");
    for (size_t i = 0; i < NUM_VALUES; i++)
        text_fmt(out, "    mx_put(c.%s);\n", values[i].name);
    text_str(out, "}\n\n");
}

void deferred_write_get(struct text *out)
{
    text_str(out, "\nMxClosure mx_get_whole(inout MxReader reader)\n{\n    MxClosure c;\n");
    for (size_t i = 0; i < NUM_VALUES; i++)
        text_fmt(out, "    mx_get(reader, c.%s);\n", values[i].name);
    text_str(out, "    return c;\n}\n\n");
}

/* Continues a list of parameters, in the next line where this one is full. */
static void add_param(struct text *out, size_t *line_begin, const char *type, const char *name)
{
    enum { MAX_COLUMNS = 100 };
    bool is_full = out->len + strlen(type) + strlen(name) > *line_begin + MAX_COLUMNS;
    text_str(out, is_full ? ",\n" : ", ");
    if (is_full) {
        *line_begin = out->len;
        text_str(out, "                     ");
    }
    text_fmt(out, "%s %s", type, name);
}

void deferred_write_store(struct text *out)
{
    text_str(out, "\n// A material calls it for each slab, from the top down.\n"
                  "int mx_store_closure(int before");
    size_t line_begin = out->len;
    for (size_t i = 0; i < NUM_VALUES; i++)
        add_param(out, &line_begin, values[i].type, values[i].name);
    text_str(out, ")\n{\n    MxClosure c;\n");
    for (size_t i = 0; i < NUM_VALUES; i++)
        text_fmt(out, "    c.%s = %s;\n", values[i].name, values[i].name);
    text_str(out, "    return mx_store(before, c);\n}\n");
}
