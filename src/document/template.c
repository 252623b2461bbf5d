// SPDX-License-Identifier: Apache-2.0
/*
 * Expands <template vars="a b" rows="x y; z w">: copies its children once per row and replaces @a@
 * and @b@ (docs/library.md).
 *
 * An outer template expands first and copies the templates inside it, so these can use its
 * variables.
 */
#include "document/document.h"

#include <assert.h>

enum { MAX_VARIABLES = 16 };

struct slice {
    const char *text;
    size_t len;
};

/* Nested templates multiply: a few lines could make any number of elements. */
enum { MAX_MADE = 1 << 17 };

struct expansion {
    struct document *doc;
    uint32_t most_elements; /* of the document */
    struct diag_list *diags;
    elem_id template;
    size_t num_vars;
    struct slice vars[MAX_VARIABLES], row[MAX_VARIABLES];
    struct text *scratch;
    bool failed;
};

static bool is_full(const struct expansion *x)
{
    return doc_is_full(x->doc) || doc_num_elements(x->doc) >= x->most_elements;
}

static bool slice_is(struct slice a, const char *text, size_t len)
{
    return a.len == len && memcmp(a.text, text, len) == 0;
}

static void fail(struct expansion *x, str_id attr, const char *format, struct slice what)
{
    struct text message;
    text_init(&message, x->doc->arena);
    text_fmt(&message, format, (int)what.len, what.text);
    diag_add(x->diags, DIAG_ID_template_bad, doc_attr_place(x->doc, x->template, attr),
             text_cstr(&message));
    x->failed = true;
}

/* The next word of a list with spaces; len 0 at the end. */
static struct slice next_word(struct slice *rest)
{
    static const char spaces[] = " \t\r\n";
    while (rest->len && strchr(spaces, *rest->text))
        rest->text++, rest->len--;
    struct slice word = {rest->text, 0};
    while (rest->len && !strchr(spaces, *rest->text))
        rest->text++, rest->len--, word.len++;
    return word;
}

static struct slice attr_slice(const struct document *doc, elem_id element, str_id attr)
{
    str_id value = doc_attr_value(doc, element, attr);
    return (struct slice){str_text(doc->strings, value), str_len(doc->strings, value)};
}

static void print_components(struct text *out, doc_type type, const char *off_diagonal,
                             const char *diagonal)
{
    ir_type_id ir = doc_type_ir(type);
    unsigned count = doc_type_components(type),
             columns = ir_type_is_matrix(ir) ? ir_type_info(ir)->columns : 1;
    assert(columns == 1 || columns * columns == count);
    for (unsigned i = 0; i < count; i++) {
        text_str(out, i ? ", " : "");
        text_str(out, columns == 1 || i % (columns + 1) == 0 ? diagonal : off_diagonal);
    }
}

/* Appends the constant `property` of a type, as in @type.zero@; false if there is none. */
static bool print_type_constant(struct text *out, doc_type type, const char *property, size_t len)
{
    struct slice name = {property, len};
    bool integer = type == DOC_TYPE_integer, boolean = type == DOC_TYPE_boolean;
    unsigned components = doc_type_components(type);
    if (type == DOC_TYPE_NONE)
        return false;
    if (slice_is(name, "glsl", 4) && doc_type_ir(type) != IR_TYPE_VOID)
        text_str(out, ir_type_text(doc_type_ir(type)));
    else if (slice_is(name, "size", 4) && (components || boolean))
        text_u32(out, boolean ? 1 : components);
    else if (slice_is(name, "zero", 4) && boolean)
        text_str(out, "false");
    else if (slice_is(name, "one", 3) && boolean)
        text_str(out, "true");
    else if (slice_is(name, "zero", 4))
        print_components(out, type, integer ? "0" : "0.0", integer ? "0" : "0.0");
    else if (slice_is(name, "one", 3))
        print_components(out, type, "0.0", integer ? "1" : "1.0");
    else if (slice_is(name, "half", 4) && components && !integer)
        print_components(out, type, "0.0", "0.5");
    else
        return false;
    return true;
}

enum token_result { TOKEN_REPLACED, TOKEN_OF_OTHERS, TOKEN_BAD };

/* Appends the replacement of @token@. */
static enum token_result print_token(const struct expansion *x, struct slice token,
                                     struct text *out)
{
    assert(x->num_vars <= MAX_VARIABLES);
    const char *dot = memchr(token.text, '.', token.len);
    size_t len = dot ? (size_t)(dot - token.text) : token.len;
    for (size_t i = 0; i < x->num_vars; i++) {
        if (!slice_is(x->vars[i], token.text, len))
            continue;
        if (!dot) {
            text_mem(out, x->row[i].text, x->row[i].len);
            return TOKEN_REPLACED;
        }
        doc_type type = doc_type_of(str_find(x->doc->strings, x->row[i].text, x->row[i].len));
        return print_type_constant(out, type, dot + 1, token.len - len - 1) ? TOKEN_REPLACED
                                                                            : TOKEN_BAD;
    }
    return TOKEN_OF_OTHERS;
}

/*
 * Length of a token after its '@': a name or name.constant, followed by '@'. 0: an ordinary at
 * sign.
 */
static size_t token_length(const char *text, size_t len)
{
    size_t n = 0;
    while (n < len
           && ((text[n] >= 'a' && text[n] <= 'z') || (text[n] >= 'A' && text[n] <= 'Z')
               || (text[n] >= '0' && text[n] <= '9') || text[n] == '_' || text[n] == '.'))
        n++;
    return n < len && text[n] == '@' ? n : 0;
}

/*
 * Replaces the tokens in a text by the words of the row. `nested`: the text is inside an inner
 * template, which handles the remaining tokens.
 */
static str_id substitute(struct expansion *x, str_id value, bool nested)
{
    const char *text = str_text(x->doc->strings, value);
    size_t len = str_len(x->doc->strings, value);
    const char *at = memchr(text, '@', len), *end = text + len;
    if (!at)
        return value;
    struct text *out = x->scratch;
    out->len = 0;
    for (; at; at = memchr(text, '@', (size_t)(end - text))) {
        text_mem(out, text, (size_t)(at - text));
        struct slice token = {at + 1, token_length(at + 1, (size_t)(end - at - 1))};
        enum token_result result = token.len ? print_token(x, token, out) : TOKEN_OF_OTHERS;
        if (result == TOKEN_BAD)
            fail(x, STR_rows, "no constant '@%.*s@'", token);
        else if (result == TOKEN_OF_OTHERS && token.len && !nested)
            fail(x, STR_vars, "unknown variable '@%.*s@'", token);
        text = at;
        if (result == TOKEN_REPLACED)
            text += token.len + 2;
        else
            text_char(out, *text++);
    }
    assert(text <= end);
    text_mem(out, text, (size_t)(end - text));
    return str_intern(x->doc->strings, out->data, out->len);
}

/*
 * Reports a variable of an inner template that hides an outer one, because the outer one is already
 * replaced.
 */
static void check_hiding(struct expansion *x, elem_id inner)
{
    struct slice rest = attr_slice(x->doc, inner, STR_vars);
    for (struct slice word = next_word(&rest); word.len; word = next_word(&rest))
        for (size_t i = 0; i < x->num_vars; i++)
            if (slice_is(x->vars[i], word.text, word.len))
                fail(x, STR_vars, "an inner template also has a variable '%.*s'", word);
}

/* Copies one element without its children. */
static elem_id copy_element(struct expansion *x, elem_id source, elem_id parent, bool nested)
{
    struct document *doc = x->doc;
    const struct element e = *doc_element(doc, source);
    elem_id copy = doc_add_like(doc, parent, e.category, substitute(x, e.name, nested), source);
    assert(doc_element(doc, copy)->kind == e.kind);
    for (uint32_t i = 0; i < e.num_attrs; i++) {
        struct attribute attr = doc_attrs(doc, source)[i];
        attr.value = substitute(x, attr.value, nested);
        doc_add_attr(doc, copy, attr);
    }
    assert(doc_element(doc, copy)->num_attrs == e.num_attrs);
    return copy;
}

static void copy_tree(struct expansion *x, elem_id source)
{
    struct document *doc = x->doc;
    elem_id template = 0; /* the outermost inner template that contains `from` */
    elem_id copy = copy_element(x, source, doc_element(doc, x->template)->parent, false);
    doc_move_before(doc, copy, x->template);
    assert(doc_element(doc, copy)->next == x->template);
    for (elem_id from = source; !is_full(x);) {
        if (!template && doc_element(doc, from)->kind == KIND_TEMPLATE) {
            template = from;
            check_hiding(x, from);
        }
        elem_id next = doc_element(doc, from)->first_child;
        elem_id parent = copy;
        while (!next) {
            if (from == source)
                return;
            if (from == template)
                template = 0;
            next = doc_element(doc, from)->next;
            parent = doc_element(doc, copy)->parent;
            if (!next) {
                from = doc_element(doc, from)->parent;
                copy = parent;
            }
        }
        from = next;
        copy = copy_element(x, from, parent, template != 0);
    }
}

static bool read_vars(struct expansion *x)
{
    struct slice rest = attr_slice(x->doc, x->template, STR_vars);
    for (struct slice word = next_word(&rest); word.len; word = next_word(&rest)) {
        if (x->num_vars == MAX_VARIABLES) {
            fail(x, STR_vars, "too many variables, from '%.*s' on", word);
            return false;
        }
        x->vars[x->num_vars++] = word;
    }
    if (x->num_vars == 0)
        fail(x, STR_vars, "it needs vars=\"name …\" and rows=\"word …; word …\"%.*s",
             (struct slice){"", 0});
    return x->num_vars > 0;
}

/* Splits the next row off `rest`; false at the end. Skips empty rows. */
static bool read_row(struct expansion *x, struct slice *rest)
{
    assert(x->num_vars > 0 && x->num_vars <= MAX_VARIABLES);
    while (rest->len) {
        const char *semicolon = memchr(rest->text, ';', rest->len);
        struct slice line = {rest->text, semicolon ? (size_t)(semicolon - rest->text) : rest->len};
        size_t used = line.len + (semicolon != NULL), count = 0;
        rest->text += used, rest->len -= used;
        struct slice words = line;
        for (struct slice word = next_word(&words); word.len; word = next_word(&words), count++)
            if (count < x->num_vars)
                x->row[count] = word;
        if (count == x->num_vars)
            return true;
        if (count)
            fail(x, STR_rows, "the row '%.*s' needs one word for each variable", line);
    }
    return false;
}

static void expand(struct expansion *x)
{
    struct document *doc = x->doc;
    assert(x->num_vars == 0 && doc_element(doc, x->template)->kind == KIND_TEMPLATE);
    struct slice rest = attr_slice(doc, x->template, STR_rows);
    if (!read_vars(x))
        return;
    while (!x->failed && !is_full(x) && read_row(x, &rest))
        for (elem_id child = doc_element(doc, x->template)->first_child; child;
             child = doc_element(doc, child)->next)
            copy_tree(x, child);
}

/* True if the element is in the tree and not inside an unexpanded or expanded template. */
static bool is_outermost(const struct document *doc, elem_id element)
{
    elem_id parent = doc_element(doc, element)->parent;
    while (parent && doc_element(doc, parent)->kind != KIND_TEMPLATE && parent != doc->root)
        parent = doc_element(doc, parent)->parent;
    return parent && parent == doc->root;
}

void doc_expand_templates(struct document *doc, struct diag_list *diags)
{
    if (!doc->has_templates)
        return;
    struct text scratch;
    text_init(&scratch, doc->arena);
    struct expansion first = {.doc = doc,
                              .most_elements = doc_num_elements(doc) + MAX_MADE,
                              .diags = diags,
                              .scratch = &scratch};
    /* the loop also reaches the copies of inner templates */
    for (uint32_t i = 0; i < doc->elements.len && !is_full(&first); i++) {
        struct expansion x = first;
        x.template = doc->first_element + i;
        if (doc->elements.items[i].kind != KIND_TEMPLATE || !is_outermost(doc, x.template))
            continue;
        expand(&x);
        if (is_full(&x) && !doc_is_full(doc))
            fail(&x, STR_rows, "the templates of a document make 131072 elements at most%.*s",
                 (struct slice){"", 0});
        doc_remove_element(doc, x.template);
    }
    doc->has_templates = false;
    if (doc_is_full(doc))
        diag_add(diags, DIAG_ID_too_many_elements, doc_place(doc, doc->root),
                 (unsigned)doc->max_elements);
}
