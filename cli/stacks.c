// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen LOOK.mtlx --stage FILE: a shader for each distinct stack, and bindings.json. Stacks of
 * equal topology share a program: that of the first one, with other values. A network has its
 * values in it, so each stack has its own.
 */
#define _POSIX_C_SOURCE 200809L /* ftello */
#include "program/json_values.h"
#include "program/files.h"
#include "cli/generate.h"
#include "program/memory.h"
#include "program/scene_file.h"

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct program { /* a shader that stacks share */
    uint64_t topology;
    uint32_t stack; /* the first one, which gives the program its name */
    uint32_t num_stacks;
    struct arg_list names; /* of its variables; allocated */
    uint32_t next;         /* 1 + the next program in its bucket; 0: none */
};

enum { NUM_BUCKETS = 4096 };

struct stacks {
    struct generate *gen;
    const char *folder;
    struct bound_scene stage;
    struct program *programs;
    size_t num_programs;
    uint32_t buckets[NUM_BUCKETS]; /* 1 + the first program */
    json_t *stacks;                /* of bindings.json */
};

static char *stack_name(const struct stacks *s, uint32_t stack)
{
    size_t size = mxg_bindings_stack_name(s->stage.bindings, stack, NULL, 0) + 1;
    char *name = memory_alloc(size);
    mxg_bindings_stack_name(s->stage.bindings, stack, name, size);
    return name;
}

/* ---- Programs ---- */

static struct program *find_program(const struct stacks *s, uint64_t topology)
{
    uint32_t at = s->gen->is_network ? 0 : s->buckets[topology % NUM_BUCKETS];
    while (at && s->programs[at - 1].topology != topology)
        at = s->programs[at - 1].next;
    return at ? &s->programs[at - 1] : NULL;
}

static struct program *add_program(struct stacks *s, uint64_t topology, uint32_t stack,
                                   const mxg_result *result)
{
    s->programs = memory_grow(s->programs, s->num_programs, sizeof *s->programs);
    struct program *program = &s->programs[s->num_programs++];
    *program = (struct program){
        .topology = topology, .stack = stack, .next = s->buckets[topology % NUM_BUCKETS]};
    s->buckets[topology % NUM_BUCKETS] = (uint32_t)s->num_programs;
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable variable = {offsetof(mxg_variable, block)};
        mxg_result_variable(result, i, &variable);
        args_append(&program->names, cli_format("%s", variable.name));
    }
    return program;
}

/* ---- Stacks ---- */

static json_t *value_of(const mxg_variable *v)
{
    bool is_integer = strcmp(v->type, "int") == 0, is_bool = strcmp(v->type, "bool") == 0;
    if (is_bool)
        return json_boolean(v->values[0] != 0);
    if (is_integer)
        return json_integer(v->integer);
    if (v->num_values == 1)
        return json_real((double)v->values[0]);
    json_t *list = json_array();
    for (uint32_t i = 0; i < v->num_values; ++i)
        json_array_append_new(list, json_real((double)v->values[i]));
    return list;
}

static json_t *tiles_of(const mxg_result *result, uint32_t index, uint32_t num)
{
    json_t *list = json_array();
    for (uint32_t i = 0; i < num; ++i) {
        mxg_tile tile = {sizeof tile};
        json_t *item = json_object();
        mxg_result_tile(result, index, i, &tile);
        json_set_text(item, "file", tile.file);
        json_set(item, "offset", json_pack("[i,i]", tile.u, tile.v));
        json_array_append_new(list, item);
    }
    return list;
}

/* `document`: the file that textures without an `origin` are of. */
static json_t *describe(const mxg_result *result, uint32_t index, const mxg_variable *v,
                        const char *name, const char *document)
{
    json_t *item = json_object();
    json_set_text(item, "name", name);
    json_set_text(item, "slot", v->slot);
    json_set_text(item, "path", v->path);
    if (v->block == MXG_BLOCK_TEXTURES) {
        json_set_text(item, "file", v->file);
        if (strcmp(v->origin, document) != 0)
            json_set_text(item, "origin", v->origin);
        json_set_text(item, "uaddressmode", v->uaddressmode);
        json_set_text(item, "vaddressmode", v->vaddressmode);
        json_set_text(item, "filtertype", v->filtertype);
        if (v->num_tiles)
            json_set(item, "tiles", tiles_of(result, index, v->num_tiles));
    }
    if (v->num_values)
        json_set(item, v->block == MXG_BLOCK_TEXTURES ? "default" : "value", value_of(v));
    return item;
}

/* The values and textures of a stack, under the names that its program has for them. */
static void add_stack(struct stacks *s, uint32_t stack, const struct program *program,
                      const mxg_result *result)
{
    json_t *item = json_object(), *values = json_array(), *textures = json_array();
    char *name = stack_name(s, stack), *owner = stack_name(s, program->stack);
    const char *document = mxg_document_file(s->stage.document, 0);
    for (uint32_t i = 0; i < mxg_result_num_variables(result); ++i) {
        mxg_variable v = {sizeof v};
        mxg_result_variable(result, i, &v);
        bool is_texture = v.block == MXG_BLOCK_TEXTURES && *v.path;
        if (is_texture || v.block == MXG_BLOCK_PUBLIC_UNIFORMS)
            json_array_append_new(is_texture ? textures : values,
                                  describe(result, i, &v, program->names.items[i], document));
    }
    json_set_text(item, "name", name);
    json_set_text(item, "program", owner);
    json_set(item, "values", values);
    json_set(item, "textures", textures);
    json_array_append_new(s->stacks, item);
    free(name);
    free(owner);
}

/* ---- Generation ---- */

static mxg_generate_desc desc_of(const struct stacks *s, uint32_t stack)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = s->gen->target;
    desc.options = s->gen->cli.options;
    desc.bindings = s->stage.bindings;
    desc.stack = stack;
    return desc;
}

/* is_again: its messages are told. */
static mxg_result *generate_one(struct stacks *s, uint32_t stack, bool without_source,
                                bool is_again)
{
    mxg_generate_desc desc = desc_of(s, stack);
    mxg_result *result = NULL;
    desc.without_source = without_source;
    mxg_status status = mxg_generate(s->gen->cli.context, s->stage.document, &desc, &result);
    if (result && (!is_again || status != MXG_OK))
        report_list(&s->gen->cli.report, mxg_result_diagnostics(result));
    if (report_status(&s->gen->cli.report, status))
        return result;
    mxg_result_destroy(result);
    return NULL;
}

/* Writes the program of a stack that no other stack shares so far. */
static void write_program(struct stacks *s, uint32_t stack, const mxg_result *result)
{
    char *name = stack_name(s, stack);
    const mxg_generate_desc desc = desc_of(s, stack);
    if (generate_claim(s->gen, s->folder, name)) {
        generate_write(s->gen, s->folder, name, result);
        generate_write_cuts(s->gen, s->stage.document, s->folder, &desc, result);
    }
    free(name);
}

static void write_again(struct stacks *s, uint32_t stack)
{
    mxg_result *result = generate_one(s, stack, false, true);
    if (result)
        write_program(s, stack, result);
    mxg_result_destroy(result);
}

static void generate_stack(struct stacks *s, uint32_t stack)
{
    bool is_first = !s->num_programs; /* nobody can share its program */
    mxg_result *result = generate_one(s, stack, !is_first, false);
    mxg_shader_info info = {sizeof info};
    if (!result)
        return;
    mxg_result_info(result, &info);
    struct program *program = find_program(s, info.topology);
    if (!program) {
        program = add_program(s, info.topology, stack, result);
        if (is_first)
            write_program(s, stack, result);
        else
            write_again(s, stack);
    }
    ++program->num_stacks;
    add_stack(s, stack, program, result);
    for (uint32_t i = 0; i < mxg_result_num_files(result); ++i)
        generate_add_source(s->gen, mxg_result_file(result, i));
    mxg_result_destroy(result);
}

/* ---- bindings.json ---- */

/* One value for each line, in a list of an object. */
static void put_list(FILE *out, const char *key, const json_t *list)
{
    size_t index;
    json_t *item;
    fprintf(out, "  \"%s\": [", key);
    json_array_foreach(list, index, item)
    {
        fputs(index ? ",\n    " : "\n    ", out);
        json_dumpf(item, out, JSON_COMPACT | JSON_REAL_PRECISION(9));
    }
    fputs("\n  ],\n", out);
}

static json_t *list_programs(const struct stacks *s)
{
    json_t *list = json_array();
    for (size_t i = 0; i < s->num_programs; ++i) {
        const struct program *program = &s->programs[i];
        json_t *item = json_object();
        char *name = stack_name(s, program->stack);
        char *topology = cli_format("%016llx", (unsigned long long)program->topology);
        json_set_text(item, "name", name);
        json_set_text(item, "topology", topology);
        json_set_count(item, "stacks", program->num_stacks);
        json_array_append_new(list, item);
        free(topology);
        free(name);
    }
    return list;
}

/* The facts of a primitive, by kind: "tokens":[{"name":"Id",...}]. */
static void put_facts(const struct stacks *s, uint32_t primitive, FILE *out)
{
    static const char *const keys[] = {[MXG_FACT_GEOMPROP] = "geomprops",
                                       [MXG_FACT_TOKEN] = "tokens",
                                       [MXG_FACT_PROPERTY] = "properties",
                                       [MXG_FACT_VISIBILITY] = "visibility"};
    uint32_t num = mxg_bindings_num_facts(s->stage.bindings, primitive);
    for (size_t k = 0; num && k < sizeof keys / sizeof *keys; ++k) {
        json_t *list = json_array();
        for (uint32_t i = 0; i < num; ++i) {
            mxg_fact fact = {sizeof fact};
            mxg_bindings_fact(s->stage.bindings, primitive, i, &fact);
            if (fact.kind != (mxg_fact_kind)k)
                continue;
            json_t *item = json_object();
            json_set_text(item, "name", fact.name);
            json_set_text(item, "type", fact.type);
            json_set_text(item, "value", fact.value);
            json_set_text(item, "target", fact.target);
            json_array_append_new(list, item);
        }
        if (json_array_size(list)) {
            fprintf(out, ",\"%s\":", keys[k]);
            json_dumpf(list, out, JSON_COMPACT);
        }
        json_decref(list);
    }
}

/* False after an error: bindings.json is larger than the limit. */
static bool is_small(const struct stacks *s, FILE *out)
{
    size_t most = cli_max_output_size(&s->gen->cli);
    off_t size = ftello(out);
    if (size < 0 || (uintmax_t)size <= (uintmax_t)most << 20)
        return true;
    report_error(
        &s->gen->cli.report, "output-limit",
        "bindings.json has more than %zu MiB; raise the limit 'max-output-size' if this is "
        "intended",
        most);
    return false;
}

/*
 * A line for each primitive, written at once: a scene may have a million of them. False after an
 * error.
 */
static bool put_primitives(const struct stacks *s, FILE *out)
{
    uint32_t num = mxg_scene_num_primitives(s->stage.scene);
    bool good = true;
    fputs("  \"primitives\": [", out);
    for (uint32_t i = 0; i < num && (good = is_small(s, out)); ++i) {
        char *path = scene_file_path(s->stage.scene, i);
        json_t *text = json_text(path);
        uint32_t stack = mxg_bindings_stack(s->stage.bindings, i);
        char *name = stack == MXG_NONE ? NULL : stack_name(s, stack);
        fputs(i ? ",\n    {\"path\":" : "\n    {\"path\":", out);
        json_dumpf(text, out, JSON_ENCODE_ANY | JSON_COMPACT);
        if (name)
            fprintf(out, ",\"stack\":\"%s\"", name);
        put_facts(s, i, out);
        fputs("}", out);
        json_decref(text);
        free(name);
        free(path);
    }
    fputs("\n  ]\n}\n", out);
    return good;
}

static void write_bindings(struct stacks *s)
{
    struct files_stream stream;
    char *path = cli_format("%s/bindings.json", s->folder);
    const char *reason = NULL;
    if (outputs_write(&s->gen->files, &s->gen->cli.report, path, "--stage")
        && !(reason = files_begin(&stream, path))) {
        json_t *programs = list_programs(s), *target = json_text(s->gen->target);
        fputs("{\n  \"target\": ", stream.out);
        json_dumpf(target, stream.out, JSON_ENCODE_ANY);
        fputs(",\n", stream.out);
        put_list(stream.out, "programs", programs);
        put_list(stream.out, "stacks", s->stacks);
        reason = files_end(&stream, put_primitives(s, stream.out));
        json_decref(programs);
        json_decref(target);
        args_append(&s->gen->outputs, cli_format("%s", path));
    }
    if (reason)
        report_error(&s->gen->cli.report, "output-failed", "cannot write '%s': %s", path, reason);
    free(path);
}

/* ---- The whole ---- */

static bool bind_scene(struct stacks *s, const mxg_document *own)
{
    struct cli *cli = &s->gen->cli;
    struct scene_place place = {s->gen->scene_file, s->gen->look, s->gen->purpose};
    return scene_file_bind(cli, &place, own, &s->stage);
}

static bool note_files(struct stacks *s, const mxg_document *own)
{
    bool good = generate_add_source(s->gen, s->gen->scene_file);
    for (uint32_t i = 0; i < mxg_document_num_files(own); ++i)
        good = generate_add_source(s->gen, mxg_document_file(own, i)) && good;
    return good;
}

static void tell_programs(const struct stacks *s)
{
    uint32_t num = mxg_bindings_num_stacks(s->stage.bindings);
    if (!s->gen->cli.quiet)
        printf("%u %s, %zu %s\n", (unsigned)num, num == 1 ? "stack" : "stacks", s->num_programs,
               s->num_programs == 1 ? "program" : "programs");
}

void generate_stacks(struct generate *gen, const mxg_document *document, const char *folder)
{
    struct stacks *s = memory_alloc(sizeof *s);
    *s = (struct stacks){.gen = gen, .folder = folder};
    json_use_memory();
    s->stacks = json_array();
    if (note_files(s, document) && bind_scene(s, document) && generate_make_folder(gen, folder)) {
        for (uint32_t i = 0; i < mxg_bindings_num_stacks(s->stage.bindings); ++i)
            generate_stack(s, i);
        if (!gen->cli.report.errors) {
            write_bindings(s);
            tell_programs(s);
        }
    }
    for (size_t i = 0; i < s->num_programs; ++i)
        args_free(&s->programs[i].names);
    free(s->programs);
    json_decref(s->stacks);
    scene_file_unbind(&s->stage);
    free(s);
}
