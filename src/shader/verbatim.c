// SPDX-License-Identifier: Apache-2.0
#include "shader/verbatim.h"

#include "base/hash.h"
#include "base/scan.h"

#include <assert.h>

/* ---- Structs ---- */

enum { MAX_MEMBERS = 6 };
static const struct {
    const char *name;
    struct {
        const char *name;
        ir_type_id type;
    } members[MAX_MEMBERS];
} structs[NUM_SOURCE_STRUCTS] = {
    [SOURCE_STRUCT_CLOSURE_DATA] = {"ClosureData",
                                    {{"closureType", IR_TYPE_INT},
                                     {"L", IR_TYPE_VEC3},
                                     {"V", IR_TYPE_VEC3},
                                     {"N", IR_TYPE_VEC3},
                                     {"P", IR_TYPE_VEC3},
                                     {"occlusion", IR_TYPE_FLOAT}}},
    [SOURCE_STRUCT_BSDF] = {"BSDF", {{"response", IR_TYPE_VEC3}, {"throughput", IR_TYPE_VEC3}}},
    [SOURCE_STRUCT_BSDF_1_38] = {"BSDF",
                                 {{"response", IR_TYPE_VEC3},
                                  {"throughput", IR_TYPE_VEC3},
                                  {"thickness", IR_TYPE_FLOAT},
                                  {"ior", IR_TYPE_FLOAT}}},
    [SOURCE_STRUCT_VDF] = {"VDF", {{"response", IR_TYPE_VEC3}, {"throughput", IR_TYPE_VEC3}}},
    [SOURCE_STRUCT_SURFACE] = {"surfaceshader",
                               {{"color", IR_TYPE_VEC3}, {"transparency", IR_TYPE_VEC3}}},
    [SOURCE_STRUCT_DISPLACEMENT] = {"displacementshader",
                                    {{"offset", IR_TYPE_VEC3}, {"scale", IR_TYPE_FLOAT}}},
    [SOURCE_STRUCT_LIGHT] = {"lightshader",
                             {{"intensity", IR_TYPE_VEC3}, {"direction", IR_TYPE_VEC3}}},
};

ir_type_id shader_source_struct(struct shader *shader, enum source_struct which)
{
    struct ir_member members[MAX_MEMBERS];
    unsigned n = 0;
    assert(which < NUM_SOURCE_STRUCTS);
    for (; n < MAX_MEMBERS && structs[which].members[n].name; n++)
        members[n] =
            (struct ir_member){str_intern_z(shader->strings, structs[which].members[n].name),
                               structs[which].members[n].type};
    return (ir_type_id)ir_add_struct(
        shader->graph, str_intern_z(shader->strings, structs[which].name), members, n);
}

ir_type_id shader_closure_struct(struct shader *shader, enum source_convention convention,
                                 ir_type_id type)
{
    bool is_vdf = type == IR_TYPE_VDF && convention == SOURCE_CLOSURE_DATA;
    if (type == IR_TYPE_EDF) /* a colour */
        return IR_TYPE_VEC3;
    return shader_source_struct(shader, !source_has_closure_data(convention)
                                            ? SOURCE_STRUCT_BSDF_1_38
                                        : is_vdf ? SOURCE_STRUCT_VDF
                                                 : SOURCE_STRUCT_BSDF);
}

/* ---- Tokens ---- */

const struct shader_token *shader_find_token(const struct shader *shader, const char *name,
                                             size_t len)
{
    for (uint32_t i = 0; i < shader->sources.tokens.len; i++) {
        str_id known = shader->sources.tokens.items[i].name;
        if (str_len(shader->strings, known) == len
            && memcmp(str_text(shader->strings, known), name, len) == 0)
            return &shader->sources.tokens.items[i];
    }
    return NULL;
}

static const struct source_token *token_row(const struct shader *shader,
                                            const struct scan_word *word)
{
    const struct source_language *language = shader->sources.language;
    for (unsigned i = 0; language && i < language->num_tokens; i++)
        if (scan_is(word, language->tokens[i].name))
            return &language->tokens[i];
    return NULL;
}

/* The variable of the uniform "u_name" or of the stream "name"; UINT32_MAX: there is none. */
static uint32_t variable_of(struct shader *shader, const char *name, size_t len)
{
    struct text text;
    text_init(&text, shader->arena);
    text_str(&text, "u_");
    text_mem(&text, name, len);
    str_id uniform = str_intern(shader->strings, text.data, text.len);
    if (shader_knows_uniform(uniform))
        return shader_private_uniform(shader, uniform, IR_TYPE_VOID, 0);
    ir_ref stream = shader_stream(shader, str_intern(shader->strings, name, len), IR_TYPE_VOID);
    bool is_variable = stream && ir_get(shader->graph, stream)->op == IR_STREAM;
    return is_variable ? ir_get(shader->graph, stream)->attr : UINT32_MAX;
}

/* The token of a word; NULL: it is unknown. */
static const struct shader_token *add_token(struct shader *shader, const struct scan_word *word)
{
    const struct shader_token *known = shader_find_token(shader, word->text, word->len);
    if (known)
        return known;
    const struct source_token *row = token_row(shader, word);
    struct shader_token token = {.name = str_intern(shader->strings, word->text, word->len),
                                 .text = row ? row->text : NULL,
                                 .variable = UINT32_MAX};
    if (!token.text && row)
        token.variable = variable_of(shader, row->variable, strlen(row->variable));
    else if (!token.text)
        token.variable = variable_of(shader, word->text, word->len);
    if (!token.text && token.variable == UINT32_MAX)
        return NULL;
    vec_push(shader->arena, &shader->sources.tokens, token);
    return &vec_last(&shader->sources.tokens);
}

/* ---- Helpers ---- */

void shader_index_helpers(struct shader *shader)
{
    const struct source_language *language = shader->sources.language;
    if (!language || shader->sources.helper_table.num)
        return;
    assert(language->num_helpers <= SOURCE_MAX_HELPERS);
    for (uint32_t i = 0; i < language->num_helpers; i++) {
        const char *name = language->helpers[i].name;
        table_add(&shader->sources.helper_table, shader->arena, hash_bytes(name, strlen(name)),
                  i + 1);
    }
}

const char *shader_helper_text(const struct shader *shader, unsigned helper)
{
    const struct source_helper *h = &shader->sources.language->helpers[helper];
    return shader->sources.is_1_38 && h->text_1_38 ? h->text_1_38 : h->text;
}

/* The bit of the helper of this name; 0: there is none. */
static uint64_t helper_bit(const struct shader *shader, const struct scan_word *word)
{
    if (!shader->sources.language)
        return 0;
    uint32_t hash = hash_bytes(word->text, word->len);
    for (uint32_t at = hash, found; (found = table_next(&shader->sources.helper_table, hash, &at));)
        if (scan_is(word, shader->sources.language->helpers[found - 1].name))
            return (uint64_t)1 << (found - 1);
    return 0;
}

static bool is_derivative(const struct shader *shader, const struct scan_word *word)
{
    const struct source_language *language = shader->sources.language;
    for (unsigned i = 0; language && i < language->num_derivatives; i++)
        if (scan_is(word, language->derivatives[i]))
            return true;
    return false;
}

/* The helpers that a text names. */
static uint64_t uses_of(const struct shader *shader, const char *text)
{
    struct scan scan;
    struct scan_word word;
    uint64_t uses = 0;
    scan_begin(&scan, text, strlen(text));
    while (scan_next(&scan, &word))
        if (word.kind == SCAN_NAME)
            uses |= helper_bit(shader, &word);
    return uses;
}

/* ---- Texts ---- */

struct reader {
    struct shader *shader;
    struct shader_source source;
    struct source_list variables, names;
    struct source_list calls;        /* of the function that is read */
    struct source_function function; /* name 0: none is read */
    unsigned depth;                  /* of braces and parentheses */
    bool is_value;                   /* after '=' of a declaration */
    bool is_macro;                   /* after #define */
    struct scan_word last;
};

static void declare(struct reader *r, const struct scan_word *name)
{
    struct arena *arena = r->shader->arena;
    vec_push(arena, &r->names, str_intern(r->shader->strings, name->text, name->len));
    r->source.declares |= helper_bit(r->shader, name);
}

static uint32_t keep_refs(struct shader *shader, const uint32_t *refs, uint32_t n)
{
    uint32_t first = shader->sources.refs.len;
    for (uint32_t i = 0; i < n; i++)
        vec_push(shader->arena, &shader->sources.refs, refs[i]);
    return first;
}

/* At the end of a function or of its prototype, which calls nothing. */
static void end_function(struct reader *r)
{
    struct shader *shader = r->shader;
    if (!r->function.name)
        return;
    r->function.num_calls = r->calls.len;
    r->function.first_call = keep_refs(shader, r->calls.items, r->calls.len);
    vec_push(shader->arena, &shader->sources.functions, r->function);
    r->function = (struct source_function){0};
    r->calls.len = 0;
}

/* A name before '(' inside of a function is a call, or the name of a type or variable. */
static void note_call(struct reader *r, const struct scan *scan, const struct scan_word *name)
{
    const char *next = scan->at;
    while (next < scan->end && strchr(" \t\r\n", *next))
        next++;
    if (next < scan->end && *next == '(')
        vec_push(r->shader->arena, &r->calls,
                 str_intern(r->shader->strings, name->text, name->len));
}

/* A name at file scope before one of these marks is declared: "float f(", "vec3 a =", "struct S {".
 */
static void note_declaration(struct reader *r, const struct scan_word *mark)
{
    /* of two at file scope the last is the function, after a macro */
    if (r->depth == 0 && !r->is_value && r->last.len && *mark->text == '(') {
        end_function(r);
        r->function.name = str_intern(r->shader->strings, r->last.text, r->last.len);
    }
    if (r->depth == 0 && !r->is_value && r->last.len && strchr("(=;[{,", *mark->text))
        declare(r, &r->last);
    r->depth += *mark->text == '(' || *mark->text == '{';
    r->depth -= r->depth > 0 && (*mark->text == ')' || *mark->text == '}');
    if (r->depth == 0 && (*mark->text == '}' || *mark->text == ';'))
        end_function(r);
    if (r->depth == 0 && *mark->text == '=')
        r->is_value = true;
    if (r->depth == 0 && *mark->text == ';')
        r->is_value = false;
}

static bool read_word(struct reader *r, const struct scan *scan, const struct scan_word *word)
{
    if (word->kind == SCAN_TOKEN) {
        const struct shader_token *token = add_token(r->shader, word);
        if (!token)
            return false;
        if (token->variable != UINT32_MAX)
            vec_push(r->shader->arena, &r->variables, token->variable);
    }
    r->is_macro = r->is_macro && !scan->line_ended;
    if (word->kind == SCAN_NAME && r->is_macro && r->last.kind == SCAN_DIRECTIVE)
        declare(r, word);
    if (word->kind == SCAN_NAME) {
        bool *has_derivatives = r->function.name && !r->is_macro ? &r->function.has_derivatives
                                                                 : &r->source.has_derivatives;
        *has_derivatives |= is_derivative(r->shader, word);
        r->source.uses |= helper_bit(r->shader, word);
        if (r->function.name && !r->is_macro)
            note_call(r, scan, word);
    } else if (word->kind == SCAN_MARK && !r->is_macro) {
        note_declaration(r, word);
    } else if (word->kind == SCAN_DIRECTIVE) {
        r->is_macro = scan_is(word, "define");
    }
    r->last = word->kind == SCAN_NAME || word->kind == SCAN_DIRECTIVE
                  ? *word
                  : (struct scan_word){.kind = SCAN_MARK};
    return true;
}

uint32_t shader_add_source(struct shader *shader, str_id text, const uint32_t *includes,
                           uint32_t num_includes, struct source_fault *out_fault)
{
    for (uint32_t i = 0; i < shader->sources.all.len; i++)
        if (shader->sources.all.items[i].text == text)
            return i;
    shader_index_helpers(shader);
    struct reader r = {.shader = shader, .source = {.text = text, .num_includes = num_includes}};
    r.source.first_function = shader->sources.functions.len;
    struct scan scan;
    struct scan_word word;
    scan_begin(&scan, str_text(shader->strings, text), str_len(shader->strings, text));
    while (scan_next(&scan, &word)) {
        if (word.kind == SCAN_DIRECTIVE && scan_is(&word, "include")) {
            scan_next(&scan, &word); /* its file */
        } else if (!read_word(&r, &scan, &word)) {
            out_fault->token = arena_strndup(shader->arena, word.text, word.len);
            scan_place(&scan, word.begin, &out_fault->line, &out_fault->column);
            return UINT32_MAX;
        }
    }
    end_function(&r);
    r.source.num_functions = shader->sources.functions.len - r.source.first_function;
    r.source.first_include = keep_refs(shader, includes, num_includes);
    r.source.num_variables = r.variables.len;
    r.source.first_variable = keep_refs(shader, r.variables.items, r.variables.len);
    r.source.num_names = r.names.len;
    r.source.first_name = keep_refs(shader, r.names.items, r.names.len);
    vec_push(shader->arena, &shader->sources.all, r.source);
    return shader->sources.all.len - 1;
}

uint32_t shader_add_program(struct shader *shader, str_id text, const struct lang_unit *program,
                            struct source_resources resources)
{
    struct source_fault fault;
    uint32_t source = shader_add_source(shader, text, NULL, 0, &fault);
    assert(source != UINT32_MAX);
    shader->sources.all.items[source].program = program;
    shader->sources.all.items[source].resources = resources;
    return source;
}

static void add_once(struct source_list *out, uint32_t id, struct arena *arena)
{
    for (uint32_t i = 0; i < out->len; i++)
        if (out->items[i] == id)
            return;
    vec_push(arena, out, id);
}

void shader_collect_sources(const struct shader *shader, uint32_t source, struct arena *arena,
                            struct source_list *out)
{
    uint32_t next = out->len;
    add_once(out, source, arena);
    for (; next < out->len; next++) {
        const struct shader_source *at = &shader->sources.all.items[out->items[next]];
        assert(at->first_include + at->num_includes <= shader->sources.refs.len);
        for (uint32_t i = 0; i < at->num_includes; i++)
            add_once(out, shader->sources.refs.items[at->first_include + i], arena);
    }
}

static void collect_verbatim(const struct shader *shader, uint32_t verbatim, struct arena *arena,
                             struct source_list *out)
{
    const struct shader_verbatim *v = &shader->sources.calls.items[verbatim];
    for (uint32_t i = 0; i < v->num_sources; i++)
        shader_collect_sources(shader, shader->sources.refs.items[v->first_source + i], arena, out);
}

/* ---- Derivatives ---- */

/* Adds the words of an expression that may be calls. True if one needs adjacent pixels. */
static bool calls_of_expression(const struct shader *shader, const char *text,
                                struct arena *scratch, struct source_list *out)
{
    struct scan scan;
    struct scan_word word;
    bool any = false;
    scan_begin(&scan, text, strlen(text));
    while (scan_next(&scan, &word)) {
        if (word.kind != SCAN_NAME)
            continue;
        any |= is_derivative(shader, &word);
        str_id name = str_find(shader->strings, word.text, word.len);
        if (name)
            add_once(out, name, scratch);
    }
    return any;
}

/* Adds what the functions of this name call. True if one of them needs adjacent pixels. */
static bool calls_of_name(const struct shader *shader, const struct shader_source *source,
                          str_id name, struct arena *scratch, struct source_list *out)
{
    bool any = false;
    assert(source->first_function + source->num_functions <= shader->sources.functions.len);
    for (uint32_t i = 0; i < source->num_functions; i++) {
        const struct source_function *function =
            &shader->sources.functions.items[source->first_function + i];
        if (function->name != name)
            continue;
        any |= function->has_derivatives;
        for (uint32_t k = 0; k < function->num_calls; k++)
            add_once(out, shader->sources.refs.items[function->first_call + k], scratch);
    }
    return any;
}

bool shader_needs_neighbours(const struct shader *shader, const struct shader_verbatim *verbatim,
                             struct arena *scratch)
{
    struct source_list files = {0}, names = {0};
    bool any = false;
    for (uint32_t i = 0; i < verbatim->num_sources; i++)
        shader_collect_sources(shader, shader->sources.refs.items[verbatim->first_source + i],
                               scratch, &files);
    for (uint32_t i = 0; i < files.len; i++)
        any |= shader->sources.all.items[files.items[i]].has_derivatives;
    if (verbatim->function)
        vec_push(scratch, &names, verbatim->function);
    else if (verbatim->expression)
        any |= calls_of_expression(shader, str_text(shader->strings, verbatim->expression), scratch,
                                   &names);
    for (uint32_t next = 0; next < names.len && !any; next++)
        for (uint32_t i = 0; i < files.len; i++)
            any |= calls_of_name(shader, &shader->sources.all.items[files.items[i]],
                                 names.items[next], scratch, &names);
    return any;
}

void shader_mark_sources(struct shader *shader, enum shader_stage_id id)
{
    const struct shader_stage *stage = &shader->stages[id];
    struct source_list all = {0};
    for (uint32_t i = 0; i < stage->verbatim.len; i++)
        collect_verbatim(shader, stage->verbatim.items[i], shader->arena, &all);
    for (uint32_t i = 0; i < all.len; i++) {
        const struct shader_source *source = &shader->sources.all.items[all.items[i]];
        for (uint32_t k = 0; k < source->num_variables; k++) {
            uint32_t variable = shader->sources.refs.items[source->first_variable + k];
            assert(variable < shader->interface.variables.len);
            shader->interface.variables.items[variable].stages |= (uint8_t)(1u << id);
        }
    }
}

/* The helpers in `wanted`, with those that their texts name. A text names earlier helpers only. */
static uint64_t with_needed(const struct shader *shader, uint64_t wanted)
{
    for (uint32_t i = shader->sources.language ? shader->sources.language->num_helpers : 0;
         i-- > 0;)
        if (wanted >> i & 1)
            wanted |= uses_of(shader, shader_helper_text(shader, i)) & (((uint64_t)1 << i) - 1);
    return wanted;
}

uint64_t shader_stage_helpers(const struct shader *shader, const struct shader_stage *stage,
                              struct arena *scratch)
{
    uint64_t wanted = 0;
    for (uint32_t i = 0; i < stage->verbatim.len; i++) {
        struct source_list all = {0};
        uint64_t uses = 0, declares = 0;
        str_id expression = shader->sources.calls.items[stage->verbatim.items[i]].expression;
        collect_verbatim(shader, stage->verbatim.items[i], scratch, &all);
        for (uint32_t k = 0; k < all.len; k++) {
            uses |= shader->sources.all.items[all.items[k]].uses;
            declares |= shader->sources.all.items[all.items[k]].declares;
        }
        if (expression)
            uses |= uses_of(shader, str_text(shader->strings, expression));
        wanted |= uses & ~declares;
    }
    return with_needed(shader, wanted);
}
