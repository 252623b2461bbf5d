// SPDX-License-Identifier: Apache-2.0
/*
 * Measures a generated shader, compiles it, and attributes its instructions to nodes and functions.
 */
#define _POSIX_C_SOURCE 200809L
#include "compile/compile.h"
#include "check/examine.h"
#include "compile/spirv.h"
#include "program/cli_targets.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define MAX_PARTS 8 /* parts per measure in a record */

/* ---- Measures ---- */

enum { STD140_ROUND = 16 }; /* alignment of blocks */

/* Bytes of a uniform outside blocks, from the name of its type: "vec3", "mat4", "int". */
static uint64_t loose_size(const mxg_variable *variable)
{
    size_t len = strlen(variable->type);
    char last = len ? variable->type[len - 1] : '\0';
    unsigned n = last >= '2' && last <= '4' ? (unsigned)(last - '0') : 1;
    unsigned components = strncmp(variable->type, "mat", 3) == 0 ? n * n : n;
    return 4u * (uint64_t)components * (variable->array_length ? variable->array_length : 1);
}

/*
 * A block ends after its last member, and light data counts one light; sizes outside blocks add up.
 */
static void add_uniform(const mxg_variable *variable, uint64_t *size)
{
    uint64_t end = (uint64_t)variable->offset + variable->byte_size;
    if (variable->byte_size == 0)
        *size += loose_size(variable);
    else if (end > *size)
        *size = (end + STD140_ROUND - 1) / STD140_ROUND * STD140_ROUND;
}

/* ---- Parts ---- */

static void add_part(struct examiner *examiner, struct check_shader *shader, enum measure measure,
                     const char *name, size_t len, uint64_t count)
{
    for (size_t i = 0; i < shader->num_parts; ++i) {
        struct check_part *part = &shader->parts[i];
        if (part->measure == measure && strncmp(part->name, name, len) == 0
            && part->name[len] == '\0') {
            part->count += count;
            return;
        }
    }
    shader->parts =
        store_grow(&examiner->store, shader->parts, shader->num_parts, sizeof *shader->parts);
    shader->parts[shader->num_parts++] =
        (struct check_part){measure, store_text(&examiner->store, name, len), count};
}

static int compare_parts(const void *a, const void *b)
{
    const struct check_part *left = a, *right = b;
    if (left->measure != right->measure)
        return left->measure < right->measure ? -1 : 1;
    if (left->count != right->count)
        return left->count < right->count ? 1 : -1;
    return strcmp(left->name, right->name);
}

/* Keeps the largest parts of each measure, in order. */
static void rank_parts(struct check_shader *shader)
{
    size_t kept = 0, num_of_measure = 0;
    if (shader->num_parts)
        qsort(shader->parts, shader->num_parts, sizeof *shader->parts, compare_parts);
    for (size_t i = 0; i < shader->num_parts; ++i) {
        num_of_measure =
            i && shader->parts[i].measure == shader->parts[i - 1].measure ? num_of_measure + 1 : 0;
        if (num_of_measure < MAX_PARTS)
            shader->parts[kept++] = shader->parts[i];
    }
    shader->num_parts = kept;
}

/* One part per texture; one part per node for uniforms. */
static void add_variable_part(struct examiner *examiner, struct check_shader *shader,
                              const mxg_variable *variable)
{
    const char *slash = strrchr(variable->path, '/');
    size_t len = slash ? (size_t)(slash - variable->path) : strlen(variable->path);
    if (variable->block == MXG_BLOCK_TEXTURES) {
        if (*variable->file)
            check_add_place(&examiner->store, examiner->document, examiner->document->file,
                            variable->file);
        const char *name = *variable->path ? variable->path : variable->name;
        add_part(examiner, shader, MEASURE_SAMPLERS, name, strlen(name), 1);
        if (*variable->path)
            add_part(examiner, shader, MEASURE_TEXTURES, name, strlen(name), 1);
    } else if (variable->block == MXG_BLOCK_PUBLIC_UNIFORMS) {
        add_part(examiner, shader, MEASURE_UNIFORM_BYTES, variable->path, len,
                 variable->byte_size ? variable->byte_size : loose_size(variable));
    }
}

static void add_closure_parts(struct examiner *examiner, const mxg_result *result,
                              struct check_shader *shader)
{
    char path[1024];
    for (uint32_t i = 0; i < shader->measures[MEASURE_CLOSURES]; ++i)
        if (mxg_result_closure_path(result, i, path, sizeof path))
            add_part(examiner, shader, MEASURE_CLOSURES, path, strlen(path), 1);
}

/* The position in a source. */
struct listing {
    const char *before; /* the previous line */
    const char *name;   /* name of the enclosing function; NULL: none */
    size_t name_len;
};

/*
 * The line "vec3 mx_rotate(vec3 v)" precedes the brace of the body; for the shader itself this line
 * contains parameters.
 */
static void enter_function(struct listing *at)
{
    size_t end = strcspn(at->before, "(\n"), begin = end;
    while (begin && at->before[begin - 1] != ' ')
        --begin;
    bool has_name = at->before[end] == '(' && end > begin;
    at->name = has_name ? at->before + begin : "main";
    at->name_len = has_name ? end - begin : strlen(at->name);
}

/*
 * Parts of a source: whole functions, lines of main by their node, and the lines around them.
 */
static void add_source_parts(struct examiner *examiner, const mxg_result *result, mxg_stage stage,
                             const char *source, struct check_shader *shader)
{
    struct listing at = {.before = ""};
    char path[1024];
    uint32_t number = 1;
    for (const char *line = source; *line; ++number) {
        size_t len = strcspn(line, "\n"), size = len + (line[len] == '\n');
        const char *name = "declarations";
        if (len == 1 && *line == '{')
            enter_function(&at);
        if (at.name)
            name =
                mxg_result_source_path(result, stage, number, path, sizeof path) ? path : at.name;
        add_part(examiner, shader, MEASURE_SOURCE_BYTES, name,
                 name == at.name ? at.name_len : strlen(name), size);
        if (len == 1 && *line == '}')
            at.name = NULL;
        at.before = line;
        line += size;
    }
}

static void measure(struct examiner *examiner, const mxg_result *result,
                    struct check_shader *shader)
{
    uint64_t sizes[MXG_NUM_BLOCKS] = {0};
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        bool is_texture = variable.block == MXG_BLOCK_TEXTURES;
        shader->measures[MEASURE_SAMPLERS] += is_texture;
        shader->measures[MEASURE_TEXTURES] += is_texture && *variable.path;
        add_uniform(&variable, &sizes[variable.block]);
        add_variable_part(examiner, shader, &variable);
    }
    shader->measures[MEASURE_UNIFORM_BYTES] = sizes[MXG_BLOCK_PUBLIC_UNIFORMS]
                                              + sizes[MXG_BLOCK_PRIVATE_UNIFORMS]
                                              + sizes[MXG_BLOCK_LIGHT_DATA];
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        size_t size = 0;
        const char *source = mxg_result_source(result, (mxg_stage)stage, &size);
        if (!source)
            continue;
        shader->measures[MEASURE_SOURCE_BYTES] += size;
        add_source_parts(examiner, result, (mxg_stage)stage, source, shader);
    }
}

/* A part of SPIR-V: a function by its name, a line of main by its node. */
static void add_spirv_part(struct examiner *examiner, const mxg_result *result, mxg_stage stage,
                           const struct spirv_part *part, struct check_shader *shader)
{
    char path[1024];
    const char *name = part->function;
    if (part->line && mxg_result_source_path(result, stage, part->line, path, sizeof path))
        name = path;
    add_part(examiner, shader, MEASURE_INSTRUCTIONS, name, strcspn(name, "("), part->instructions);
}

static void count_parts(struct examiner *examiner, const mxg_result *result,
                        const struct compiled *compiled, struct check_shader *shader)
{
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        const struct compiled_stage *code = &compiled->stages[stage];
        struct spirv_part *parts = NULL;
        size_t num_parts = 0;
        if (code->words)
            shader->measures[MEASURE_INSTRUCTIONS] +=
                spirv_count(code->words, code->num_words, &parts, &num_parts);
        for (size_t i = 0; i < num_parts; ++i)
            add_spirv_part(examiner, result, (mxg_stage)stage, &parts[i], shader);
        free(parts);
    }
}

/* ---- Compilation ---- */

/* A line of the shader, printed below its message. */
static void print_source_line(FILE *out, const char *source, uint32_t line)
{
    while (source && --line)
        source = strchr(source, '\n') ? strchr(source, '\n') + 1 : NULL;
    if (source)
        fprintf(out, "    %.*s\n", (int)strcspn(source, "\n"), source);
}

/* Reports a compiler message at the place in the document that its line comes from. */
static void add_compile_message(struct examiner *examiner, const mxg_result *result,
                                const struct compile_message *message, struct check_shader *shader,
                                const char *element)
{
    static const char *const stages[MXG_NUM_STAGES] = {"vertex", "pixel"};
    mxg_place at = {sizeof at};
    bool placed = message->line
                  && mxg_result_source_place(result, message->stage, message->line, &at) == MXG_OK
                  && at.file;
    const char *file = placed ? at.file : examiner->document->file;
    char *text =
        cli_format("'%s', %s, %s stage, line %u: %s", at.path && *at.path ? at.path : element,
                   shader->target, stages[message->stage], message->line, message->text);
    char *place =
             placed ? cli_format("%s:%u:%u", file, at.line, at.column) : cli_format("%s", file),
         *rendered = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&rendered, &size);
    bool is_error = message->severity == MXG_SEVERITY_ERROR;
    if (out) {
        fprintf(out, "%s: %s: %s [shader-invalid]\n", place, is_error ? "error" : "warning", text);
        if (message->line)
            print_source_line(out, mxg_result_source(result, message->stage, NULL), message->line);
        fclose(out);
    }
    examine_add(examiner, shader,
                (struct check_message){.severity = message->severity,
                                       .id = "shader-invalid",
                                       .text = text,
                                       .file = file,
                                       .line = placed ? at.line : 0,
                                       .column = placed ? at.column : 0,
                                       .element = element,
                                       .target = shader->target,
                                       .rendered = rendered});
    free(rendered);
    free(place);
    free(text);
}

static void compile(struct examiner *examiner, const mxg_result *result,
                    struct check_shader *shader, const char *element)
{
    double begin = examine_clock();
    channel_mark(&examiner->channel, CHECK_COMPILE, element, shader->target);
    if (!examiner->is_compiler_ready) {
        compile_begin();
        if (args_is_given(&examiner->cli->parser, "mdl-module"))
            compile_import_module(examiner->cli->context, examiner->cli->library,
                                  examiner->cli->options);
        examiner->is_compiler_ready = true;
    }
    struct compiled compiled = {0};
    shader->compiled = true;
    if (!compile_result(cli_base_target(examiner->cli, shader->target), result, &compiled))
        check_fail(&shader->failed, CHECK_COMPILE);
    shader->compile_ms = examine_clock() - begin;
    for (size_t i = 0; i < compiled.num_messages; ++i)
        add_compile_message(examiner, result, &compiled.messages[i], shader, element);
    if (!examiner->is_brief)
        count_parts(examiner, result, &compiled, shader);
    compiled_finish(&compiled);
}

static void add_facts(struct examiner *examiner, const mxg_result *result,
                      struct check_shader *shader)
{
    mxg_shader_info info = {sizeof info};
    mxg_result_info(result, &info);
    char topology[17];
    snprintf(topology, sizeof topology, "%016" PRIx64, info.topology);
    shader->topology = store_text(&examiner->store, topology, strlen(topology));
    shader->measures[MEASURE_CLOSURES] = info.num_closures;
    add_closure_parts(examiner, result, shader);
    measure(examiner, result, shader);
}

void examine_shader(struct examiner *examiner, const mxg_result *result,
                    struct check_shader *shader, const char *element)
{
    if (!examiner->is_brief)
        add_facts(examiner, result, shader);
    if (examiner->compile && compile_knows_target(cli_base_target(examiner->cli, shader->target)))
        compile(examiner, result, shader, element);
    rank_parts(shader);
    for (uint32_t i = 0; i < mxg_result_num_files(result); ++i)
        check_add_file(&examiner->store, examiner->document, mxg_result_file(result, i));
}

/* ---- Settings ---- */

/* "0.8, 0.1, 0.1", as a document writes it; the caller frees it. */
static char *value_text(const mxg_variable *variable)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    for (uint32_t i = 0; out && i < variable->num_values; ++i) {
        char number[32];
        int digits = 1; /* as few as tell this number from all others */
        do
            snprintf(number, sizeof number, "%.*g", digits, (double)variable->values[i]);
        while (digits++ < 9 && strtof(number, NULL) != variable->values[i]);
        fprintf(out, "%s%s", i ? ", " : "", number);
    }
    if (out)
        fclose(out);
    return text;
}

static void add_setting(struct examiner *examiner, struct check_setting **settings, size_t *num,
                        const char *path, const char *value)
{
    struct store *store = &examiner->store;
    *settings = store_grow(store, *settings, *num, sizeof **settings);
    (*settings)[(*num)++] = (struct check_setting){store_text(store, path, strlen(path)),
                                                   store_text(store, value, strlen(value))};
}

static void add_variable(struct examiner *examiner, struct check_element *element,
                         const mxg_variable *variable)
{
    char *value = NULL;
    if (!*variable->path)
        return;
    if (variable->block == MXG_BLOCK_TEXTURES)
        add_setting(examiner, &element->textures, &element->num_textures, variable->path,
                    variable->file);
    else if (variable->num_values && (value = value_text(variable)) != NULL)
        add_setting(examiner, &element->values, &element->num_values, variable->path, value);
    free(value);
}

void examine_settings(struct examiner *examiner, const mxg_result *result,
                      struct check_element *element)
{
    if (examiner->is_brief || element->num_values || element->num_textures)
        return;
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {sizeof variable};
        mxg_result_variable(result, i, &variable);
        add_variable(examiner, element, &variable);
    }
}
