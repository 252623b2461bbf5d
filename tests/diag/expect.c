// SPDX-License-Identifier: Apache-2.0
#include "expect.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const severity_names[3] = {"error", "warning", "note"};

const char *base_name(const char *path)
{
    const char *slash = path ? strrchr(path, '/') : NULL;
    return slash ? slash + 1 : path ? path : "";
}

char *read_text(const char *path)
{
    enum { ROOM = 1 << 20 };
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, ROOM);
    if (!text)
        exit(1);
    if (file) {
        text[fread(text, 1, ROOM - 1, file)] = '\0';
        fclose(file);
    }
    return text;
}

/* "expect-error@+1: type-mismatch 14" at line `here`. */
static bool parse(const char *text, long here, struct message *out)
{
    char severity[16], place[16] = "";
    int end = 0;
    if (sscanf(text, "expect-%15[a-z]%n", severity, &end) != 1 || end == 0)
        return false;
    text += end;
    if (*text == '@' && sscanf(text, "@%15[-+*0-9]%n", place, &end) == 1)
        text += end;
    if (sscanf(text, ": %63[a-z0-9-] %ld", out->id, &out->column) < 1)
        return false;
    out->severity = -1;
    for (int i = 0; i < 3; ++i)
        out->severity = strcmp(severity, severity_names[i]) == 0 ? i : out->severity;
    long number = strtol(place, NULL, 10);
    bool relative = place[0] == '+' || place[0] == '-';
    out->line = place[0] == '*' ? EXPECT_ANYWHERE
                : !place[0]     ? here
                : relative      ? here + number
                                : number;
    return out->severity >= 0;
}

bool expect_read(struct expectations *expectations, const char *path)
{
    for (unsigned i = 0; i < expectations->num_files; ++i)
        if (strcmp(expectations->files[i], base_name(path)) == 0)
            return true;
    if (expectations->num_files < EXPECT_MAX_FILES)
        snprintf(expectations->files[expectations->num_files++], sizeof *expectations->files, "%s",
                 base_name(path));
    struct messages *messages = &expectations->messages;
    char *text = read_text(path);
    long line = 1;
    bool good = true;
    for (const char *p = text, *next; (next = strstr(p, "expect-")) != NULL; p = next + 1) {
        for (; p < next; ++p)
            line += *p == '\n';
        struct message *m = &messages->items[messages->len];
        *m = (struct message){.column = 0};
        snprintf(m->file, sizeof m->file, "%s", base_name(path));
        if (messages->len + 1 < EXPECT_MAX_MESSAGES && parse(next, line, m))
            ++messages->len;
        else
            good = false;
    }
    free(text);
    return good;
}

void messages_add(struct messages *messages, const struct message *m)
{
    for (unsigned i = 0; i < messages->len; ++i) {
        const struct message *have = &messages->items[i];
        if (have->severity == m->severity && have->line == m->line && have->column == m->column
            && strcmp(have->id, m->id) == 0 && strcmp(have->file, m->file) == 0
            && strcmp(have->text, m->text) == 0)
            return;
    }
    if (messages->len < EXPECT_MAX_MESSAGES)
        messages->items[messages->len++] = *m;
}

static bool fits(const struct message *expected, const struct message *given)
{
    bool here = expected->line == EXPECT_ANYWHERE
                || (!expected->matched && expected->line == given->line
                    && strcmp(expected->file, given->file) == 0);
    return here && expected->severity == given->severity && strcmp(expected->id, given->id) == 0
           && (!expected->column || expected->column == given->column);
}

void expect_match(struct expectations *expectations, struct messages *given)
{
    for (unsigned g = 0; g < given->len; ++g)
        for (unsigned e = 0; e < expectations->messages.len && !given->items[g].matched; ++e)
            if (fits(&expectations->messages.items[e], &given->items[g]))
                expectations->messages.items[e].matched = given->items[g].matched = true;
}
