// SPDX-License-Identifier: Apache-2.0
/* Implementations without source that portable source of mxgen serves (served.def). */
#include "library/index_priv.h"

static const struct served {
    const char *node, *function, *expression;
} served[] = {
#define SERVED(node, function, expression) {#node, function, expression},
#include "library/served.def"
};

static const char source[] =
#define SOURCE(text) text
#include "library/served.def"
    ;

static const char file_name[] = "mxgen/served.glsl";

static bool read_served(void *user_data, const char *from, const char *ref, const char **out_name,
                        const char **out_text, size_t *out_len, const char **out_reason)
{
    (void)user_data, (void)from, (void)out_reason;
    *out_name = ref;
    *out_text = source;
    *out_len = sizeof source - 1;
    return true;
}

static const struct served *row_of(const struct indexer *ix, const struct implementation *impl)
{
    const char *node = index_text(ix, library_nodedef(ix->lib, impl->nodedef)->node);
    for (size_t i = 0; i < sizeof served / sizeof *served; i++)
        if (strcmp(served[i].node, node) == 0)
            return &served[i];
    return NULL;
}

bool index_served(struct indexer *ix, struct implementation *impl)
{
    const struct lang_reader reader = {.read = read_served};
    const struct served *row = row_of(ix, impl);
    struct diag_list faults;
    diag_list_init(&faults, ix->arena);
    if (!row)
        return false;
    uint32_t file = lang_parse_file(&ix->lib->unit, &reader, "", file_name,
                                    doc_place(&ix->lib->doc, impl->element), &faults);
    assert(file != LANG_NONE);
    const char *name = row->function ? row->function : row->expression;
    str_id text = str_intern_z(&ix->lib->strings, name);
    bool is_good = row->function ? index_find_function(ix, impl, text, file, &faults)
                                 : index_parse_expressions(ix, impl, text, file, &faults);
    if (!is_good)
        index_break(ix->lib, impl, &faults);
    return true;
}
