// SPDX-License-Identifier: Apache-2.0
/*
 * Converts text to elements with libxml2's SAX2 interface. No jump crosses a frame of libxml2: each
 * callback runs under mem_try.
 */
#include "xml/xml_priv.h"

#include <assert.h>
#include <libxml/parser.h>
#include <libxml/parserInternals.h>
#include <limits.h>

#define XINCLUDE_NAMESPACE "http://www.w3.org/2001/XInclude"

void xml_startup(void)
{
    xmlInitParser();
}

/* Stops libxml2. Later callbacks and errors are consequences of the stop. */
static void stop(struct xml_reader *reader)
{
    reader->stopped = true;
    xmlStopParser(reader->parser);
}

/* Number of source bytes that libxml2 has consumed. */
static size_t parser_offset(const struct xml_reader *reader)
{
    const xmlParserInput *input = reader->parser->input;
    if (!input)
        return reader->source->size;
    size_t offset = reader->source->start + input->consumed + (size_t)(input->cur - input->base);
    return offset < reader->source->size ? offset : reader->source->size;
}

struct start_tag {
    struct xml_reader *reader;
    const char *name, *prefix, *uri;
    int num_namespaces, num_attrs;
    const xmlChar **namespaces; /* pairs: prefix, URI */
    const xmlChar **attrs;      /* name, prefix, URI, value, end of the value */
};

/* "prefix:name" or "name", interned. */
static str_id qualified_name(struct xml_reader *reader, const char *prefix, const char *name)
{
    struct strpool *strings = reader->doc->strings;
    if (!prefix)
        return str_intern_z(strings, name);
    char small[128];
    size_t prefix_len = strlen(prefix), name_len = strlen(name), len = prefix_len + 1 + name_len;
    char *text = len <= sizeof small ? small : arena_alloc(&reader->scratch, len);
    memcpy(text, prefix, prefix_len);
    text[prefix_len] = ':';
    memcpy(text + prefix_len + 1, name, name_len);
    return str_intern(strings, text, len);
}

static str_id attr_value(struct xml_reader *reader, const xmlChar *value, const xmlChar *end)
{
    const char *text = (const char *)value;
    size_t len = (size_t)(end - value);
    if (!reader->source->raw.len)
        return str_intern(reader->doc->strings, text, len);
    char *copy = arena_strndup(&reader->scratch, text, len);
    for (unsigned i = 0; i < XML_NUM_RAW; i++)
        for (char *p = copy;
             (p = memchr(p, reader->source->stand_ins[i], (size_t)(copy + len - p))) != NULL;)
            *p = XML_RAW_CHARACTERS[i];
    return str_intern(reader->doc->strings, copy, len);
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* The end of a run of characters for which is_in is true, at most the end of the text. */
static size_t skip_while(const struct xml_source *source, size_t at, bool (*is_in)(char))
{
    while (at < source->size && is_in(source->text[at]))
        at++;
    return at;
}

static bool is_in_name(char c)
{
    return !is_blank(c) && c != '=' && c != '>' && c != '/';
}

static bool is_no_quote(char c)
{
    return c != '"' && c != '\'';
}

/*
 * Offset of the next attribute's value in a start tag; moves `at` behind it. libxml2 has parsed the
 * tag up to its last valid attribute; the rest may be invalid.
 */
static size_t next_value(const struct xml_source *source, size_t *at, bool *out_is_namespace)
{
    size_t name = skip_while(source, *at, is_blank), end = skip_while(source, name, is_in_name);
    const char *text = source->text + name;
    *out_is_namespace =
        end - name >= 5 && memcmp(text, "xmlns", 5) == 0 && (end - name == 5 || text[5] == ':');
    size_t value = skip_while(source, end, is_no_quote) + 1;
    const char *close = value < source->size ? memchr(source->text + value, source->text[value - 1],
                                                      source->size - value)
                                             : NULL;
    *at = close ? (size_t)(close - source->text) + 1 : source->size;
    assert(*at <= source->size);
    return value < source->size ? value : source->size;
}

static void add_attr(struct xml_reader *reader, elem_id element, str_id name, str_id value,
                     struct diag_place element_place, size_t offset)
{
    assert(element_place.line <= reader->source->position.line);
    const char *value_text = reader->source->text + offset;
    reader->doc->has_loose_attrs |= value_text[-2] != '=' || is_blank(value_text[-3]);
    uint32_t column = xml_column(reader->source, offset),
             lines = reader->source->position.line - element_place.line;
    doc_add_attr(
        reader->doc, element,
        (struct attribute){.name = name,
                           .value = value,
                           .line_delta = (int16_t)(lines < INT16_MAX ? lines : INT16_MAX),
                           .column = (uint16_t)(column < UINT16_MAX ? column : UINT16_MAX)});
}

/*
 * Offset of an attribute's value if it points into the input of libxml2; SIZE_MAX if it is a copy.
 */
static size_t value_offset(const struct xml_reader *reader, const xmlChar *value)
{
    const xmlParserInput *input = reader->parser->input;
    uintptr_t base = (uintptr_t)input->base, at = (uintptr_t)value;
    bool is_inside = at > base && at < (uintptr_t)input->end;
    return is_inside ? reader->source->start + input->consumed + (size_t)(at - base) : SIZE_MAX;
}

/* Except the name, which the element stores. */
static void add_plain_attr(const struct start_tag *tag, int index, elem_id element,
                           struct diag_place place, size_t offset)
{
    struct xml_reader *reader = tag->reader;
    const xmlChar **a = tag->attrs + (size_t)index * 5;
    str_id name = qualified_name(reader, (const char *)a[1], (const char *)a[0]);
    if (name == STR_name) {
        doc_set_name(reader->doc, element, attr_value(reader, a[3], a[4]));
        uint32_t column = xml_column(reader->source, offset);
        doc_set_name_place(reader->doc, element, reader->source->position.line - place.line,
                           column);
    } else
        add_attr(reader, element, name, attr_value(reader, a[3], a[4]), place, offset);
}

/*
 * Adds attributes in the order of the text. Namespace declarations except XInclude's are
 * attributes.
 */
static void add_attrs(const struct start_tag *tag, elem_id element, struct diag_place place,
                      size_t at)
{
    struct xml_reader *reader = tag->reader;
    int ns = 0, attr = 0;
    while (ns < tag->num_namespaces || attr < tag->num_attrs) {
        bool is_namespace;
        size_t value = next_value(reader->source, &at, &is_namespace);
        if (is_namespace && ns < tag->num_namespaces) {
            const char *prefix = (const char *)tag->namespaces[ns * 2],
                       *uri = (const char *)tag->namespaces[ns * 2 + 1];
            ns++;
            if (uri && strcmp(uri, XINCLUDE_NAMESPACE) != 0)
                add_attr(reader, element,
                         qualified_name(reader, prefix ? "xmlns" : NULL, prefix ? prefix : "xmlns"),
                         str_intern_z(reader->doc->strings, uri), place, value);
        } else if (attr < tag->num_attrs) {
            add_plain_attr(tag, attr++, element, place, value);
        } else {
            break;
        }
    }
}

static bool is_xinclude(const struct start_tag *tag)
{
    return (tag->uri && strcmp(tag->uri, XINCLUDE_NAMESPACE) == 0)
           || (tag->prefix && strcmp(tag->prefix, "xi") == 0);
}

/* Adds an element; the root exists already. 0: a limit was reached. */
static elem_id add_element(const struct start_tag *tag, struct diag_place place)
{
    struct xml_reader *reader = tag->reader;
    struct xml_source *source = reader->source;
    uint16_t column = (uint16_t)(place.column < UINT16_MAX ? place.column : UINT16_MAX);
    str_id category = qualified_name(reader, is_xinclude(tag) ? "xi" : tag->prefix, tag->name);
    if (source->depth > 0 && !doc_is_full(reader->doc))
        return doc_add_element(reader->doc, source->current, category, STR_EMPTY, source->file,
                               place.line, column);
    if (source->depth > 0) {
        diag_add(reader->diags, DIAG_ID_too_many_elements, place,
                 (unsigned)reader->limits.max_elements);
        stop(reader);
        return 0;
    }
    if (category != STR_materialx) {
        diag_add(reader->diags, DIAG_ID_xml_root, place, str_text(reader->doc->strings, category));
        stop(reader);
        return 0;
    }
    doc_set_place(reader->doc, source->root, source->file, place.line, column);
    return source->root;
}

/*
 * The offset of the first value, if all values have offsets and only attributes lie between them;
 * otherwise SIZE_MAX.
 */
static size_t known_values(const struct start_tag *tag)
{
    if (tag->num_namespaces || !tag->num_attrs)
        return SIZE_MAX;
    for (int i = 0; i < tag->num_attrs; i++)
        if (value_offset(tag->reader, tag->attrs[(size_t)i * 5 + 3]) == SIZE_MAX)
            return SIZE_MAX;
    return value_offset(tag->reader, tag->attrs[3]);
}

static void start_element(void *arg)
{
    const struct start_tag *tag = arg;
    struct xml_reader *reader = tag->reader;
    struct xml_source *source = reader->source;
    size_t values = known_values(tag), at = values != SIZE_MAX ? values : parser_offset(reader);
    const char *text = source->text;
    at -= at == source->size;
    while (at > source->start && text[at] != '<')
        /*
         * From the first value, or from the end of the attributes, the tag begins at the last '<',
         * because an attribute cannot contain one.
         */
        at--;
    struct diag_place place = xml_place(reader, at);
    if (source->depth >= reader->limits.max_depth) {
        diag_add(reader->diags, DIAG_ID_xml_depth, place, (unsigned)reader->limits.max_depth);
        stop(reader);
        return;
    }
    elem_id element = add_element(tag, place);
    if (!element)
        return;
    if (values == SIZE_MAX)
        add_attrs(tag, element, place, skip_while(source, at, is_in_name));
    for (int i = 0; i < tag->num_attrs && values != SIZE_MAX; i++)
        add_plain_attr(tag, i, element, place, value_offset(reader, tag->attrs[(size_t)i * 5 + 3]));
    xml_see_start(reader, element);
    source->current = element;
    source->depth++;
    if (!is_xinclude(tag))
        return;
    if (!tag->uri && !source->warned_prefix) {
        source->warned_prefix = true;
        diag_add(reader->diags, DIAG_ID_xml_undeclared_prefix, place, tag->prefix);
    }
    if (strcmp(tag->name, "include") == 0)
        vec_push(&reader->scratch, &reader->includes, element);
}

static void guarded(struct xml_reader *reader, void (*work)(void *), void *arg)
{
    if (!reader->stopped && !mem_try(reader->mem, work, arg)) {
        reader->out_of_memory = true;
        stop(reader);
    }
}

static void on_start_element(void *user, const xmlChar *name, const xmlChar *prefix,
                             const xmlChar *uri, int num_namespaces, const xmlChar **namespaces,
                             int num_attrs, int num_defaulted, const xmlChar **attrs)
{
    (void)num_defaulted; /* only a DOCTYPE can set defaults */
    struct start_tag tag = {
        user,           (const char *)name, (const char *)prefix, (const char *)uri,
        num_namespaces, num_attrs,          namespaces,           attrs};
    guarded(user, start_element, &tag);
}

static void end_element(void *arg)
{
    struct xml_reader *reader = arg;
    struct xml_source *source = reader->source;
    assert(source->depth > 0);
    xml_see_end(reader, source->current);
    source->depth--;
    source->current = doc_element(reader->doc, source->current)->parent;
}

static void on_end_element(void *user, const xmlChar *name, const xmlChar *prefix,
                           const xmlChar *uri)
{
    (void)name, (void)prefix, (void)uri;
    guarded(user, end_element, user);
}

/* A comment, or the words of a processing instruction. */
struct aside {
    struct xml_reader *reader;
    const xmlChar *text, *target; /* NULL: none */
};

static void add_aside(void *arg)
{
    const struct aside *aside = arg;
    struct text text;
    text_init(&text, &aside->reader->scratch);
    if (!aside->target)
        text_fmt(&text, "<!--%s-->", (const char *)aside->text);
    else
        text_fmt(&text, "<?%s%s%s?>", (const char *)aside->target, aside->text ? " " : "",
                 aside->text ? (const char *)aside->text : "");
    xml_see_comment(aside->reader, str_intern(aside->reader->doc->strings, text.data, text.len));
}

static void on_comment(void *user, const xmlChar *text)
{
    struct xml_reader *reader = user;
    if (reader->doc->keeps_comments)
        guarded(reader, add_aside, &(struct aside){reader, text, NULL});
}

static void on_instruction(void *user, const xmlChar *target, const xmlChar *text)
{
    struct xml_reader *reader = user;
    if (reader->doc->keeps_comments)
        guarded(reader, add_aside, &(struct aside){reader, text, target});
}

static void stray_text(void *arg)
{
    struct xml_reader *reader = arg;
    diag_add(reader->diags, DIAG_ID_xml_stray_text,
             doc_place(reader->doc, reader->source->current));
    reader->source->warned_text = true;
}

static void on_text(void *user, const xmlChar *text, int len)
{
    struct xml_reader *reader = user;
    if (reader->stopped)
        return;
    for (int i = 0; i < len; i++) {
        reader->source->num_line_ends += text[i] == '\n';
        if (text[i] > ' ' && !reader->source->warned_text) {
            guarded(reader, stray_text, reader);
            return;
        }
    }
}

static void refuse_doctype(void *arg)
{
    struct xml_reader *reader = arg;
    diag_add(reader->diags, DIAG_ID_xml_doctype, xml_place(reader, parser_offset(reader)));
    stop(reader);
}

static void on_doctype(void *user, const xmlChar *name, const xmlChar *external_id,
                       const xmlChar *system_id)
{
    (void)name, (void)external_id, (void)system_id;
    guarded(user, refuse_doctype, user);
}

struct parser_error {
    struct xml_reader *reader;
    const xmlError *error;
};

/* The message of libxml2 as one line. */
static const char *message_of(struct xml_reader *reader, const xmlError *error)
{
    const char *message = error->message ? error->message : "not well formed";
    size_t len = strcspn(message, "\r\n");
    while (len && message[len - 1] == ' ')
        len--;
    return arena_strndup(&reader->scratch, message, len);
}

/* True for text after </materialx> without an element: the tree is complete. */
static bool is_trailing_text(const struct xml_reader *reader, const xmlError *error, size_t offset)
{
    const struct xml_source *source = reader->source;
    return error->code == XML_ERR_DOCUMENT_END && source->depth == 0
           && !memchr(source->text + offset, '<', source->size - offset);
}

/* The raw character in an attribute value that may cause an error; 0: none. */
static char raw_character(const xmlError *error, char before)
{
    switch (error->code) {
    case XML_ERR_LT_IN_ATTRIBUTE: return '<';
    case XML_ERR_NAME_REQUIRED: return before == '&' ? '&' : 0;
    case XML_ERR_ENTITYREF_SEMICOL_MISSING:
    case XML_ERR_UNDECLARED_ENTITY:
    case XML_WAR_UNDECLARED_ENTITY:
    case XML_ERR_INVALID_CHARREF:
    case XML_ERR_INVALID_DEC_CHARREF:
    case XML_ERR_INVALID_HEX_CHARREF: return '&';
    default: return 0;
    }
}

/* A name is missing: of an element behind '<', or of an attribute. */
static void report_name(struct xml_reader *reader, size_t offset, char before)
{
    char found = reader->source->text[offset];
    struct text message;
    text_init(&message, &reader->scratch);
    text_str(&message, before == '<' ? "'<' begins no element here; write '&lt;' for the character"
                                     : "expected the name of an attribute, '>' or '/>'");
    if (before != '<' && found > ' ' && found <= '~')
        text_fmt(&message, ", not '%c'", found);
    diag_add(reader->diags, DIAG_ID_xml_syntax, xml_place(reader, offset - (before == '<')),
             text_cstr(&message));
}

static void report_error(void *arg)
{
    const struct parser_error *e = arg;
    struct xml_reader *reader = e->reader;
    struct xml_source *source = reader->source;
    size_t offset = parser_offset(reader);
    struct diag_place place = xml_place(reader, offset);
    const char *message = message_of(reader, e->error);
    char before = offset > source->start ? source->text[offset - 1] : 0;
    if (raw_character(e->error, before) && !source->raw.len) {
        reader->raw_character = raw_character(e->error, before);
        reader->raw_place = place;
    } else if (source->raw.len) {
        reader->repair_failed = true; /* the author did not write the repaired text */
    } else if (is_trailing_text(reader, e->error, offset)) {
        diag_add(reader->diags, DIAG_ID_xml_text_after, place);
        return;
    } else if (strncmp(message, "Input is not proper UTF-8", 25) == 0) {
        diag_add(reader->diags, DIAG_ID_xml_encoding, place, "UTF-8");
    } else if (e->error->code == XML_ERR_DOCUMENT_EMPTY) {
        diag_add(reader->diags, DIAG_ID_xml_not_xml, place);
    } else if (offset == source->size && source->depth > 0
               && e->error->code != XML_ERR_TAG_NAME_MISMATCH) {
        str_id innermost = doc_element(reader->doc, source->current)->category;
        diag_add(reader->diags, DIAG_ID_xml_truncated, place,
                 str_text(reader->doc->strings, innermost));
    } else if (e->error->code == XML_ERR_NAME_REQUIRED && offset < source->size) {
        report_name(reader, offset, before);
    } else {
        diag_add(reader->diags, DIAG_ID_xml_syntax, place, message);
    }
    stop(reader);
}

static void on_error(void *user, const xmlError *error)
{
    struct xml_reader *reader = user;
    if (error->code == XML_ERR_NO_MEMORY) {
        reader->out_of_memory = true;
        reader->mem->over_limit = false;
        stop(reader);
    }
    /* MaterialX qualifies node names with its own namespaces, which no xmlns declares. */
    bool is_undeclared_prefix =
        error->domain == XML_FROM_NAMESPACE && error->code == XML_NS_ERR_UNDEFINED_NAMESPACE;
    if (error->level >= XML_ERR_ERROR && !is_undeclared_prefix)
        guarded(reader, report_error, &(struct parser_error){reader, error});
}

static void on_structured_error(void *user, xmlErrorPtr error)
{
    on_error(user, error);
}

static bool prepare_parser(struct xml_reader *reader)
{
    if (!reader->parser)
        reader->parser = xmlNewParserCtxt();
    if (!reader->parser)
        return false;
    *reader->parser->sax = (xmlSAXHandler){
        .initialized = XML_SAX2_MAGIC,
        .startElementNs = on_start_element,
        .endElementNs = on_end_element,
        .characters = on_text,
        .ignorableWhitespace = on_text,
        .cdataBlock = on_text,
        .comment = on_comment,
        .processingInstruction = on_instruction,
        .internalSubset = on_doctype,
        .serror = on_structured_error,
    };
    reader->parser->userData = reader;
    return true;
}

static bool is_ascii(const char *text, size_t size)
{
    uint64_t all = 0, word;
    for (; size >= sizeof word; text += sizeof word, size -= sizeof word) {
        memcpy(&word, text, sizeof word);
        all |= word;
    }
    for (; size; text++, size--)
        all |= (unsigned char)*text;
    return (all & 0x8080808080808080u) == 0;
}

static void parse_once(struct xml_reader *reader)
{
    struct xml_source *source = reader->source;
    source->is_ascii = is_ascii(source->text, source->size);
    reader->stopped = false;
    reader->raw_character = 0;
    source->position = (struct xml_position){.line = 1};
    source->current = source->ended = 0;
    source->depth = source->num_line_ends = source->comments.len = 0;
    source->is_first = true;
    /*
     * NOENT gives the text of character references; no entity can exist, because DOCTYPE is
     * refused. IGNORE_ENC, because the text is UTF-8 in spite of its declaration.
     */
    /*
     * libxml2 reports errors in a declared encoding to the handler of the thread, which prints by
     * default.
     */
    xmlStructuredErrorFunc handler = xmlStructuredError;
    void *handler_data = xmlStructuredErrorContext;
    xmlSetStructuredErrorFunc(reader, on_structured_error);
    if (prepare_parser(reader))
        xmlCtxtReadMemory(
            reader->parser, source->text + source->start, (int)(source->size - source->start), NULL,
            NULL, XML_PARSE_NOENT | XML_PARSE_NONET | XML_PARSE_BIG_LINES | XML_PARSE_IGNORE_ENC);
    else
        reader->out_of_memory = true;
    xmlSetStructuredErrorFunc(handler_data, handler);
    if (reader->out_of_memory)
        mem_fail(reader->mem);
}

/* `first` was the error without a repair. */
static void report_raw(struct xml_reader *reader, char first)
{
    const struct xml_source *source = reader->source;
    if (reader->repair_failed)
        diag_add(
            reader->diags, DIAG_ID_xml_syntax, reader->raw_place,
            first == '&'
                ? "unescaped '&'; write '&amp;'"
                : "unescaped '<' in an attribute value, or a missing quotation mark before it; "
                  "write '&lt;'");
    for (uint32_t i = 0; !reader->repair_failed && i < source->raw.len; i++)
        diag_add(reader->diags,
                 source->raw.items[i].character == '&' ? DIAG_ID_xml_raw_ampersand
                                                       : DIAG_ID_xml_raw_less,
                 xml_place(reader, source->raw.items[i].at));
}

bool xml_parse_source(struct xml_reader *reader)
{
    struct xml_source *source = reader->source;
    if (source->size > INT_MAX) {
        diag_add(reader->diags, DIAG_ID_file_too_large, xml_place(reader, 0), source->name,
                 (unsigned)INT_MAX >> 20);
        return false;
    }
    if (!xml_check_attributes(reader))
        return false;
    struct doc_mark mark = doc_mark(reader->doc, source->root);
    uint32_t num_includes = reader->includes.len;
    reader->repair_failed = false;
    parse_once(reader);
    char first = reader->raw_character;
    if (first) {
        doc_rollback(reader->doc, source->root, &mark);
        reader->includes.len = num_includes;
        reader->repair_failed = !xml_repair_text(reader);
        if (!reader->repair_failed)
            parse_once(reader);
        report_raw(reader, first);
    }
    bool parsed = !reader->stopped && !reader->repair_failed;
    assert(reader->includes.len >= num_includes);
    assert(!parsed || source->depth == 0);
    if (parsed)
        xml_see_file_end(reader, source->root);
    if (!parsed) /* a partial document does not count */
        doc_rollback(reader->doc, source->root, &mark);
    return parsed;
}
