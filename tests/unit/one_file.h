// SPDX-License-Identifier: Apache-2.0
/* A file of portable functions that a test has as text. */
#ifndef MXG_TESTS_ONE_FILE_H
#define MXG_TESTS_ONE_FILE_H

#include "lower/lower.h"
#include "parse/parse.h"
#include "print/print.h"
#include "specialise/specialise.h"
#include "tree/interpret.h"
#include "tree/reach.h"

#include <stdio.h>

static inline bool read_one_file(void *user_data, const char *from, const char *ref,
                                 const char **out_name, const char **out_text, size_t *out_len,
                                 const char **out_reason)
{
    (void)from, (void)out_reason;
    *out_name = ref;
    *out_text = user_data;
    *out_len = strlen(*out_text);
    return true;
}

/* Its number; LANG_NONE after an error. Messages are printed. */
static inline uint32_t parse_one_file(struct lang_unit *unit, const char *source)
{
    struct diag_list diags;
    diag_list_init(&diags, unit->arena);
    struct lang_reader reader = {(void *)(uintptr_t)source, read_one_file};
    uint32_t file = lang_parse_file(unit, &reader, "", "test.glsl", (struct diag_place){0}, &diags);
    for (uint32_t i = 0; i < diags.items.len; i++)
        printf("test.glsl:%u: %s\n", diags.items.items[i].place.line, diags.items.items[i].message);
    return file;
}

#endif
