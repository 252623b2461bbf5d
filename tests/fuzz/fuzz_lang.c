// SPDX-License-Identifier: Apache-2.0
/*
 * Source of the shading language: a file, and an inline expression. What parses prints as a file
 * that parses to the same text, before and after everything known is folded; functions without
 * parameters run.
 */
#include "fuzz.h"

#include "lower/lower.h"
#include "parse/parse.h"
#include "print/print.h"
#include "specialise/specialise.h"
#include "tree/interpret.h"
#include "tree/reach.h"

enum { MAX_STEPS = 20000 };

/* The file includes itself and one other. */
static bool read_source(void *user_data, const char *from, const char *ref, const char **out_name,
                        const char **out_text, size_t *out_len, const char **out_reason)
{
    const struct fuzz_job *job = user_data;
    static const char other[] =
        "const float HALF = 0.5;\nfloat twice(float x) { return x * 2.0; }\n";
    bool is_main = strcmp(ref, "main.glsl") == 0;
    (void)from;
    *out_reason = "no such file";
    *out_name = is_main ? "main.glsl" : "other.glsl";
    *out_text = is_main ? job->data : other;
    *out_len = is_main ? job->size : sizeof other - 1;
    return is_main || strcmp(ref, "other.glsl") == 0;
}

/* The declarations of a unit, as a file. Uniforms and streams have no printer of their own. */
static const char *print(struct arena *arena, const struct lang_unit *unit)
{
    struct text out;
    struct lang_style style;
    text_init(&out, arena);
    lang_style_init(&style, &lang_syntax_portable, arena);
    for (uint32_t i = 0; i < unit->user_types.len; i++) {
        ir_type_id type = (ir_type_id)(IR_TYPE_FIRST_USER + i);
        if (!lang_user_type(unit, type, NULL)->array_length)
            lang_print_struct(&style, NULL, unit, type, &out);
    }
    for (uint32_t i = 0; i < unit->globals.len; i++) {
        const struct lang_global *global = &unit->globals.items[i];
        if (global->kind == LANG_GLOBAL_CONST || global->kind == LANG_GLOBAL_OPTION) {
            lang_print_constant(&style, NULL, unit, i, &out);
            continue;
        }
        text_str(&out, global->kind == LANG_GLOBAL_UNIFORM ? "uniform " : "in ");
        lang_print_variable(&style, NULL, unit, PHRASE_PLAIN, global->type,
                            lang_word(str_text(unit->strings, global->name)), &out);
        text_str(&out, ";\n");
    }
    for (uint32_t i = 0; i < unit->functions.len; i++)
        if (!(unit->functions.items[i].flags & LANG_FN_EXPRESSION))
            lang_print_function(&style, NULL, unit, i, &out);
    return text_cstr(&out);
}

/* Parses a text into a unit of its own. False where it has errors. */
static bool parse(struct arena *arena, const char *text, size_t size, struct lang_unit *out)
{
    struct fuzz_job job = {text, size, {0}}; /* what read_source needs */
    struct lang_reader reader = {&job, read_source};
    struct diag_list diags;
    struct strpool *strings = ARENA_NEW(arena, struct strpool);
    strpool_init(strings, arena, NULL);
    lang_unit_init(out, arena, strings, NULL);
    diag_list_init(&diags, arena);
    uint32_t file = lang_parse_file(out, &reader, "", "main.glsl", (struct diag_place){0}, &diags);
    FUZZ_REQUIRE((file == LANG_NONE) == (diags.num_errors > 0));
    if (file != LANG_NONE && memchr(text, '{', size))
        return true;
    static const struct lang_input inputs[] = {{STR_in, IR_TYPE_VEC3}, {STR_type, IR_TYPE_STRING}};
    lang_parse_expression(out, text, size < 2000 ? size : 2000, inputs, 2, IR_TYPE_VOID, file,
                          (struct diag_place){0}, &diags);
    return file != LANG_NONE;
}

static void evaluate(struct arena *arena, const struct lang_unit *unit)
{
    for (uint32_t i = 0; i < unit->functions.len; i++) {
        struct ir_value results[8];
        if (unit->functions.items[i].num_params == 0 && lang_num_results(unit, i) <= 8)
            lang_eval_call(unit, i, NULL, results, &(uint32_t){MAX_STEPS}, arena);
    }
}

static void require_same(const char *first, const char *second)
{
    if (strcmp(first, second) != 0)
        fprintf(stderr, "---- first\n%s\n---- second\n%s\n", first, second);
    FUZZ_REQUIRE(strcmp(first, second) == 0);
}

static void run(struct fuzz_job *job)
{
    struct lang_unit unit, again;
    if (!parse(&job->arena, job->data, job->size, &unit))
        return;
    evaluate(&job->arena, &unit);
    const char *first = print(&job->arena, &unit);
    bool parses = parse(&job->arena, first, strlen(first), &again);
    if (!parses)
        fprintf(stderr, "----\n%s\n", first);
    FUZZ_REQUIRE(parses);
    require_same(first, print(&job->arena, &again));
    lang_make_canonical(&unit);
    evaluate(&job->arena, &unit);
    print(&job->arena, &unit);
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    fuzz_run_job(data, size, heap, (size_t)256 << 20, run);
}
