// SPDX-License-Identifier: Apache-2.0
/* -W for warnings of programs, as the library has it for its own. */
#include "program/warnings.h"

#include <string.h>

const char *warnings_behind(const char *word, const char *prefix)
{
    size_t len = strlen(prefix);
    return strncmp(word, prefix, len) == 0 ? word + len : word;
}

enum warning_way warnings_way(const struct arg_list *words, const char *id)
{
    bool is_hidden = false, are_errors = false, is_error = false, is_no_error = false;
    for (size_t i = 0; i < words->len; ++i) {
        const char *rest = warnings_behind(words->items[i], "no-"),
                   *of = warnings_behind(rest, "error=");
        bool is_no = rest != words->items[i], is_of_error = of != rest;
        if (strcmp(rest, "error") == 0)
            are_errors = true;
        if (strcmp(of, id) != 0)
            continue;
        if (is_of_error) {
            is_error = !is_no;
            is_no_error = is_no;
        }
        if (!is_of_error || !is_no)
            is_hidden = is_no;
    }
    return is_hidden                                  ? WARNING_HIDDEN
           : is_error || (are_errors && !is_no_error) ? WARNING_IS_ERROR
                                                      : WARNING_SHOWN;
}
