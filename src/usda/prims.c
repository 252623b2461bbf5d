// SPDX-License-Identifier: Apache-2.0
/* Prims, properties and metadata (the grammar of OpenUSD's text format). */
#include "usda/write_text.h"
#include "usda/usda.h"

#include <assert.h>

enum { MAX_NESTING = 256 }; /* brackets in a value */

struct parser {
    struct usda_layer *layer;
    struct usda_lexer lexer;
    struct usda_token token;
    struct diag_list *diags;
    usda_prim_id prim;     /* the one whose body is read */
    VEC(char) bodies;      /* open braces: 'p' of a prim, 'v' of a variant, 's' of a variant set */
    uint32_t num_variants; /* of the bodies, those of variants */
    uint32_t max_elements;
    VEC(usda_prim_id) owners; /* of the properties */
    bool failed;
};

static void next(struct parser *p)
{
    if (!p->failed)
        p->token = usda_next_token(&p->lexer);
}

static void fail(struct parser *p, const char *expected)
{
    struct text text;
    if (p->failed)
        return;
    p->failed = true;
    text_init(&text, p->diags->arena);
    size_t len = (size_t)(p->token.end - p->token.begin);
    if (p->token.kind == USDA_BAD)
        text_str(&text, p->lexer.fault);
    else if (p->token.kind == USDA_END)
        text_fmt(&text, "the file ends; expected %s", expected);
    else if (p->token.kind == USDA_NEWLINE)
        text_fmt(&text, "the line ends; expected %s", expected);
    else
        text_fmt(&text, "expected %s before '%.*s'", expected, (int)(len < 40 ? len : 40),
                 p->token.begin);
    struct diag_place place = {p->layer->file, p->token.line, usda_column(&p->token), 0};
    diag_add(p->diags, DIAG_ID_usda_syntax, place, text_cstr(&text));
    p->token.kind = USDA_END;
}

static bool is_mark(const struct parser *p, char mark)
{
    return p->token.kind == USDA_MARK && *p->token.begin == mark;
}

static struct text_word word_of(struct usda_token token)
{
    return (struct text_word){token.begin, (size_t)(token.end - token.begin)};
}

static bool is_word(const struct parser *p, const char *word)
{
    return p->token.kind == USDA_NAME && usda_is(word_of(p->token), word);
}

static void expect(struct parser *p, char mark, const char *what)
{
    if (is_mark(p, mark))
        next(p);
    else
        fail(p, what);
}

static void skip_newlines(struct parser *p)
{
    while (p->token.kind == USDA_NEWLINE)
        next(p);
}

/* ---- Values: any nesting of brackets ---- */

static bool begins_value(const struct parser *p)
{
    return p->token.kind == USDA_NAME || p->token.kind == USDA_NUMBER
           || p->token.kind == USDA_STRING || p->token.kind == USDA_ASSET
           || p->token.kind == USDA_PATH || is_mark(p, '[') || is_mark(p, '(') || is_mark(p, '{');
}

/* In brackets: opens and closes them, and checks that they match. */
static void read_inner(struct parser *p, char *closers, unsigned *depth)
{
    static const char opening[] = "[({", closing[] = "])}";
    const char *open = p->token.kind == USDA_MARK ? strchr(opening, *p->token.begin) : NULL;
    const char *close = p->token.kind == USDA_MARK ? strchr(closing, *p->token.begin) : NULL;
    if (open && *depth == MAX_NESTING)
        fail(p, "fewer nested brackets");
    else if (open)
        closers[(*depth)++] = closing[open - opening];
    else if (close && *close != closers[*depth - 1])
        fail(p, closers[*depth - 1] == ']' ? "']'" : closers[*depth - 1] == ')' ? "')'" : "'}'");
    else if (close)
        (*depth)--;
    else if (p->token.kind == USDA_END || p->token.kind == USDA_BAD
             || (p->token.kind == USDA_MARK && !strchr(",:=", *p->token.begin)))
        fail(p, "a value");
}

static struct text_word read_value(struct parser *p)
{
    char closers[MAX_NESTING];
    unsigned depth = 0;
    const char *begin = p->token.begin, *end = begin;
    if (!begins_value(p))
        fail(p, "a value");
    do {
        /* names alone are words such as None, or types in dictionaries */
        if (depth || p->token.kind == USDA_MARK)
            read_inner(p, closers, &depth);
        end = p->token.end;
        next(p);
    } while (depth && !p->failed);
    /* an asset path with a prim path behind it: one reference */
    if (p->token.kind == USDA_PATH && end[-1] == '@') {
        end = p->token.end;
        next(p);
    }
    return (struct text_word){begin, p->failed ? 0 : (size_t)(end - begin)};
}

/* ---- Metadata ---- */

static const char *const list_edits[] = {"prepend", "append", "add", "delete", "reorder"};

static bool skip_list_edit(struct parser *p)
{
    for (size_t i = 0; i < sizeof list_edits / sizeof *list_edits; i++)
        if (is_word(p, list_edits[i])) {
            next(p);
            return true;
        }
    return false;
}

static bool is_arc(struct text_word name)
{
    return usda_is(name, "payload") || usda_is(name, "inherits") || usda_is(name, "specializes")
           || usda_is(name, "subLayers") || usda_is(name, "variantSets");
}

/* The metadata of a prim, a property or the layer that binding needs. */
struct metadata {
    struct text_word references, arc, bind_as, interpolation, color_space, default_prim, up_axis,
        unit, inactive_ids;
    bool is_inactive, is_instance;
};

/* The metadata whose value is a word in quotes. */
static bool keep_word(struct metadata *out, struct text_word name, struct text_word value)
{
    const struct {
        const char *name;
        struct text_word *word;
    } words[] = {{"bindMaterialAs", &out->bind_as},
                 {"interpolation", &out->interpolation},
                 {"colorSpace", &out->color_space},
                 {"defaultPrim", &out->default_prim},
                 {"upAxis", &out->up_axis}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (usda_is(name, words[i].name) && (*value.bytes == '"' || *value.bytes == '\'')) {
            *words[i].word = usda_unquoted(value);
            return true;
        }
    return false;
}

static void keep_metadata(struct metadata *out, struct text_word name, struct text_word value)
{
    if (usda_is(name, "references"))
        out->references = value;
    else if (usda_is(name, "metersPerUnit"))
        out->unit = value;
    else if (usda_is(name, "inactiveIds"))
        out->inactive_ids = value;
    else if (usda_is(name, "active"))
        out->is_inactive = usda_is(value, "false") || usda_is(value, "0");
    else if (usda_is(name, "instanceable"))
        out->is_instance = usda_is(value, "true") || usda_is(value, "1");
    else if (keep_word(out, name, value))
        return;
    else if (is_arc(name) && !usda_is(value, "None") && !usda_is(value, "[]"))
        out->arc = name;
}

/* "( key = value ... )", from the bracket on. */
static struct metadata read_metadata(struct parser *p)
{
    struct metadata out = {0};
    expect(p, '(', "'('");
    skip_newlines(p);
    while (!is_mark(p, ')') && !p->failed) {
        if (p->token.kind == USDA_STRING) { /* documentation */
            next(p);
            skip_newlines(p);
            continue;
        }
        skip_list_edit(p);
        struct text_word name = word_of(p->token);
        if (p->token.kind != USDA_NAME)
            fail(p, "the name of metadata or ')'");
        next(p);
        expect(p, '=', "'='");
        struct text_word value = read_value(p);
        if (is_mark(p, '(')) /* the offset of a reference */
            read_value(p);
        if (!p->failed)
            keep_metadata(&out, name, value);
        if (!is_mark(p, ')') && p->token.kind != USDA_NEWLINE)
            fail(p, "the end of the line or ')'");
        skip_newlines(p);
    }
    expect(p, ')', "')'");
    return out;
}

/* Metadata that may follow, on the next line, too. */
static struct metadata read_optional_metadata(struct parser *p)
{
    return is_mark(p, '(') ? read_metadata(p) : (struct metadata){0};
}

/* ---- Properties ---- */

/* A type with "[]". */
static struct text_word read_type(struct parser *p)
{
    const char *begin = p->token.begin, *end = p->token.end;
    if (p->token.kind != USDA_NAME)
        fail(p, "a property, a prim or '}'");
    next(p);
    if (is_mark(p, '[')) {
        next(p);
        end = p->token.end;
        expect(p, ']', "']'");
    }
    return (struct text_word){begin, p->failed ? 0 : (size_t)(end - begin)};
}

static void count_element(struct parser *p)
{
    if (p->layer->prims.len + p->layer->properties.len <= p->max_elements || p->failed)
        return;
    p->failed = true;
    p->token.kind = USDA_END;
    diag_add(p->diags, DIAG_ID_too_many_elements,
             (struct diag_place){p->layer->file, p->token.line, usda_column(&p->token), 0},
             (unsigned)p->max_elements);
}

static void add_property(struct parser *p, struct usda_property property)
{
    count_element(p);
    vec_push(p->layer->arena, &p->layer->properties, property);
    vec_push(p->layer->arena, &p->owners, p->prim);
    usda_index_property(p->layer, p->prim, p->layer->properties.len - 1);
}

static void read_property(struct parser *p)
{
    struct usda_property property = {.line = p->token.line};
    bool is_deletion = is_word(p, "delete") || is_word(p, "reorder");
    skip_list_edit(p);
    while (is_word(p, "custom") || is_word(p, "uniform") || is_word(p, "varying")
           || is_word(p, "config"))
        next(p);
    if (is_deletion
        && (is_word(p, "nameChildren") || is_word(p, "properties") || is_word(p, "rootPrims"))) {
        next(p);
        expect(p, '=', "'='");
        read_value(p);
        return;
    }
    property.type = read_type(p);
    property.line = p->token.line;
    property.column = usda_column(&p->token);
    property.name = word_of(p->token);
    if (p->token.kind != USDA_NAME)
        fail(p, "the name of a property");
    next(p);
    if (is_mark(p, '=')) {
        next(p);
        property.value = read_value(p);
    }
    struct metadata metadata = read_optional_metadata(p);
    property.bind_as = metadata.bind_as;
    property.interpolation = metadata.interpolation;
    property.color_space = metadata.color_space;
    if (p->failed || is_deletion || p->num_variants)
        return;
    add_property(p, property);
}

/* ---- Prims ---- */

static void open_body(struct parser *p, char kind)
{
    skip_newlines(p);
    if (p->bodies.len == USDA_MAX_DEPTH)
        fail(p, "at most 1,000 nested prims");
    expect(p, '{', "'{'");
    vec_push(p->layer->arena, &p->bodies, kind);
    p->num_variants += kind == 'v';
}

/* Reports a prim whose name another one has; 0: none. Variants may repeat a name. */
static void check_twice(struct parser *p, usda_prim_id id, usda_prim_id before)
{
    const struct usda_layer *layer = p->layer;
    const struct usda_prim *prim = &layer->prims.items[id], *first = &layer->prims.items[before];
    if (!before || prim->is_variant || first->is_variant)
        return;
    const char *name = arena_strndup(p->diags->arena, prim->name.bytes, prim->name.len);
    diag_add(p->diags, DIAG_ID_usda_twice,
             (struct diag_place){layer->file, prim->line, prim->column, 0}, name);
    diag_add(p->diags, DIAG_ID_previous_definition,
             (struct diag_place){layer->file, first->line, first->column, 0});
}

static void add_prim(struct parser *p, struct usda_prim added)
{
    struct usda_layer *layer = p->layer;
    usda_prim_id id = layer->prims.len;
    added.parent = p->prim;
    vec_push(layer->arena, &layer->prims, added);
    struct usda_prim *above = &layer->prims.items[p->prim];
    if (above->last_child)
        layer->prims.items[above->last_child].next = id;
    else
        above->first_child = id;
    above->last_child = id;
    check_twice(p, id, usda_index_prim(layer, id));
    p->prim = id;
    count_element(p);
}

static bool read_specifier(struct parser *p, uint8_t *out)
{
    static const char *const words[] = {"def", "over", "class"};
    for (uint8_t i = 0; i < 3; i++)
        if (is_word(p, words[i])) {
            *out = i;
            next(p);
            return true;
        }
    return false;
}

/* The instances of a PointInstancer that are switched off, which are metadata, as a property. */
static void add_inactive_ids(struct parser *p, struct text_word ids)
{
    static const char name[] = "inactiveIds", type[] = "int64[]";
    if (ids.len)
        add_property(p, (struct usda_property){.name = {name, sizeof name - 1},
                                               .type = {type, sizeof type - 1},
                                               .value = ids,
                                               .line = p->layer->prims.items[p->prim].line,
                                               .column = p->layer->prims.items[p->prim].column});
}

static void read_prim(struct parser *p, uint8_t specifier)
{
    struct usda_prim prim = {.specifier = specifier, .line = p->token.line};
    prim.is_variant = p->num_variants != 0;
    if (p->token.kind == USDA_NAME) {
        prim.type = word_of(p->token);
        next(p);
    }
    if (p->token.kind != USDA_STRING || !usda_is_identifier(usda_unquoted(word_of(p->token))))
        fail(p, "the name of a prim in quotes");
    if (p->failed)
        return;
    prim.name = usda_unquoted(word_of(p->token));
    prim.line = p->token.line;
    prim.column = usda_column(&p->token);
    next(p);
    skip_newlines(p);
    struct metadata metadata = read_optional_metadata(p);
    prim.references = metadata.references;
    prim.arc = metadata.arc;
    prim.is_inactive = metadata.is_inactive;
    prim.is_instance = metadata.is_instance;
    add_prim(p, prim);
    if (!p->num_variants)
        add_inactive_ids(p, metadata.inactive_ids);
    open_body(p, 'p');
}

/* variantSet "name" = { "variant" ( ... ) { ... } } */
static void read_variant_set(struct parser *p)
{
    next(p);
    if (p->token.kind != USDA_STRING)
        fail(p, "the name of a variant set in quotes");
    next(p);
    expect(p, '=', "'='");
    open_body(p, 's');
}

static void read_variant(struct parser *p)
{
    next(p);
    skip_newlines(p);
    read_optional_metadata(p);
    open_body(p, 'v');
}

static void close_body(struct parser *p)
{
    if (!p->bodies.len) {
        fail(p, "a prim");
        return;
    }
    next(p);
    char kind = vec_pop(&p->bodies);
    p->num_variants -= kind == 'v';
    if (kind == 'p')
        p->prim = p->layer->prims.items[p->prim].parent;
}

static void read_statement(struct parser *p)
{
    uint8_t specifier;
    bool in_set = p->bodies.len && vec_last(&p->bodies) == 's';
    if (is_mark(p, '}'))
        close_body(p);
    else if (in_set && p->token.kind == USDA_STRING)
        read_variant(p);
    else if (in_set)
        fail(p, "the name of a variant in quotes or '}'");
    else if (read_specifier(p, &specifier))
        read_prim(p, specifier);
    else if (is_word(p, "variantSet"))
        read_variant_set(p);
    else if (p->bodies.len || is_word(p, "reorder")) /* of the prims at the root */
        read_property(p);
    else
        fail(p, "a prim: def, over or class");
}

/* ---- The layer ---- */

static void read_header(struct parser *p, const char *text, size_t len)
{
    static const char cookie[] = "#usda ", version[] = "1.0";
    bool is_text = len >= strlen(cookie) && memcmp(text, cookie, strlen(cookie)) == 0;
    const char *number = text + strlen(cookie);
    size_t num_left = is_text ? len - strlen(cookie) : 0, num = 0;
    while (num < num_left && !strchr(" \t\r\n", number[num]))
        num++;
    if (!is_text || num != strlen(version) || memcmp(number, version, num) != 0) {
        p->token = (struct usda_token){
            .kind = USDA_BAD, .line = 1, .line_begin = text, .begin = is_text ? number : text};
        p->lexer.fault =
            is_text ? "the version of the file is not 1.0, the only one that mxgen knows"
                    : "the file does not begin with '#usda 1.0'; a binary file (.usdc, .usdz) "
                      "becomes text with 'usdcat --flatten'";
        fail(p, "");
        return;
    }
    next(p);
    skip_newlines(p);
    p->layer->default_prim = (struct text_word){0};
    if (is_mark(p, '(')) {
        struct metadata metadata = read_metadata(p);
        p->layer->default_prim = metadata.default_prim;
        p->layer->up_axis = metadata.up_axis;
        p->layer->meters_per_unit = metadata.unit;
        p->layer->prims.items[0].arc = metadata.arc;
    }
}

bool usda_read(struct usda_layer *layer, const char *file, const char *text, size_t len,
               uint32_t max_elements, struct arena *arena, struct diag_list *diags)
{
    *layer = (struct usda_layer){.arena = arena, .file = file};
    struct parser p = {.layer = layer, .max_elements = max_elements, .diags = diags};
    vec_push(arena, &p.owners, 0);
    vec_push(arena, &layer->prims, (struct usda_prim){.line = 1, .column = 1});
    vec_push(arena, &layer->properties, (struct usda_property){0});
    size_t mark = len >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0; /* of bytes in order */
    text += mark;
    len -= mark;
    usda_lexer_init(&p.lexer, text, len);
    read_header(&p, text, len);
    for (skip_newlines(&p); !p.failed && p.token.kind != USDA_END; skip_newlines(&p))
        read_statement(&p);
    if (p.bodies.len)
        fail(&p, "'}'");
    usda_index_rows(layer, p.owners.items, arena);
    return !p.failed;
}
