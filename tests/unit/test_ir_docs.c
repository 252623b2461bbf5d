// SPDX-License-Identifier: Apache-2.0
/*
 * The tables of docs/ir.md are those of ops.def, types.def and rules.def, and its examples are IR.
 * Argument: the path of the document (its own by default); with --update behind it, the tables are
 * written anew. Tables stand between
 * <!-- name --> and <!-- end -->.
 */
#include "ir/ir_priv.h"

#include "ir_text.h"
#include "test.h"

#include <stdlib.h>

static struct mem mem;
static struct arena arena;

static void write_types(struct text *out)
{
    text_str(out, "| type | component | components | columns |\n| --- | --- | --- | --- |\n");
    for (unsigned type = 0; type < IR_NUM_TYPES; type++) {
        const struct ir_type_info *info = ir_type_info((ir_type_id)type);
        text_fmt(out, "| `%s` | ", info->text);
        if (info->components)
            text_fmt(out, "`%s` | %u | %u |\n", ir_type_text(info->scalar),
                     (unsigned)info->components, (unsigned)info->columns);
        else
            text_str(out, "| | |\n");
    }
}

static void write_flags(struct text *out, unsigned flags)
{
    static const char *const names[] = {"pure",           "commutes",   "derivative",
                                        "built-in",       "operator",   "also of `int`",
                                        "also of `uint`", "of matrices"};
    bool first = true;
    for (unsigned i = 0; i < sizeof names / sizeof *names; i++) {
        if (flags >> i & 1) {
            text_fmt(out, "%s%s", first ? "" : ", ", names[i]);
            first = false;
        }
    }
}

static void write_ops(struct text *out)
{
    static const char *const rules[] = {[IR_RULE_NONE] = "",
                                        [IR_RULE_SAME] = "same",
                                        [IR_RULE_ARITH] = "arith",
                                        [IR_RULE_SPLAT] = "splat",
                                        [IR_RULE_REDUCE] = "reduce",
                                        [IR_RULE_COMPARE] = "compare",
                                        [IR_RULE_RELATION] = "relation",
                                        [IR_RULE_CHOICE] = "choice",
                                        [IR_RULE_LOGIC] = "logic",
                                        [IR_RULE_INTEGER] = "integer",
                                        [IR_RULE_SELECT] = "select"};
    text_str(out,
             "| op | operands | typing | marks | meaning |\n| --- | --- | --- | --- | --- |\n");
    for (unsigned op = 0; op < IR_NUM_OPS; op++) {
        const struct ir_op_info *info = ir_op_info((enum ir_op)op);
        text_fmt(out, "| `%s` | ", info->text);
        if (info->arity >= 0)
            text_i32(out, info->arity);
        else
            text_str(out, "any");
        text_fmt(out, " | %s | ", rules[info->rule]);
        write_flags(out, info->flags);
        text_str(out, " | ");
        for (const char *c = info->doc; *c; c++)
            text_str(out, *c == '|' ? "\\|" : (char[]){*c, '\0'});
        text_str(out, " |\n");
    }
}

/* A rule's side as a call: mul(A, sub(1, B)). */
static void write_side(struct text *out, const uint8_t **tokens)
{
    static const char *const names[] = {"A", "B", "C",   "D",  "E",        "K",    "0",
                                        "1", "2", "1/2", "-1", "identity", "true", "false"};
    unsigned token = *(*tokens)++;
    if (token >= RULE_A) {
        text_str(out, names[token - RULE_A]);
        return;
    }
    const struct ir_op_info *info = ir_op_info((enum ir_op)token);
    text_fmt(out, "%s(", info->text);
    for (int8_t i = 0; i < info->arity; i++) {
        text_str(out, i ? ", " : "");
        write_side(out, tokens);
    }
    text_char(out, ')');
}

static void write_rules(struct text *out)
{
    text_str(out, "| rule | | from | to |\n| --- | --- | --- | --- |\n");
    for (unsigned op = 0; op < IR_NUM_OPS; op++) {
        const struct rule *rules = ir_rules[op].rules;
        for (unsigned i = 0; i < ir_rules[op].num; i++) {
            const uint8_t *from = rules[i].pattern, *to = rules[i].replacement;
            text_fmt(out, "| %s | %s | `", rules[i].name, rules[i].exact ? "exact" : "finite");
            write_side(out, &from);
            text_str(out, "` | `");
            write_side(out, &to);
            text_str(out, "` |\n");
        }
    }
}

static bool read_file(const char *path, struct text *out)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    for (int c = fgetc(file); c != EOF; c = fgetc(file))
        text_char(out, (char)c);
    fclose(file);
    return true;
}

/* Puts a table between its marks. False where the document has no such marks. */
static bool put_table(struct text *document, const char *mark, const struct text *table)
{
    const char *text = text_cstr(document), *start = strstr(text, mark);
    const char *body = start ? start + strlen(mark) : NULL,
               *end = body ? strstr(body, "<!-- end -->") : NULL;
    if (!end)
        return false;
    struct text result;
    text_init(&result, &arena);
    text_mem(&result, text, (size_t)(body - text));
    text_char(&result, '\n');
    text_mem(&result, table->data, table->len);
    text_str(&result, end);
    *document = result;
    return true;
}

static void put_tables(struct text *document)
{
    static const struct {
        const char *mark;
        void (*write)(struct text *out);
    } tables[] = {{"<!-- types -->", write_types},
                  {"<!-- ops -->", write_ops},
                  {"<!-- rules -->", write_rules}};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        struct text table;
        text_init(&table, &arena);
        tables[i].write(&table);
        REQUIRE(put_table(document, tables[i].mark, &table));
    }
}

/* An example prints as it stands, but for its comments. */
static void test_example(const char *example, size_t len)
{
    struct strpool strings;
    struct ir_graph graph;
    struct text plain, printed;
    ir_ref *roots;
    uint32_t num_roots;
    strpool_init(&strings, &arena, NULL);
    ir_graph_init(&graph, &arena, &strings);
    text_init(&plain, &arena);
    text_init(&printed, &arena);
    for (size_t i = 0; i < len; i++) {
        if (len - i > 2 && memcmp(example + i, " ; ", 3) == 0)
            while (example[i] != '\n')
                i++;
        text_char(&plain, example[i]);
    }
    REQUIRE_EQ(ir_text_read(&graph, arena_strndup(&arena, example, len), &roots, &num_roots), 0);
    ir_print(&graph, roots, num_roots, &printed);
    REQUIRE_STR(text_cstr(&printed), text_cstr(&plain));
}

/* Fenced blocks that end with a return line. */
static void test_examples(struct text *document)
{
    static const char fence[] = "```\n";
    unsigned num_examples = 0;
    for (const char *at = strstr(text_cstr(document), fence); at; at = strstr(at, fence)) {
        at += strlen(fence);
        const char *end = strstr(at, fence), *last = end ? end - 1 : NULL;
        if (!REQUIRE(end != NULL))
            return;
        while (last > at && last[-1] != '\n')
            last--;
        if (strncmp(last, "return ", 7) == 0) {
            test_example(at, (size_t)(end - at));
            num_examples++;
        }
        at = end + strlen(fence);
    }
    REQUIRE(num_examples > 0);
}

/* Beside this source file, which the build names relative to where it runs its tests. */
static const char *default_path(void)
{
    struct text path;
    const char *file = __FILE__, *slash = strrchr(file, '/');
    text_init(&path, &arena);
    text_mem(&path, file, slash ? (size_t)(slash - file) + 1 : 0);
    text_str(&path, "../../docs/ir.md");
    return text_cstr(&path);
}

int main(int argc, char **argv)
{
    struct text before, after;
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    text_init(&before, &arena);
    text_init(&after, &arena);
    const char *path = argc > 1 ? argv[1] : default_path();
    if (!REQUIRE(read_file(path, &before)))
        return test_report("ir_docs");
    test_examples(&before);
    text_mem(&after, before.data, before.len);
    put_tables(&after);
    if (argc > 2 && strcmp(argv[2], "--update") == 0) {
        FILE *file = fopen(path, "wb");
        if (REQUIRE(file != NULL)) {
            fwrite(after.data, 1, after.len, file);
            fclose(file);
        }
    } else if (!REQUIRE(strcmp(text_cstr(&before), text_cstr(&after)) == 0)) {
        printf(
            "    the tables of %s are out of date; run this test with --update behind the path\n",
            path);
    }
    arena_finish(&arena);
    return test_report("ir_docs");
}
