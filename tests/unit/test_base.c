// SPDX-License-Identifier: Apache-2.0
/*
 * The ground floor: arenas and their failures, string pools in layers, numbers as text, growing
 * text.
 */
#include "base/hash.h"
#include "base/json.h"
#include "base/mem.h"
#include "base/folder_names.h"
#include "base/num.h"
#include "base/strpool.h"
#include "base/text.h"
#include "base/trap.h"

#include "test.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>

/* Memory */

/*
 * The C library's allocator, which fails once `left` allocations are done, and checks the sizes
 * that it is told.
 */
struct counting {
    size_t left, held;
};

static void *counting_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    struct counting *c = user_data;
    if (new_size > 0 && c->left == 0)
        return NULL;
    c->left -= new_size > 0;
    c->held = c->held - old_size + new_size;
    if (new_size > 0)
        return realloc(block, new_size);
    free(block);
    return NULL;
}

static void test_arena(void)
{
    struct mem mem;
    struct arena arena;
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    char *last = NULL;
    REQUIRE(arena_alloc(&arena, 0) != NULL);
    for (size_t size = 1; size < 20000; size += 97) { /* from small to large blocks */
        char *block = arena_alloc(&arena, size);
        REQUIRE((uintptr_t)block % 16 == 0);
        REQUIRE(block != last);
        memset(block, 0xab, size);
        last = block;
    }
    const char *zeros = arena_zalloc(&arena, 1000);
    for (size_t i = 0; i < 1000; i++)
        if (zeros[i])
            REQUIRE(false);
    REQUIRE_STR(arena_strndup(&arena, "texcoord", 3), "tex");
    REQUIRE_STR(arena_strndup(&arena, NULL, 0), "");
    REQUIRE(mem.used > 0);
    arena_finish(&arena);
    REQUIRE_EQ(mem.used, 0);
}

/* Three vectors that grow in turn: in place, by copying, and as large blocks that move. */
static void test_vectors(void)
{
    struct mem mem;
    struct arena arena;
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    VEC(uint32_t) v[3] = {{0}, {0}, {0}};
    for (uint32_t i = 0; i < 20000; i++)
        vec_push(&arena, &v[i % 3], i);
    bool kept = true;
    for (uint32_t i = 0; i < 20000; i++)
        kept = kept && v[i % 3].items[i / 3] == i;
    REQUIRE(kept);
    uint32_t len = v[0].len;
    uint32_t *more = vec_extend(&arena, &v[0], 100000);
    REQUIRE_EQ(more - v[0].items, len);
    REQUIRE_EQ(v[0].len, len + 100000);
    REQUIRE(v[0].cap >= v[0].len);
    vec_last(&v[1]) = 7;
    REQUIRE_EQ(vec_pop(&v[1]), 7);
    arena_finish(&arena);
    REQUIRE_EQ(mem.used, 0);
}

/* Work that allocates in every way. */
static void busy(struct arena *arena)
{
    struct strpool pool;
    struct text text;
    VEC(uint64_t) v = {0};
    strpool_init(&pool, arena, NULL);
    text_init(&text, arena);
    for (uint32_t i = 0; i < 2000; i++) {
        vec_push(arena, &v, i);
        text.len = 0;
        text_fmt(&text, "name_%u", (unsigned)i);
        str_intern(&pool, text.data, text.len);
    }
    arena_alloc(arena, 100000);
}

/* Whether the work was done; a failure must lead here and leave nothing behind. */
static bool try_busy(struct mem *mem)
{
    struct arena arena;
    struct trap trap;
    arena_init(&arena, mem);
    mem->trap = &trap;
    if (setjmp(trap.place)) {
        arena_finish(&arena);
        return false;
    }
    busy(&arena);
    arena_finish(&arena);
    return true;
}

static void test_failures(void)
{
    size_t k = 0;
    for (bool done = false; !done && k < 1000; k++) {
        struct counting counting = {.left = k};
        struct mem mem;
        mem_init(&mem, counting_realloc, &counting);
        done = try_busy(&mem);
        REQUIRE_EQ(mem.used, 0);
        REQUIRE_EQ(counting.held, 0);
        REQUIRE(!mem.over_limit);
    }
    REQUIRE(k > 5 && k < 1000);
    struct mem mem;
    mem_init(&mem, NULL, NULL);
    mem.limit = 50000;
    REQUIRE(!try_busy(&mem));
    REQUIRE(mem.over_limit);
    REQUIRE_EQ(mem.used, 0);
    mem.limit = 100 << 20;
    REQUIRE(try_busy(&mem));
}

static volatile bool size_failed;

static void test_overflow(void)
{
    struct mem mem;
    struct trap trap;
    mem_init(&mem, NULL, NULL);
    mem.trap = &trap;
    size_failed = false;
    if (setjmp(trap.place))
        size_failed = true;
    else
        mem_array_size(&mem, SIZE_MAX / 4, 8);
    REQUIRE(size_failed);
    REQUIRE_EQ(mem_array_size(&mem, 3, 8), 24);
    REQUIRE_EQ(mem_array_size(&mem, SIZE_MAX, 0), 0);
}

/* Strings */

static void test_strings(struct arena *arena)
{
    struct strpool base, upper, top;
    strpool_init(&base, arena, NULL);
    REQUIRE_STR(str_text(&base, STR_EMPTY), "");
    REQUIRE_STR(str_text(&base, STR_nodedef), "nodedef");
    REQUIRE_EQ(str_intern_z(&base, "nodegraph"), STR_nodegraph);
    REQUIRE_EQ(str_intern_z(&base, ""), 0);
    str_id oak = str_intern_z(&base, "oak");
    REQUIRE(oak >= STR_NUM_WORDS);
    REQUIRE_EQ(str_intern(&base, "oakwood", 3), oak);

    strpool_init(&upper, arena, &base);
    REQUIRE_EQ(str_intern_z(&upper, "oak"), oak);
    REQUIRE_EQ(str_intern_z(&upper, "value"), STR_value);
    str_id pine = str_intern_z(&upper, "pine");
    REQUIRE(pine > oak);
    REQUIRE_EQ(str_find(&base, "pine", 4), 0);
    REQUIRE_EQ(str_find(&upper, "pine", 4), pine);
    REQUIRE_EQ(str_find(&upper, "birch", 5), 0);
    REQUIRE_STR(str_text(&upper, oak), "oak");
    REQUIRE_STR(str_text(&upper, pine), "pine");
    REQUIRE_EQ(str_len(&upper, pine), 4);

    strpool_init(&top, arena, &upper);
    char name[16];
    str_id ids[5000];
    for (unsigned i = 0; i < 5000; i++) {
        snprintf(name, sizeof name, "n%u", i * 7919);
        ids[i] = str_intern_z(&top, name);
    }
    bool found = true;
    for (unsigned i = 0; i < 5000; i++) {
        snprintf(name, sizeof name, "n%u", i * 7919);
        found = found && str_intern_z(&top, name) == ids[i]
                && strcmp(str_text(&top, ids[i]), name) == 0;
    }
    REQUIRE(found);
    REQUIRE_EQ(top.num, 5000);
    REQUIRE_STR(str_text(&top, pine), "pine");
}

/* Numbers of one hash are all found; a table that has grown gives its memory back. */
static void test_table(void)
{
    enum { NUM = 20000 };
    struct mem mem;
    struct arena arena;
    struct table table = {0};
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    for (uint32_t number = 1; number <= NUM; number++)
        table_add(&table, &arena, hash_pair(number / 4, 0), number);
    REQUIRE_EQ(table.num, NUM);
    for (uint32_t number = 1; number <= NUM + 8; number++) {
        uint32_t hash = hash_pair(number / 4, 0), at = hash, found, num_same = 0;
        bool is_there = false;
        for (; (found = table_next(&table, hash, &at)); num_same += found / 4 == number / 4)
            is_there |= found == number;
        REQUIRE(is_there == (number <= NUM) && num_same <= 4);
    }
    uint32_t hash = hash_pair(0, 0), at = hash;
    REQUIRE_EQ(table_next(&table, hash, &at), 1);
    table_replace(&table, at, NUM + 1);
    at = hash;
    REQUIRE_EQ(table_next(&table, hash, &at), NUM + 1);
    REQUIRE(mem.used < 3 * (table.mask + 1) * sizeof *table.slots / 2);
    arena_finish(&arena);
    REQUIRE_EQ(mem.used, 0);
}

/*
 * A layer as a library image has it: offsets into one block of bytes, and ids of 16 bits where they
 * fit.
 */
static void test_image_layer(struct arena *arena, bool is_narrow)
{
    struct strpool growing, document;
    static const char bytes[] = "\0oak\0pine";
    static const uint32_t offsets[] = {0, 1, 5, 10};
    struct strpool image = {.num = 3, .offsets = offsets, .bytes = bytes};
    for (uint32_t id = 1; id < 3; id++)
        table_add(&image.table, arena,
                  hash_bytes(bytes + offsets[id], offsets[id + 1] - offsets[id] - 1), id);
    uint16_t narrow[16];
    REQUIRE_EQ(image.table.mask, 15);
    for (uint32_t slot = 0; slot < 16; slot++)
        narrow[slot] = (uint16_t)image.table.slots[slot].number;
    if (is_narrow)
        image.table = (struct table){.narrow = narrow, .mask = 15};
    REQUIRE_EQ(str_find(&image, "oak", 3), 1);
    REQUIRE_EQ(str_find(&image, "pine", 4), 2);
    REQUIRE_EQ(str_find(&image, "pin", 3), 0);
    REQUIRE_STR(str_text(&image, 2), "pine");
    REQUIRE_EQ(str_len(&image, 1), 3);
    strpool_init(&document, arena, &image);
    REQUIRE_EQ(str_intern_z(&document, "pine"), 2);
    REQUIRE_EQ(str_intern_z(&document, "birch"), 3);
    strpool_init(&growing, arena, &document);
    REQUIRE_EQ(str_intern_z(&growing, "elm"), 4);
    REQUIRE_STR(str_text(&growing, 1), "oak");
}

/* Numbers */

static const char *float_text(float value)
{
    static char out[NUM_FLOAT_MAX + 1];
    out[num_print_float(out, value)] = '\0';
    return out;
}

static float parse_float(const char *text)
{
    float value = NAN;
    return num_parse_float(text, strlen(text), &value) == strlen(text) ? value : NAN;
}

static void test_float_forms(void)
{
    static const struct {
        float value;
        const char *text;
    } cases[] = {
        {0.0f, "0.0"},
        {-0.0f, "-0.0"},
        {1.0f, "1.0"},
        {-1.5f, "-1.5"},
        {0.1f, "0.1"},
        {0.00001f, "0.00001"},
        {0.000001f, "1e-6"},
        {123456792.0f, "123456790.0"},
        {1e9f, "1e9"},
        {1.5e10f, "1.5e10"},
        {16777216.0f, "16777216.0"},
        {3.40282347e38f, "3.4028235e38"},
        {1.17549435e-38f, "1.1754944e-38"},
        {1e-45f, "1e-45"},
        {3.14159274f, "3.1415927"},
        {0.333333343f, "0.33333334"},
        {INFINITY, "inf"},
        {-INFINITY, "-inf"},
        {NAN, "nan"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        REQUIRE_STR(float_text(cases[i].value), cases[i].text);
    static const struct {
        const char *text;
        float value;
        size_t len;
    } reads[] = {
        {"1", 1.0f, 1},
        {"+2.5", 2.5f, 4},
        {"-.5", -0.5f, 3},
        {"3.", 3.0f, 2},
        {"1e3", 1000.0f, 3},
        {"1E-2", 0.01f, 4},
        {"1e+2x", 100.0f, 4},
        {"2e", 2.0f, 1},
        {"2e+", 2.0f, 1},
        {"1,5", 1.0f, 1},
        {"", 0, 0},
        {".", 0, 0},
        {"-", 0, 0},
        {"e5", 0, 0},
        {"1e400", INFINITY, 5},
        {"-1e400", -INFINITY, 6},
        {"1e-400", 0.0f, 6},
        {"0e999999999999", 0.0f, 14},
        {"0.000000000000000000000000000000000000000000000000001e51", 1.0f, 56},
        {"123456789012345678901234567890", 123456789012345678901234567890.0f, 30},
        {"16777217.0000000000000000000000000001", 16777216.0f, 37},
    };
    for (size_t i = 0; i < sizeof reads / sizeof *reads; i++) {
        float value = 0;
        REQUIRE_EQ(num_parse_float(reads[i].text, strlen(reads[i].text), &value), reads[i].len);
        if (!REQUIRE(value == reads[i].value))
            printf("    %s gives %.9g\n", reads[i].text, (double)value);
    }
}

/* Digits of a number's text, without zeros at the ends. */
static int num_digits(const char *text)
{
    int digits = 0, pending = 0;
    for (; *text && *text != 'e'; text++) {
        if (*text >= '1' && *text <= '9') {
            digits += pending + 1;
            pending = 0;
        } else if (*text == '0' && digits) {
            pending++;
        }
    }
    return digits;
}

/*
 * A printed number reads back to the same bits, and is as short as the shortest of the C library's
 * forms that does.
 */
static bool round_trips(float value)
{
    char shortest[32];
    for (int digits = 1; digits <= 9; digits++) {
        snprintf(shortest, sizeof shortest, "%.*e", digits - 1, (double)value);
        if (strtof(shortest, NULL) == value)
            break;
    }
    const char *text = float_text(value);
    return parse_float(text) == value && strtof(text, NULL) == value
           && num_digits(text) <= num_digits(shortest) && strpbrk(text, ".e");
}

static void test_round_trips(void)
{
    uint64_t state = 1;
    bool good = true;
    for (unsigned i = 0; i < 200000; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        /* the smallest denormals, then anything */
        uint32_t bits = i < 1000 ? i : (uint32_t)(state >> 32);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value) && !round_trips(value)) {
            good = false;
            printf("    %.9g is printed as %s\n", (double)value, float_text(value));
        }
    }
    REQUIRE(good);
}

/* A locale with a decimal comma, where there is one here, changes nothing. */
static void test_locale(struct arena *arena)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "cs_CZ.UTF-8",
                                        "German"};
    bool comma = false;
    for (size_t i = 0; i < sizeof names / sizeof *names && !comma; i++)
        comma = setlocale(LC_ALL, names[i]) && strcmp(localeconv()->decimal_point, ",") == 0;
    if (!comma)
        printf("    no locale with a decimal comma here\n");
    struct text text;
    text_init(&text, arena);
    text_float(&text, 0.5f);
    REQUIRE_STR(text_cstr(&text), "0.5");
    REQUIRE(parse_float("0.5") == 0.5f);
    setlocale(LC_ALL, "C");
}

static void test_integers(void)
{
    static const struct {
        const char *text;
        int64_t value;
        size_t len;
    } cases[] = {
        {"0", 0, 1},
        {"-12", -12, 3},
        {"+7", 7, 2},
        {"0x1F", 31, 4},
        {"-0xff", -255, 5},
        {"12abc", 12, 2},
        {"0x", 0, 1},
        {"4294967295", 4294967295, 10},
        {"99999999999999999999", 0, 0},
        {"", 0, 0},
        {"-", 0, 0},
        {"x", 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int64_t value = 0;
        size_t n = num_parse_int(cases[i].text, strlen(cases[i].text), &value);
        if (!REQUIRE_EQ(n, cases[i].len) || (n && !REQUIRE_EQ(value, cases[i].value)))
            printf("    %s\n", cases[i].text);
    }
}

/* Text */

static void test_text(struct arena *arena)
{
    struct text text;
    text_init(&text, arena);
    REQUIRE_STR(text_cstr(&text), "");
    text_str(&text, "a");
    text_char(&text, 'b');
    text_mem(&text, "cde", 2);
    text_mem(&text, NULL, 0);
    text_u32(&text, 0);
    text_u32(&text, UINT32_MAX);
    text_char(&text, ' ');
    text_i32(&text, INT32_MIN);
    text_fmt(&text, " %s=%d", "x", -5);
    text_char(&text, ' ');
    text_hex64(&text, 0x0123456789abcdefu);
    REQUIRE_STR(text_cstr(&text), "abcd04294967295 -2147483648 x=-5 0123456789abcdef");
    text.len = 0;
    for (unsigned i = 0; i < 100000; i++)
        text_char(&text, (char)('a' + i % 26));
    REQUIRE_EQ(text.len, 100000);
    REQUIRE_EQ(text.data[99999], 'a' + 99999 % 26);
}

/* RFC 8259: quotes, backslashes and controls are escaped; what is not UTF-8 becomes U+FFFD. */
static void test_json_strings(struct arena *arena)
{
#define BAD "\xef\xbf\xbd"
    static const char *const cases[][2] = {
        {"plain", "\"plain\""},
        {"a\"b\\c\n\x01", "\"a\\\"b\\\\c\\u000a\\u0001\""},
        {"\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80", "\"\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80\""},
        {"\x80x", "\"" BAD "x\""},               /* a continuation byte alone */
        {"\xc3", "\"" BAD "\""},                 /* cut short */
        {"\xc0\xaf", "\"" BAD BAD "\""},         /* longer than need be */
        {"\xed\xa0\x80", "\"" BAD BAD BAD "\""}, /* a surrogate */
        {"\xf5\x80\x80\x80", "\"" BAD BAD BAD BAD "\""},
        /* what terminals act on and people do not see: DEL, C1, RIGHT-TO-LEFT OVERRIDE, a tag */
        {"\x7f\xc2\x9b\xe2\x80\xae\xf3\xa0\x81\x81", "\"\\u007f\\u009b\\u202e\\udb40\\udc41\""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct text text;
        text_init(&text, arena);
        text_json_string(&text, cases[i][0], strlen(cases[i][0]));
        REQUIRE_STR(text_cstr(&text), cases[i][1]);
    }
}

/*
 * Texts for people: each hidden character is one '?', and so is a byte that is no UTF-8; joiners,
 * marks and tabs stay (hidden_chars.h).
 */
static void test_shown_texts(struct arena *arena)
{
    static const char *const cases[][2] = {
        {"", ""},
        {"a\tb \xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80", "a\tb \xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80"},
        {"a\n\r\x1b[31m\x7f", "a???[31m?"},
        {"\xc2\x80\xc2\x9b\xc2\x9f\xc2\xa0", "???\xc2\xa0"},
        {"\xc2\xad\xd8\x9c\xe1\xa0\x8e\xef\xbb\xbf", "????"},
        {"\xe2\x80\x8b\xe2\x80\x8e\xe2\x80\x8f\xe2\x80\xa8\xe2\x80\xae\xe2\x80\xaf",
         "?????\xe2\x80\xaf"},
        {"\xe2\x81\x9f\xe2\x81\xa0\xe2\x81\xa9\xe2\x81\xaf", "\xe2\x81\x9f???"},
        {"\xf3\xa0\x80\x81\xf3\xa0\x81\xbf\xf3\xa0\x84\x80", "??\xf3\xa0\x84\x80"},
        {"x\xcc\x82\xe2\x80\x8c\xe2\x80\x8d\xef\xb8\x8f",
         "x\xcc\x82\xe2\x80\x8c\xe2\x80\x8d\xef\xb8\x8f"},
        {"\x80\x9b\xe2\x80", "????"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct text text;
        text_init(&text, arena);
        text_str(&text, "\n");
        text_str(&text, cases[i][0]);
        text_show(&text, 1);
        REQUIRE_STR(text_cstr(&text) + 1, cases[i][1]);
        REQUIRE_EQ(text.data[0], '\n');
    }
    REQUIRE_EQ(text_width("a\xe2\x80\x8b\xe2\x80\x8d\xc2\x9b\x80", 10), 4);
}

/* An item on each line, but for what is flat; what says nothing is left out where that is asked
 * for. */
static void test_json(struct arena *arena)
{
    struct text text;
    text_init(&text, arena);
    struct json json = {.out = &text};
    json_open(&json, '{');
    json_put_text(&json, "text", "a\"b");
    json_put_text(&json, "empty", "");
    json_put_text(&json, "none", NULL);
    json_put_nonzero(&json, "zero", 0);
    json_key(&json, "flat");
    json_open_flat(&json, '[');
    json_item(&json);
    json_open(&json, '{');
    json_put_number(&json, "n", 0);
    json_put_bool(&json, "is", true);
    json_close(&json, '}');
    json_item(&json);
    json_open_flat(&json, '[');
    json_close(&json, ']');
    json_close(&json, ']');
    json_key(&json, "items");
    json_open(&json, '[');
    json_item(&json);
    json_open(&json, '{');
    json_close(&json, '}');
    json_close(&json, ']');
    json_close(&json, '}');
    REQUIRE_STR(text_cstr(&text), "{\n"
                                  "  \"text\": \"a\\\"b\",\n"
                                  "  \"flat\": [{\"n\": 0, \"is\": true}, []],\n"
                                  "  \"items\": [\n"
                                  "    {}\n"
                                  "  ]\n"
                                  "}");
}

/* The reference values of FNV-1a (64 bits). */
static void test_hashes(void)
{
    REQUIRE(hash_stable(HASH_STABLE_SEED, "", 0) == 0xcbf29ce484222325u);
    REQUIRE(hash_stable(HASH_STABLE_SEED, "a", 1) == 0xaf63dc4c8601ec8cu);
    REQUIRE(hash_stable(HASH_STABLE_SEED, "foobar", 6) == 0x85944171f73967e8u);
    REQUIRE(hash_stable(hash_stable(HASH_STABLE_SEED, "foo", 3), "bar", 3) == 0x85944171f73967e8u);
    REQUIRE(hash_bytes("a\0", 2) != hash_bytes("a", 1));
    REQUIRE(hash_pair(1, 2) != hash_pair(2, 1));
}

/* A host's list of names, which needs ever more room, or keeps silent about its end. */
struct names_host {
    unsigned calls;
    bool is_greedy;
};

static size_t host_names(void *user_data, const char *from, const char *folder, char *names,
                         size_t capacity)
{
    struct names_host *host = user_data;
    (void)from, (void)folder;
    host->calls++;
    if (!host->is_greedy && capacity >= 6)
        memcpy(names, "a\0long", 6); /* the last name lacks its NUL */
    return host->is_greedy ? capacity + 1 : 6;
}

static void test_names(void)
{
    struct mem mem;
    struct arena arena;
    struct names_host host = {.is_greedy = true};
    const char *names = NULL;
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    REQUIRE_EQ(names_list(&arena, host_names, &host, "", "", &names), 0);
    REQUIRE(host.calls < 10 && names && !*names);
    host.is_greedy = false;
    REQUIRE_EQ(names_list(&arena, host_names, &host, "", "", &names), 6);
    REQUIRE_STR(names + 2, "long");
    arena_finish(&arena);
}

int main(void)
{
    struct mem mem;
    struct arena arena;
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    test_arena();
    test_vectors();
    test_names();
    test_failures();
    test_overflow();
    test_strings(&arena);
    test_table();
    test_image_layer(&arena, false);
    test_image_layer(&arena, true);
    test_float_forms();
    test_round_trips();
    test_locale(&arena);
    test_integers();
    test_text(&arena);
    test_json_strings(&arena);
    test_shown_texts(&arena);
    test_json(&arena);
    test_hashes();
    arena_finish(&arena);
    return test_report("base");
}
