// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "rows.h"

#include "lines.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEVIATIONS_PERCENT = 1, MAX_FAILURES_SHOWN = 50 };

/* ---- Files ---- */

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static bool list_documents(struct suite *suite)
{
    char *folder = lines_path(suite->folder, "expected", "", "");
    DIR *dir = folder ? opendir(folder) : NULL;
    for (struct dirent *entry; dir && (entry = readdir(dir)) != NULL;) {
        const char *end = strrchr(entry->d_name, '.');
        if (!end || strcmp(end, ".csv") != 0)
            continue;
        suite->documents =
            lines_grow(suite->documents, suite->num_documents, sizeof *suite->documents);
        suite->documents[suite->num_documents++] =
            strndup(entry->d_name, (size_t)(end - entry->d_name));
    }
    if (dir)
        closedir(dir);
    free(folder);
    qsort(suite->documents, suite->num_documents, sizeof *suite->documents, compare_names);
    return suite->num_documents > 0;
}

static bool read_deviations(struct suite *suite, const char *file)
{
    char *path = file ? strdup(file) : lines_path(suite->folder, ".", "deviations", ".tsv");
    bool good = path && deviations_read(&suite->deviations, path, 0);
    free(path);
    return good;
}

bool suite_open(struct suite *suite, const char *folder, const char *deviations)
{
    *suite = (struct suite){.folder = folder};
    if (list_documents(suite))
        return read_deviations(suite, deviations);
    printf("there are no expected values in '%s'\n", folder);
    return false;
}

void suite_close(struct suite *suite)
{
    for (size_t i = 0; i < suite->num_documents; ++i)
        free(suite->documents[i]);
    free(suite->documents);
    deviations_finish(&suite->deviations);
}

char *suite_case_file(const struct suite *suite, size_t index)
{
    return lines_path(suite->folder, "cases", suite->documents[index], ".mtlx");
}

/* ---- Rows ---- */

static unsigned components_of(const char *type)
{
    static const struct {
        const char *type;
        unsigned components;
    } types[] = {{"float", 1},  {"vector2", 2}, {"vector3", 3},
                 {"color3", 3}, {"vector4", 4}, {"color4", 4}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i)
        if (strcmp(type, types[i].type) == 0)
            return types[i].components;
    return 0;
}

/* "case,type,pixels,status,tolerance,values": of 16 pixels, or of one where all are the same. */
static bool parse_row(char *line, struct row *row)
{
    char *rest = line;
    *row = (struct row){.name = strdup(lines_field(&rest, ','))};
    row->components = components_of(lines_field(&rest, ','));
    size_t pixels = strtoul(lines_field(&rest, ','), NULL, 10);
    const char *status = lines_field(&rest, ',');
    row->is_defined = strcmp(status, "ok") == 0 || strcmp(status, "derived") == 0;
    row->tolerance = strtod(lines_field(&rest, ','), NULL);
    if (!row->components || (pixels != 1 && pixels != ROW_PIXELS))
        return false;
    size_t count = pixels * row->components;
    for (size_t i = 0; i < ROW_PIXELS * row->components; ++i) {
        if (i < count && !*rest)
            return false;
        row->values[i] =
            i < count ? strtod(lines_field(&rest, ','), NULL) : row->values[i % row->components];
    }
    return !*rest;
}

bool suite_read(const struct suite *suite, size_t index, struct row_list *out)
{
    *out = (struct row_list){.document = suite->documents[index]};
    char *path = lines_path(suite->folder, "expected", out->document, ".csv"), *line = NULL;
    size_t room = 0;
    FILE *file = lines_open(path);
    bool good = file && lines_next(file, &line, &room); /* the header */
    while (good && lines_next(file, &line, &room)) {
        out->items = lines_grow(out->items, out->len, sizeof *out->items);
        good = parse_row(line, &out->items[out->len++]);
        if (!good)
            printf("%s: row %zu cannot be read\n", path, out->len);
    }
    if (file)
        fclose(file);
    free(line);
    free(path);
    return good;
}

void row_list_free(struct row_list *list)
{
    for (size_t i = 0; i < list->len; ++i)
        free(list->items[i].name);
    free(list->items);
}

/* ---- Judgement ---- */

static double difference(double a, double b)
{
    if (isfinite(a) && isfinite(b))
        return fabs(a - b);
    return a == b || (isnan(a) && isnan(b)) ? 0.0 : INFINITY;
}

/* True where all values agree; else *out_at is the one that differs most. */
static bool agrees(const struct row *row, const float *values, size_t *out_at)
{
    double worst = 0.0;
    *out_at = 0;
    for (size_t i = 0; i < ROW_PIXELS * row->components; ++i) {
        double d = difference((double)values[i], row->values[i]);
        if (d > worst) {
            worst = d;
            *out_at = i;
        }
    }
    return worst <= row->tolerance;
}

static bool fail(struct suite *suite, const struct row_list *list, const struct row *row)
{
    bool is_shown = ++suite->failed <= MAX_FAILURES_SHOWN;
    if (is_shown)
        printf("%s: %s: ", list->document, row->name);
    return is_shown;
}

void suite_judge(struct suite *suite, const struct row_list *list, const struct row *row,
                 const float *values, const char *problem)
{
    const struct deviation *deviation =
        deviations_find(&suite->deviations, list->document, row->name);
    size_t at = 0;
    bool good = values && agrees(row, values, &at);
    if (values && !row->is_defined) {
        ++suite->undefined;
    } else if (good && deviation && !deviation->is_open) {
        if (fail(suite, list, row))
            puts("agrees, though deviations.tsv has it");
    } else if (good) {
        ++suite->agree;
    } else if (values && deviation) {
        ++suite->deviate;
    } else if (fail(suite, list, row)) {
        if (values)
            printf("pixel %zu, component %zu is %.9g, not %.9g (tolerance %g)\n",
                   at / row->components, at % row->components, (double)values[at], row->values[at],
                   row->tolerance);
        else
            puts(problem);
    }
}

void suite_skip(struct suite *suite, const struct row_list *list, const struct row *row)
{
    (void)deviations_find(&suite->deviations, list->document, row->name);
    ++suite->skipped;
}

static void check_deviations(struct suite *suite, size_t num_rows)
{
    suite->failed += deviations_list_lost(&suite->deviations);
    if (suite->deviations.len * 100 > num_rows * MAX_DEVIATIONS_PERCENT) {
        printf("deviations.tsv has more than %d %% of the rows\n", MAX_DEVIATIONS_PERCENT);
        ++suite->failed;
    }
}

int suite_report(struct suite *suite, const char *name, bool is_whole)
{
    size_t total =
        suite->agree + suite->deviate + suite->undefined + suite->skipped + suite->failed;
    if (is_whole)
        check_deviations(suite, total);
    printf("%zu rows: %zu agree, %zu deviate as listed, %zu undefined in the reference, %zu "
           "not computed\n",
           total, suite->agree, suite->deviate, suite->undefined, suite->skipped);
    size_t passed = suite->agree + suite->deviate + suite->undefined;
    printf("%s: %zu passed, %zu failed\n", name, passed, suite->failed);
    return suite->failed ? 1 : passed ? 0 : 77;
}
