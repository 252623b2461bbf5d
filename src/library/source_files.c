// SPDX-License-Identifier: Apache-2.0
/*
 * Files with source for one target. A file keeps its text and the files that it includes; the
 * shader contains each file once, in the place of its first #include.
 */
#include "library/index_priv.h"

#include <assert.h>

enum { MAX_INCLUDES = 32 }; /* nested, as in the portable language */

const struct implied_include library_implied_includes[] = {
    {"genglsl", "mx_environment_radiance", "pbrlib/genglsl/lib/mx_environment_none.glsl", 0},
    {"genglsl", "mx_environment_radiance", "pbrlib/genglsl/lib/mx_environment_prefilter.glsl", 1},
    {"genglsl", "mx_environment_radiance", "pbrlib/genglsl/lib/mx_environment_fis.glsl", 2},
    {"genglsl", "mx_environment_irradiance", "pbrlib/genglsl/lib/mx_environment_none.glsl", 0},
    {"genglsl", "mx_environment_irradiance", "pbrlib/genglsl/lib/mx_environment_prefilter.glsl", 1},
    {"genglsl", "mx_environment_irradiance", "pbrlib/genglsl/lib/mx_environment_fis.glsl", 2},
    {"genglsl", "mx_surface_transmission", "pbrlib/genglsl/lib/mx_transmission_refract.glsl", -1},
    {NULL, NULL, NULL, 0},
};

/* The files that are being read, to find a file that includes itself. */
struct reading {
    const struct reading *outer;
    str_id name;
    unsigned depth;
};

static uint32_t find_source(const struct library *lib, str_id name)
{
    for (; lib; lib = lib->base)
        for (uint32_t i = 0; i < lib->sources.len; i++)
            if (lib->sources.items[i].name == name)
                return lib->base_sources + i;
    return LIBRARY_NONE;
}

/* ---- Includes ---- */

static uint32_t read_file(struct indexer *ix, const char *from, const char *ref, const char *user,
                          struct diag_place where, const struct reading *outer,
                          struct diag_list *diags);

/* The file of the #include at `scan`; false after a diagnostic. */
static bool read_include(struct indexer *ix, const char *name, struct scan *scan,
                         const struct reading *reading, struct diag_list *diags, uint32_t *out)
{
    struct scan_word path;
    bool has_path = scan_next(scan, &path) && path.kind == SCAN_STRING && !scan->line_ended;
    struct diag_place where = {.file = name};
    scan_place(scan, has_path ? path.begin : scan->at, &where.line, &where.column);
    if (!has_path) {
        diag_add(diags, DIAG_ID_lang_syntax, where, "#include needs the name of a file in quotes");
        return false;
    }
    uint32_t before = diags->num_errors;
    const char *ref = arena_strndup(ix->arena, path.text, path.len);
    *out = read_file(ix, name, index_include_path(ix, name, ref), name, where, reading, diags);
    if (*out == LIBRARY_NONE && diags->num_errors > before && reading->depth > 0)
        diag_add(diags, DIAG_ID_include_from, where);
    return *out != LIBRARY_NONE;
}

struct conditionals { /* open #if, #ifdef and #ifndef */
    unsigned num;
    struct scan_word last; /* where the outermost begins */
};

/* Counts a directive; false: it has no #if. */
static bool note_conditional(struct conditionals *open, const struct scan_word *directive)
{
    bool begins = directive->len >= 2 && memcmp(directive->text, "if", 2) == 0,
         ends = scan_is(directive, "endif");
    bool needs = ends || scan_is(directive, "else") || scan_is(directive, "elif");
    if (needs && open->num == 0)
        return false;
    if (begins && open->num++ == 0)
        open->last = *directive;
    open->num -= ends;
    return true;
}

static void report_conditional(const struct scan *scan, const struct scan_word *directive,
                               const char *name, struct diag_list *diags)
{
    struct diag_place where = {.file = name};
    scan_place(scan, directive->begin, &where.line, &where.column);
    diag_add(diags, DIAG_ID_lang_syntax, where,
             directive->text[0] == 'i' ? "this #if has no #endif" : "there is no #if before this");
}

/* Reads the includes of a text and stores them in refs; false after a diagnostic. */
static bool read_includes(struct indexer *ix, struct source_file *file,
                          const struct reading *reading, struct diag_list *diags)
{
    VEC(uint32_t) includes = {0};
    struct conditionals open = {0};
    struct scan scan;
    struct scan_word word;
    const char *name = index_text(ix, file->name);
    scan_begin(&scan, index_text(ix, file->text), str_len(&ix->lib->strings, file->text));
    while (scan_next(&scan, &word)) {
        uint32_t include;
        if (word.kind != SCAN_DIRECTIVE)
            continue;
        if (!note_conditional(&open, &word)) {
            report_conditional(&scan, &word, name, diags);
            return false;
        }
        if (!scan_is(&word, "include"))
            continue;
        if (!read_include(ix, name, &scan, reading, diags, &include))
            return false;
        vec_push(ix->arena, &includes, include);
    }
    if (open.num) {
        report_conditional(&scan, &open.last, name, diags);
        return false;
    }
    if (scan.unended) {
        struct diag_place where = {.file = name};
        scan_place(&scan, scan.unended, &where.line, &where.column);
        diag_add(diags, DIAG_ID_lang_syntax, where,
                 *scan.unended == '/' ? "this comment does not end"
                                      : "this line goes on after the end of the file");
        return false;
    }
    file->first_include = ix->lib->refs.len;
    file->num_includes = includes.len;
    for (uint32_t i = 0; i < includes.len; i++)
        vec_push(ix->arena, &ix->lib->refs, includes.items[i]);
    assert(file->first_include + file->num_includes == ix->lib->refs.len);
    return true;
}

/* Reports a file that includes itself, and includes that nest too deep. */
static bool check_nesting(const struct indexer *ix, str_id name, struct diag_place where,
                          const struct reading *outer, struct diag_list *diags)
{
    for (const struct reading *r = outer; r; r = r->outer)
        if (r->name == name) {
            diag_add(diags, DIAG_ID_include_cycle, where, index_text(ix, name),
                     r == outer ? "directly" : index_text(ix, outer->name));
            return false;
        }
    bool is_deep = outer && outer->depth >= MAX_INCLUDES;
    if (is_deep)
        diag_add(diags, DIAG_ID_include_depth, where, (unsigned)MAX_INCLUDES);
    return !is_deep;
}

static uint32_t read_file(struct indexer *ix, const char *from, const char *ref, const char *user,
                          struct diag_place where, const struct reading *outer,
                          struct diag_list *diags)
{
    const char *read_name = ref, *text = NULL, *reason = "the context cannot read files";
    size_t len = 0;
    if (!ix->reader
        || !ix->reader->read(ix->reader->user_data, from, ref, &read_name, &text, &len, &reason)) {
        diag_add(diags, DIAG_ID_missing_source_file, where, ref, user, reason);
        return LIBRARY_NONE;
    }
    struct source_file file = {.name = str_intern_z(&ix->lib->strings, read_name)};
    uint32_t known = find_source(ix->lib, file.name);
    if (known != LIBRARY_NONE)
        return known;
    if (!check_nesting(ix, file.name, where, outer, diags))
        return LIBRARY_NONE;
    struct reading reading = {outer, file.name, outer ? outer->depth + 1 : 0};
    file.text = str_intern(&ix->lib->strings, text, len);
    if (!read_includes(ix, &file, &reading, diags))
        return LIBRARY_NONE;
    vec_push(ix->arena, &ix->lib->sources, file);
    return ix->lib->base_sources + ix->lib->sources.len - 1;
}

uint32_t index_source_file(struct indexer *ix, const char *from, const char *ref, const char *user,
                           struct diag_place where, struct diag_list *diags)
{
    return read_file(ix, from, ref, user, where, NULL, diags);
}

/* ---- Functions ---- */

/* True if the words at `scan`, after a name, are the parameters of a definition, not of a call. */
static bool is_definition(struct scan scan)
{
    struct scan_word word;
    unsigned open = 0;
    while (scan_next(&scan, &word)) {
        open += scan_is_mark(&word, '(');
        open -= open > 0 && scan_is_mark(&word, ')');
        if (open == 0)
            return scan_next(&scan, &word) && scan_is_mark(&word, '{');
    }
    return false;
}

static bool is_qualifier(const struct scan_word *word)
{
    static const char *const qualifiers[] = {"in",    "out",     "inout", "const",
                                             "highp", "mediump", "lowp",  "output"};
    for (size_t i = 0; i < sizeof qualifiers / sizeof *qualifiers; i++)
        if (scan_is(word, qualifiers[i]))
            return true;
    return false;
}

/* Reads "in vec3 a, out float b)" up to the closing parenthesis. */
static int read_parameters(struct scan *scan, struct source_parameter *out)
{
    struct scan_word word;
    struct source_parameter parameter = {.type = {.len = 0}};
    int n = 0;
    bool is_empty = true;
    for (unsigned open = 1; open > 0 && scan_next(scan, &word);) {
        bool ends = open == 1 && (scan_is_mark(&word, ',') || scan_is_mark(&word, ')'));
        open += scan_is_mark(&word, '(');
        open -= scan_is_mark(&word, ')');
        if (ends && is_empty && open == 0)
            break;
        if (ends) {
            if (n == INDEX_MAX_PARAMETERS)
                return SOURCE_MANY_PARAMETERS;
            out[n++] = parameter;
            parameter = (struct source_parameter){.type = {.len = 0}};
            continue;
        }
        is_empty = is_empty && scan_is(&word, "void");
        if (word.kind != SCAN_NAME || is_qualifier(&word))
            continue;
        if (!parameter.type.len)
            parameter.type = word;
        else
            parameter.name = word;
    }
    return n;
}

static int find_in_text(const char *text, size_t len, const char *name,
                        struct source_parameter *out)
{
    struct scan scan;
    struct scan_word word;
    scan_begin(&scan, text, len);
    unsigned depth = 0;
    while (scan_next(&scan, &word)) {
        depth += scan_is_mark(&word, '{');
        depth -= depth > 0 && scan_is_mark(&word, '}');
        if (depth > 0 || word.kind != SCAN_NAME || !scan_is(&word, name) || !is_definition(scan))
            continue;
        scan_next(&scan, &word);
        return read_parameters(&scan, out);
    }
    return SOURCE_NO_FUNCTION;
}

int index_source_function(const struct indexer *ix, uint32_t file, const char *name,
                          struct source_parameter *out)
{
    struct library_sources all = {0};
    library_collect_sources(ix->lib, file, ix->arena, &all);
    for (uint32_t i = 0; i < all.len; i++) {
        str_id text = library_source(ix->lib, all.items[i], NULL)->text;
        int n = find_in_text(index_text(ix, text), str_len(&ix->lib->strings, text), name, out);
        if (n != SOURCE_NO_FUNCTION)
            return n;
    }
    return SOURCE_NO_FUNCTION;
}

/* ---- Implied includes ---- */

static bool calls(const struct indexer *ix, const struct library_sources *files, const char *name)
{
    for (uint32_t i = 0; i < files->len; i++) {
        str_id text = library_source(ix->lib, files->items[i], NULL)->text;
        struct scan scan;
        struct scan_word word;
        scan_begin(&scan, index_text(ix, text), str_len(&ix->lib->strings, text));
        while (scan_next(&scan, &word))
            if (word.kind == SCAN_NAME && scan_is(&word, name))
                return true;
    }
    return false;
}

static bool defines(const struct indexer *ix, uint32_t file, const char *name)
{
    struct source_parameter *unused =
        ARENA_ARRAY(ix->arena, struct source_parameter, INDEX_MAX_PARAMETERS);
    return index_source_function(ix, file, name, unused) != SOURCE_NO_FUNCTION;
}

bool index_implied_includes(struct indexer *ix, const struct implementation *impl,
                            struct verbatim *verbatim, struct diag_list *diags)
{
    enum { NUM_ROWS = sizeof library_implied_includes / sizeof *library_implied_includes - 1 };
    uint32_t found[NUM_ROWS];
    struct library_sources files = {0};
    library_collect_sources(ix->lib, verbatim->file, ix->arena, &files);
    /* from the last, because a file may call functions of earlier rows */
    for (unsigned i = NUM_ROWS; i-- > 0;) {
        const struct implied_include *row = &library_implied_includes[i];
        found[i] = LIBRARY_NONE;
        if (strcmp(row->target, index_text(ix, impl->target)) != 0
            || !calls(ix, &files, row->function) || defines(ix, verbatim->file, row->function))
            continue;
        found[i] = index_source_file(ix, index_file(ix, impl->element), row->file,
                                     index_text(ix, impl->name),
                                     doc_place(&ix->lib->doc, impl->element), diags);
        if (found[i] == LIBRARY_NONE)
            return false;
        library_collect_sources(ix->lib, found[i], ix->arena, &files);
    }
    verbatim->first_implied = ix->lib->refs.len;
    for (uint32_t i = 0; i < NUM_ROWS; i++) {
        if (found[i] == LIBRARY_NONE)
            continue;
        vec_push(ix->arena, &ix->lib->refs, i);
        vec_push(ix->arena, &ix->lib->refs, found[i]);
        verbatim->num_implied++;
    }
    return true;
}
