// SPDX-License-Identifier: Apache-2.0
/*
 * The language's front half: what parses, what is refused and with which words, what a tree holds;
 * and mutated sources, which may not parse but must not crash, hang or leave anything behind.
 *
 *     test_lang_parse lang_parse.txt [ROUNDS [FILE...]]    more rounds of mutation, and files to
 * mutate
 */
#include "lower/lower.h"
#include "parse/parse.h"
#include "print/print.h"
#include "specialise/specialise.h"
#include "tree/interpret.h"
#include "tree/reach.h"

#include "cases.h"

#include <stdlib.h>

/* A unit over files in memory. */

struct source {
    const char *name, *text;
};

struct fixture {
    struct mem mem;
    struct arena arena;
    struct strpool strings;
    struct lang_unit unit;
    struct diag_list diags;
    const struct source *sources;
    unsigned num_sources;
};

static void setup(struct fixture *f)
{
    *f = (struct fixture){0};
    mem_init(&f->mem, NULL, NULL);
    arena_init(&f->arena, &f->mem);
    strpool_init(&f->strings, &f->arena, NULL);
    lang_unit_init(&f->unit, &f->arena, &f->strings, NULL);
    diag_list_init(&f->diags, &f->arena);
}

static void teardown(struct fixture *f)
{
    arena_finish(&f->arena);
    REQUIRE_EQ(f->mem.used, 0);
}

static bool read_source(void *user_data, const char *from, const char *ref, const char **out_name,
                        const char **out_text, size_t *out_len, const char **out_reason)
{
    const struct fixture *f = user_data;
    (void)from;
    for (unsigned i = 0; i < f->num_sources; i++)
        if (strcmp(f->sources[i].name, ref) == 0) {
            *out_name = f->sources[i].name;
            *out_text = f->sources[i].text;
            *out_len = strlen(f->sources[i].text);
            return true;
        }
    *out_reason = "no such file";
    return false;
}

static uint32_t parse_sources(struct fixture *f, struct lang_unit *unit,
                              const struct source *sources, unsigned num)
{
    struct lang_reader reader = {.user_data = f, .read = read_source};
    f->sources = sources;
    f->num_sources = num;
    return lang_parse_file(unit, &reader, "", sources[0].name, (struct diag_place){.file = "test"},
                           &f->diags);
}

static uint32_t parse_text(struct fixture *f, const char *text)
{
    struct source source = {"a.glsl", text};
    return parse_sources(f, &f->unit, &source, 1);
}

static const char *messages(struct fixture *f)
{
    struct text text;
    text_init(&text, &f->arena);
    for (uint32_t i = 0; i < f->diags.items.len; i++) {
        const struct diag *diag = &f->diags.items.items[i];
        text_fmt(&text, "%u:%u: %s\n", (unsigned)diag->place.line, (unsigned)diag->place.column,
                 diag->message);
    }
    return text_cstr(&text);
}

/* Everything that a tree's reader relies on. */

static void check_tree(const struct lang_unit *unit, uint32_t id, lang_ref ref, unsigned depth)
{
    REQUIRE(depth < 1000);
    for (; ref; ref = unit->nodes.items[ref].next) {
        if (!REQUIRE(ref < unit->nodes.len))
            return;
        const struct lang_node *node = &unit->nodes.items[ref];
        const lang_ref fields[] = {node->a, node->b, node->c};
        unsigned first = 0, last = 2;
        switch ((enum lang_kind)node->kind) {
        case LANG_CONST:
            REQUIRE(node->a + ir_type_info(node->type)->components <= unit->words.len);
            first = 3;
            break;
        case LANG_VAR:
        case LANG_INPUT:
            REQUIRE(node->a < lang_function(unit, id, NULL)->num_slots);
            first = 3;
            break;
        case LANG_GLOBAL: first = 3; break;
        case LANG_OP: last = 0; break;
        case LANG_CALL:
            REQUIRE(node->a < id);
            first = last = 1;
            break;
        case LANG_DECLARE: first = last = 1; break;
        default: break;
        }
        if (node->kind <= LANG_OP)
            REQUIRE(node->type != IR_TYPE_VOID);
        for (unsigned i = first; i <= last; i++)
            check_tree(unit, id, fields[i], depth + 1);
    }
}

static void check_file(const struct lang_unit *unit, uint32_t file)
{
    const struct lang_file *f = lang_file(unit, file, NULL);
    for (uint32_t i = 0; i < f->num_functions; i++) {
        const struct lang_function *function = lang_function(unit, f->first_function + i, NULL);
        REQUIRE(function->body != 0 && function->file == file
                && function->num_params <= function->num_slots);
        REQUIRE(function->first_slot + function->num_slots <= unit->slots.len);
        check_tree(unit, f->first_function + i, function->body, 0);
    }
}

static uint32_t find(struct fixture *f, uint32_t file, const char *name)
{
    return lang_find_function(&f->unit, file, str_intern_z(&f->strings, name), NULL, 0);
}

/* Texts that parse. */

static const char everything[] =
    "// a comment with ü\n"
    "#version 450\n"
    "#define TAU (2.0 * 3.14159265)\n"
    "#define COUNT 3\n"
    "const float THIRD = 1.0 / 3.0;\n"
    "const vec2 CORNERS[4] = vec2[4](vec2(0.0), vec2(1, 0), vec2(0.0, 1.0), vec2(1.0));\n"
    "const mat3 TO_XYZ = mat3(1.0, 2.0, 3.0, vec3(4.0), 7, 8, 9);\n"
    "const int option_quality = 2;\n"
    "uniform sampler2D u_image; uniform vec4 u_table[COUNT]; in vec3 normalWorld;\n"
    "struct Ray { vec3 origin, direction; float weights[COUNT]; };\n"
    "float later(float x); /* a prototype */\n"
    "float sum(const in float w[3]) { float s = 0.0; for (int i = 0, n = w.length(); i < n; ++i) s "
    "+= w[i]; return s; }\n"
    "vec3 march(Ray ray, inout vec3 state, out float t)\n"
    "{\n"
    "    t = later(ray.weights[0]) + sum(float[](1, 2, 3u));\n"
    "    state.zx *= CORNERS[option_quality];\n"
    "    state[1]++;\n"
    "    int i = 0, bits = 1 << 3 | 2 & ~7;\n"
    "    while (true) { i += 2; if (i > COUNT) break; else if (i == 1) continue; }\n"
    "    do --i; while (i > 0 && !(i == 3) ^^ false);\n"
    "    Ray other = Ray(vec3(0), normalWorld, ray.weights);\n"
    "    other.weights[i] = bits > 0 ? float(bits) : TAU;\n"
    "    return TO_XYZ * state + texture(u_image, state.xy).rgb * u_table[1].w + other.origin;\n"
    "}\n"
    "float later(float x) { { ; } return max(x, THIRD) / 2; }\n"
    "bool is_clamp(string mode) { return mode == \"clamp\"; }\n"
    "float over(int a) { return 1.0; } float over(float a) { return 2.0; } float over(vec2 a) { "
    "return 3.0; }\n"
    "float choose() { return over(1u) + over(ivec2(1, 2)) + over(1); }\n";

static void test_everything(void)
{
    struct fixture f;
    setup(&f);
    uint32_t file = parse_text(&f, everything);
    REQUIRE_STR(messages(&f), "");
    if (REQUIRE(file != LANG_NONE)) {
        check_file(&f.unit, file);
        uint32_t later = find(&f, file, "later"), march = find(&f, file, "march"),
                 sum = find(&f, file, "sum");
        REQUIRE(later < march && sum < march);
        const struct lang_function *function = lang_function(&f.unit, march, NULL);
        REQUIRE_EQ(function->num_params, 3);
        REQUIRE_EQ(function->num_slots, 6);
        REQUIRE_EQ(function->num_callees, 2);
        /* CORNERS, option_quality, TO_XYZ, u_image, u_table, normalWorld */
        REQUIRE_EQ(function->num_globals, 6);
        REQUIRE_EQ(function->flags, LANG_FN_DERIVATIVE);
        const struct lang_slot *slots = f.unit.slots.items + function->first_slot;
        REQUIRE(!slots[0].assigned && slots[1].assigned && slots[2].assigned && slots[3].assigned
                && !slots[4].assigned);
        REQUIRE(slots[0].mode == LANG_IN && slots[1].mode == LANG_INOUT
                && slots[2].mode == LANG_OUT);
        REQUIRE_EQ(lang_function(&f.unit, later, NULL)->flags, LANG_FN_PURE | LANG_FN_STRAIGHT);
        REQUIRE_EQ(lang_function(&f.unit, sum, NULL)->flags, LANG_FN_PURE);
        REQUIRE_EQ(lang_function(&f.unit, find(&f, file, "is_clamp"), NULL)->flags,
                   LANG_FN_PURE | LANG_FN_STRAIGHT | LANG_FN_STRINGS);
    }
    REQUIRE_EQ(parse_text(&f, everything), file); /* parsed once */
    teardown(&f);
}

/* A prototype suffices for a function of the host, which has no value before a host has it. */
static void test_host_functions(void)
{
    struct fixture f;
    setup(&f);
    uint32_t file =
        parse_text(&f, "float mxg_f(float x);\nfloat g(float x) { return mxg_f(2.0) + x; }\n");
    REQUIRE(file != UINT32_MAX && !f.diags.num_errors);
    for (uint32_t i = 0; i < f.unit.functions.len; i++)
        REQUIRE(!(f.unit.functions.items[i].flags & LANG_FN_PURE));
    teardown(&f);
}

static void test_globals(void)
{
    struct fixture f;
    setup(&f);
    uint32_t file = parse_text(&f, everything);
    const struct lang_file *parsed = lang_file(&f.unit, file, NULL);
    static const struct {
        const char *name;
        uint8_t kind;
        uint32_t num_words, array_length;
        float last;
    } expected[] = {
        {"TAU", LANG_GLOBAL_CONST, 1, 0, 6.2831853f},
        {"COUNT", LANG_GLOBAL_CONST, 1, 0, 0.0f},
        {"THIRD", LANG_GLOBAL_CONST, 1, 0, 1.0f / 3.0f},
        {"CORNERS", LANG_GLOBAL_CONST, 8, 0, 1.0f},
        {"TO_XYZ", LANG_GLOBAL_CONST, 9, 0, 9.0f},
        {"option_quality", LANG_GLOBAL_OPTION, 1, 0, 0.0f},
        {"u_image", LANG_GLOBAL_UNIFORM, 0, 0, 0.0f},
        {"u_table", LANG_GLOBAL_UNIFORM, 0, 3, 0.0f},
        {"normalWorld", LANG_GLOBAL_STREAM, 0, 0, 0.0f},
    };
    REQUIRE_EQ(parsed->num_globals, sizeof expected / sizeof expected[0]);
    for (uint32_t i = 0; i < parsed->num_globals; i++) {
        const struct lang_global *global = lang_global(&f.unit, parsed->first_global + i, NULL);
        REQUIRE_STR(str_text(&f.strings, global->name), expected[i].name);
        REQUIRE_EQ(global->kind, expected[i].kind);
        REQUIRE_EQ(global->num_words, expected[i].num_words);
        REQUIRE_EQ(global->array_length, expected[i].array_length);
        if (expected[i].last != 0.0f)
            REQUIRE(f.unit.words.items[global->words + global->num_words - 1].f
                    == expected[i].last);
    }
    teardown(&f);
}

static void test_includes(void)
{
    static const struct source sources[] = {
        {"main.glsl", "float f(float x) { return g(x) + BASE; }\n#include \"mid.glsl\"\n#include "
                      "\"base.glsl\"\n"},
        {"mid.glsl", "#include \"base.glsl\"\nfloat g(float x) { return h(x); }\n"},
        {"base.glsl", "const float BASE = 2.0;\nfloat h(float x) { return x * BASE; }\n"},
    };
    struct fixture f;
    setup(&f);
    uint32_t file = parse_sources(&f, &f.unit, sources, 3);
    REQUIRE_STR(messages(&f), "");
    REQUIRE_EQ(f.unit.files.len, 3);
    REQUIRE(find(&f, file, "h") < find(&f, file, "g") && find(&f, file, "g") < find(&f, file, "f"));
    uint32_t base = lang_file(&f.unit, file, NULL)->num_includes;
    REQUIRE_EQ(base, 2);

    /* A layer above sees the files below, and parses none of them again. */
    struct lang_unit above;
    lang_unit_init(&above, &f.arena, &f.strings, &f.unit);
    REQUIRE_EQ(parse_sources(&f, &above, sources, 3), file);
    static const struct source upper = {
        "upper.glsl", "#include \"mid.glsl\"\nfloat u(float x) { return g(h(x)) * BASE; }\n"};
    struct source both[4] = {upper, sources[0], sources[1], sources[2]};
    uint32_t top = parse_sources(&f, &above, both, 4);
    REQUIRE_STR(messages(&f), "");
    REQUIRE_EQ(top, 3);
    REQUIRE_EQ(above.functions.len, 1);
    check_file(&above, top);
    const ir_type_id integer = IR_TYPE_INT, vector = IR_TYPE_VEC2;
    REQUIRE_EQ(lang_find_function(&above, top, str_intern_z(&f.strings, "u"), &integer, 1), 3);
    REQUIRE_EQ(lang_find_function(&above, top, str_intern_z(&f.strings, "u"), &vector, 1),
               LANG_NONE);
    REQUIRE_EQ(lang_find_function(&above, top, str_intern_z(&f.strings, "h"), NULL, 0), 0);
    teardown(&f);
}

static void test_include_errors(void)
{
    static const struct source cycle[] = {{"a.glsl", "#include \"b.glsl\"\n"},
                                          {"b.glsl", "\n#include \"a.glsl\"\n"}};
    struct fixture f;
    setup(&f);
    REQUIRE_EQ(parse_sources(&f, &f.unit, cycle, 2), LANG_NONE);
    REQUIRE_STR(messages(&f), "2:10: 'a.glsl' includes itself: b.glsl\n1:10: included from here\n");
    REQUIRE_EQ(f.unit.files.len, 0);
    diag_list_init(&f.diags, &f.arena);
    REQUIRE_EQ(parse_text(&f, "#include \"none.glsl\"\n#include x\nfloat f() { return 1.0; }\n"),
               LANG_NONE);
    REQUIRE_STR(messages(&f), "1:10: cannot read the source file 'none.glsl' of 'a.glsl': no such "
                              "file\n2:1: #include needs the name of a file in quotes\n");
    teardown(&f);
}

/* "refused": the messages of a text, of which nothing stays. */
static void is_refused(struct fixture *f, const struct test_case *c)
{
    REQUIRE_EQ(parse_text(f, c->in), LANG_NONE);
    REQUIRE_STR(messages(f), c->out);
    REQUIRE(f->unit.nodes.len == 1 && f->unit.functions.len == 0 && f->unit.files.len == 0
            && f->unit.slots.len == 0);
}

/* At most 20 errors, then a note. */
static void test_error_limit(void)
{
    struct fixture f;
    setup(&f);
    struct text text;
    text_init(&text, &f.arena);
    for (int i = 0; i < 100; i++)
        text_str(&text, "float f( { }\n");
    REQUIRE_EQ(parse_text(&f, text_cstr(&text)), LANG_NONE);
    REQUIRE_EQ(f.diags.num_errors, 20);
    REQUIRE_EQ(f.diags.items.len, 21);
    teardown(&f);
}

/* Inline expressions. */

static uint32_t parse_expression(struct fixture *f, const char *text, ir_type_id type,
                                 uint32_t file)
{
    const struct lang_input inputs[] = {{str_intern_z(&f->strings, "a"), IR_TYPE_VEC3},
                                        {str_intern_z(&f->strings, "b"), IR_TYPE_FLOAT},
                                        {str_intern_z(&f->strings, "file"), IR_TYPE_SAMPLER}};
    struct diag_place where = {"doc.mtlx", 10, 5, 0};
    return lang_parse_expression(&f->unit, text, strlen(text), inputs, 3, type, file, where,
                                 &f->diags);
}

static void test_expressions(void)
{
    static const struct {
        const char *text;
        ir_type_id type;
        const char *messages;
    } cases[] = {
        {"{{a}} * {{b}} + 1", IR_TYPE_VEC3, ""},
        {"{{ b }}", IR_TYPE_FLOAT, ""},
        {"3", IR_TYPE_FLOAT, ""},
        {"texture({{file}},\n {{a}}.xy).rgb", IR_TYPE_VEC3, ""},
        {"mix({{b}}, 2, {{b}} > 1)", IR_TYPE_FLOAT, ""},
        {"twice({{b}}) * SCALE", IR_TYPE_FLOAT, ""},
        {"{{a}}", IR_TYPE_FLOAT, "10:5: the expression is vec3; float was expected\n"},
        {"{{a}} +\n {{c}}", IR_TYPE_VEC3, "11:2: unknown input 'c'\n"},
        {"{{a}} {{b}}", IR_TYPE_VEC3,
         "10:11: expected an operator or the end of the expression before 'b'\n"},
        {"", IR_TYPE_VEC3, "10:5: expected an expression before 'the end'\n"},
    };
    struct fixture f;
    setup(&f);
    uint32_t file =
        parse_text(&f, "const float SCALE = 2.0; float twice(float x) { return 2.0 * x; }");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        diag_list_init(&f.diags, &f.arena);
        uint32_t id = parse_expression(&f, cases[i].text, cases[i].type, file);
        REQUIRE_STR(messages(&f), cases[i].messages);
        if (!REQUIRE((id == LANG_NONE) == (cases[i].messages[0] != 0)) || id == LANG_NONE)
            continue;
        const struct lang_function *function = lang_function(&f.unit, id, NULL);
        REQUIRE(function->flags & LANG_FN_EXPRESSION && function->num_slots == 3
                && function->return_type == cases[i].type);
        check_tree(&f.unit, id, function->body, 0);
    }
    /* not seen from there */
    REQUIRE_EQ(parse_expression(&f, "twice({{b}})", IR_TYPE_FLOAT, LANG_NONE), LANG_NONE);
    teardown(&f);
}

/* "value NUMBER": what f() gives, as the evaluator sees it. */
static void has_value(struct fixture *f, const struct test_case *c)
{
    uint32_t file = parse_text(f, c->in);
    REQUIRE_STR(messages(f), "");
    uint32_t id = file == LANG_NONE ? LANG_NONE : find(f, file, "f");
    struct ir_value value = {0};
    float expected = strtof(c->words + strlen("value "), NULL);
    bool good = id != LANG_NONE
                && lang_eval_call(&f->unit, id, NULL, &value, &(uint32_t){10000}, &f->arena);
    if (!REQUIRE(good && value.type == IR_TYPE_FLOAT && value.w[0].f == expected))
        printf("    %g, not %g\n", (double)value.w[0].f, (double)expected);
}

/* Nesting ends in a message, not on the stack. */
static void test_depth(void)
{
    static const struct {
        const char *prefix, *repeated, *middle, *closing;
    } cases[] = {
        {"float f() { return ", "(", "1.0", ")"},
        {"float f() { return ", "- ", "1.0", ""},
        {"float f(float x) { return x", "+ x", "", ""},
        {"float f(vec2 x) { return x", ".xy", ".x", ""},
        {"float f(bool x) { return ", "x ? 1.0 : ", "2.0", ""},
        {"float f(float x) { return ", "sin(", "x", ")"},
        {"void f() ", "{", "", "}"},
        {"void f(bool x) { ", "if (x) ", ";", ""},
        {"void f(bool x) { ", "if (x) ; else ", ";", ""},
        {"void f() { ", "do ", ";", " while (true);"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct fixture f;
        setup(&f);
        struct text text;
        text_init(&text, &f.arena);
        text_str(&text, cases[i].prefix);
        for (int k = 0; k < 20000; k++)
            text_str(&text, cases[i].repeated);
        text_str(&text, cases[i].middle);
        for (int k = 0; k < 20000; k++)
            text_str(&text, cases[i].closing);
        text_str(&text, "; }");
        REQUIRE_EQ(parse_text(&f, text_cstr(&text)), LANG_NONE);
        REQUIRE(f.diags.items.len > 0 && f.diags.items.items[0].id == DIAG_ID_lang_limit);
        teardown(&f);
    }
}

/* Mutations */

static uint32_t random_below(uint32_t *state, uint32_t limit)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return limit ? *state % limit : 0;
}

static const char *const fragments[] = {
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    ";",
    ",",
    ".",
    "=",
    "+",
    "-",
    "++",
    "?",
    ":",
    "\"",
    "/*",
    "*/",
    "//",
    "#",
    "\n",
    "{{",
    "}}",
    "\\\n",
    "0x",
    "1e",
    "1.0",
    "2u",
    "float",
    "vec3",
    "const",
    "struct S {",
    "uniform",
    "return",
    "if (",
    "for (",
    "x",
    "option_x",
    "\xff",
    "#define A ",
    "#include \"a.glsl\"\n",
    "float f(",
    "void",
    "out",
    "in",
    "while (",
    "sampler2D",
    "string",
    "float[](",
    "99999999999",
    "do",
    "else",
};

/* One change of `text`, which has room for 64 bytes more. */
static size_t mutate(char *text, size_t len, uint32_t *state)
{
    size_t at = random_below(state, (uint32_t)len + 1), end = at + random_below(state, 24);
    end = end < len ? end : len;
    const char *fragment = fragments[random_below(state, sizeof fragments / sizeof fragments[0])];
    size_t fragment_len = strlen(fragment);
    switch (random_below(state, 4)) {
    case 0: /* delete */ memmove(text + at, text + end, len - end); return len - (end - at);
    case 1: /* insert a fragment */
        memmove(text + at + fragment_len, text + at, len - at);
        memcpy(text + at, fragment, fragment_len);
        return len + fragment_len;
    case 2: /* repeat a part */
        memmove(text + end + (end - at), text + end, len - end);
        memcpy(text + end, text + at, end - at);
        return len + (end - at);
    default: /* overwrite a byte */
        if (at < len)
            text[at] = (char)(32 + random_below(state, 95));
        return len;
    }
}

static void fuzz(const char *seed, uint32_t rounds)
{
    size_t seed_len = strlen(seed);
    char *text = malloc(seed_len + 1024);
    for (uint32_t round = 0; text && round < rounds; round++) {
        uint32_t state = round * 2654435761u + 12345;
        size_t len = seed_len;
        memcpy(text, seed, len);
        for (uint32_t changes = 1 + random_below(&state, 8); changes; changes--)
            len = mutate(text, len, &state);
        text[len] = 0;
        struct fixture f;
        setup(&f);
        uint32_t file = parse_text(&f, text);
        REQUIRE((file == LANG_NONE) == (f.diags.num_errors > 0));
        if (file != LANG_NONE)
            check_file(&f.unit, file);
        else
            REQUIRE(f.unit.nodes.len == 1 && f.unit.words.len == 0 && f.unit.user_types.len == 0);
        uint32_t id = parse_expression(&f, text, IR_TYPE_VOID, file);
        if (id != LANG_NONE)
            check_tree(&f.unit, id, lang_function(&f.unit, id, NULL)->body, 0);
        teardown(&f);
    }
    free(text);
}

static void fuzz_file(const char *path, uint32_t rounds)
{
    FILE *file = fopen(path, "rb");
    static char text[1 << 20];
    if (!REQUIRE(file != NULL))
        return;
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    fuzz(text, rounds);
}

/* ---- Programs ---- */

static uint32_t parse_program(struct fixture *f, const char *text)
{
    return lang_parse_program(&f->unit, "program", text, strlen(text), &f->diags);
}

static const char *print_last(struct fixture *f)
{
    struct lang_style style;
    struct text text;
    text_init(&text, &f->arena);
    lang_style_init(&style, &lang_syntax_portable, &f->arena);
    lang_print_function(&style, NULL, &f->unit, f->unit.functions.len - 1, &text);
    return text_cstr(&text);
}

/* "program": what the last function becomes. */
static void becomes(struct fixture *f, const struct test_case *c)
{
    REQUIRE_EQ(parse_program(f, c->in), 0);
    REQUIRE_STR(messages(f), "");
    REQUIRE_STR(print_last(f), c->out);
}

static void test_program_variables(void)
{
    struct fixture f;
    setup(&f);
    REQUIRE_EQ(parse_program(&f, "in uint level;\nuint count = 2u, words[2];\n"), 0);
    const struct lang_global *count = &f.unit.globals.items[1], *words = &f.unit.globals.items[2];
    REQUIRE(count->kind == LANG_GLOBAL_VARIABLE && count->num_words == 1);
    REQUIRE(f.unit.words.items[count->words].u == 2);
    REQUIRE(words->kind == LANG_GLOBAL_VARIABLE && words->num_words == 0);
    teardown(&f);
}

static void test_program_refused(void)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"uint n;\nvoid f() { while (n++ < 3u) n = 0u; }", "the condition of a loop"},
        {"uint n[2];\nuint f() { return n[0]++; }", "only a variable or its member"},
        {"uint n = m;", "m"},
        {"const uint n = 1u;\nvoid f() { n = 2u; }", "constant"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct fixture f;
        setup(&f);
        REQUIRE_EQ(parse_program(&f, cases[i].text), LANG_NONE);
        if (!strstr(messages(&f), cases[i].message))
            REQUIRE_STR(messages(&f), cases[i].message);
        teardown(&f);
    }
    struct fixture f; /* none of it is in the portable language */
    setup(&f);
    REQUIRE_EQ(parse_text(&f, "uint n = 2u;"), LANG_NONE);
    teardown(&f);
    setup(&f);
    REQUIRE_EQ(parse_text(&f, "uint f(uint n) { return n++; }"), LANG_NONE);
    teardown(&f);
}

static void run_case(const struct test_case *c)
{
    struct fixture f;
    setup(&f);
    if (strncmp(c->words, "value ", 6) == 0)
        has_value(&f, c);
    else if (strcmp(c->words, "program") == 0)
        becomes(&f, c);
    else
        is_refused(&f, c);
    teardown(&f);
}

int main(int argc, char **argv)
{
    uint32_t rounds = argc > 2 ? (uint32_t)strtoul(argv[2], NULL, 10) : 2000;
    test_cases(argc > 1 ? argv[1] : NULL, run_case);
    test_everything();
    test_host_functions();
    test_globals();
    test_includes();
    test_include_errors();
    test_error_limit();
    test_expressions();
    test_depth();
    test_program_variables();
    test_program_refused();
    fuzz(everything, rounds);
    fuzz(
        "mix({{a}}.xyz, vec3({{b}}, 1.0, -2.0), clamp({{b}} * 2.0, 0, 1)) + ({{a}} * mat3(1.0))[1]",
        rounds);
    for (int i = 3; i < argc; i++)
        fuzz_file(argv[i], rounds);
    return test_report("lang_parse");
}
