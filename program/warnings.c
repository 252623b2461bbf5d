// SPDX-License-Identifier: Apache-2.0
#include "program/warnings.h"

#include "program/cli.h"

#include <stdlib.h>
#include <string.h>

static bool check_id(const char *id, const char *word)
{
    struct arg_list ids = {0};
    bool found = false;
    for (uint32_t i = 0; i < mxg_catalogue_num_diagnostic_kinds() && !found; ++i) {
        mxg_diagnostic_kind kind = {sizeof kind};
        mxg_catalogue_diagnostic_kind(i, &kind);
        found = strcmp(kind.id, id) == 0;
        args_append(&ids, kind.id);
        if (found && kind.severity == MXG_SEVERITY_ERROR) {
            fprintf(stderr, "mxgen: '-W%s': '%s' is an error, which cannot be switched\n", word,
                    id);
            free(ids.items);
            return false;
        }
    }
    const char *near = found ? NULL : args_closest(id, ids.items, ids.len);
    if (near)
        fprintf(stderr, "mxgen: '-W%s': unknown id '%s' (did you mean '%s'?)\n", word, id, near);
    else if (!found)
        fprintf(stderr, "mxgen: '-W%s': unknown id '%s'; 'mxgen explain' lists all\n", word, id);
    free(ids.items);
    return found;
}

bool warnings_check(const struct arg_list *words)
{
    for (size_t i = 0; i < words->len; ++i) {
        const char *word = words->items[i];
        if (strcmp(word, "error") != 0
            && !check_id(warnings_behind(warnings_behind(word, "no-"), "error="), word))
            return false;
    }
    return true;
}

char *warnings_join(const struct arg_list *words)
{
    char *joined = cli_format("%s", "");
    for (size_t i = 0; i < words->len; ++i) {
        char *longer = cli_format("%s,%s", joined, words->items[i]);
        free(joined);
        joined = longer;
    }
    return joined;
}
