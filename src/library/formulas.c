// SPDX-License-Identifier: Apache-2.0
#include "library/formulas.h"

#include "base/text.h"
#include "parse/parse.h"

#include <assert.h>

/* The file that includes all others. */
static const char index_name[] = "mxgen/formulas.glsl";

static void write_index(struct text *out)
{
    for (unsigned i = 0; i < num_formula_files; i++)
        text_fmt(out, "#include \"%s\"\n", formula_files[i].name);
}

/* "blend" of "../slabs/blend.glsl" */
static bool names(const char *ref, const char *name)
{
    const char *slash = strrchr(ref, '/'), *base = slash ? slash + 1 : ref;
    size_t len = strlen(name);
    return strncmp(base, name, len) == 0 && (!base[len] || base[len] == '.');
}

static const struct formula_file *find_file(const char *ref)
{
    for (unsigned i = 0; i < num_formula_files; i++)
        if (names(ref, formula_files[i].name))
            return &formula_files[i];
    return NULL;
}

static bool read_formulas(void *user_data, const char *from, const char *ref, const char **out_name,
                          const char **out_text, size_t *out_len, const char **out_reason)
{
    const struct lang_unit *unit = user_data;
    struct text name, text;
    (void)from, (void)out_reason;
    text_init(&name, unit->arena);
    text_init(&text, unit->arena);
    const struct formula_file *file = find_file(ref);
    for (unsigned i = 0; file && file->lines[i]; i++)
        text_str(&text, file->lines[i]);
    if (!file)
        write_index(&text);
    text_fmt(&name, "mxgen/%s.glsl", file ? file->name : "formulas");
    *out_name = text_cstr(&name);
    *out_text = text_cstr(&text);
    *out_len = text.len;
    return true;
}

void library_add_formulas(struct lang_unit *unit)
{
    const struct lang_reader reader = {.user_data = unit, .read = read_formulas};
    struct diag_list faults;
    assert(!unit->base && !unit->files.len);
    diag_list_init(&faults, unit->arena);
    uint32_t file = lang_parse_file(unit, &reader, "", index_name, (struct diag_place){0}, &faults);
    assert(file == num_formula_files && !faults.num_errors);
    (void)file;
}
