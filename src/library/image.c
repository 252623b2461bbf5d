// SPDX-License-Identifier: Apache-2.0
/*
 * The library image: the arrays of a layer in their memory layout, one after another.
 *
 *     header | section 0 | section 1 | …     each section aligned to 16 bytes
 *
 * Records refer to each other by index, so mapping sets one pointer per section. The layout belongs
 * to one build on one kind of machine. The header has a fingerprint of it; mxgen refuses an image
 * with another fingerprint.
 */
#include "library/library.h"

#include "base/hash.h"

#include <assert.h>

enum { ALIGNMENT = 16 };

struct any_vec { /* the layout of every VEC */
    void *items;
    uint32_t len, cap;
};

struct section_info {
    size_t offset; /* of the VEC in struct library */
    size_t item_size;
};

#define SECTION(field) \
    { \
        offsetof(struct library, field), sizeof *((struct library *)NULL)->field.items \
    }
static const struct section_info section_infos[] = {
    SECTION(doc.elements), SECTION(doc.attrs),       SECTION(doc.files),
    SECTION(unit.nodes),   SECTION(unit.slots),      SECTION(unit.functions),
    SECTION(unit.globals), SECTION(unit.files),      SECTION(unit.words),
    SECTION(unit.refs),    SECTION(unit.user_types), SECTION(unit.members),
    SECTION(unit.texts),   SECTION(unit.text_bytes), SECTION(nodedefs),
    SECTION(ports),        SECTION(impls),           SECTION(families),
    SECTION(verbatims),    SECTION(graph_nodes),     SECTION(bindings),
    SECTION(geomprops),    SECTION(types),           SECTION(units),
    SECTION(refs),         SECTION(sources),
};
enum {
    NUM_VECS = sizeof section_infos / sizeof *section_infos,
    SECTION_NAME_TABLE = NUM_VECS, /* the name table of the document */
    SECTION_NODE_TABLE,
    SECTION_ELEMENT_INFO,
    SECTION_STR_OFFSETS,
    SECTION_STR_BYTES,
    SECTION_STR_TABLE,
    NUM_SECTIONS
};

struct header {
    char magic[8];
    uint64_t fingerprint; /* hash of the layout: sizes of records, number of words, version */
    uint64_t checksum;    /* of all following bytes */
    uint64_t size;        /* of the image */
    uint32_t first_element, first_attr, first_file, root;
    uint32_t num_strings, has_attributedefs;
    struct {
        uint32_t offset, len;
    } sections[NUM_SECTIONS];
};

static const char magic[8] = "MXLIB\r\n";

static uint64_t checksum(const void *image, size_t size)
{
    size_t start = offsetof(struct header, size);
    return hash_stable(HASH_STABLE_SEED, (const char *)image + start, size - start);
}

static uint64_t fingerprint(void)
{
    uint64_t h = HASH_STABLE_SEED;
    uint32_t facts[NUM_VECS + 4] = {10 /* increase it when meanings change but sizes do not */,
                                    STR_NUM_WORDS, IR_NUM_OPS, NUM_ELEMENT_KINDS};
    for (unsigned i = 0; i < NUM_VECS; i++)
        facts[i + 4] = (uint32_t)section_infos[i].item_size;
    return hash_stable(h, facts, sizeof facts);
}

static uint32_t begin_section(struct text *out)
{
    while (out->len % ALIGNMENT)
        text_char(out, '\0');
    return (uint32_t)out->len;
}

static void put_section(struct text *out, struct header *header, unsigned section,
                        const void *items, uint32_t len, size_t item_size)
{
    assert(section < NUM_SECTIONS && header->sections[section].offset == 0);
    header->sections[section].offset = begin_section(out);
    header->sections[section].len = len;
    text_mem(out, items, len * item_size);
}

/*
 * Arrays of numbers have 16 bits for each if all of them fit, which saves a seventh of the image
 * (docs/benchmarks.md).
 */
static bool is_narrow(uint32_t max_number)
{
    return max_number <= UINT16_MAX;
}

static void put_numbers(struct text *out, struct header *header, unsigned section,
                        const uint32_t *numbers, uint32_t len, uint32_t max_number)
{
    if (!is_narrow(max_number)) {
        put_section(out, header, section, numbers, len, sizeof *numbers);
        return;
    }
    uint16_t *narrow = ARENA_ARRAY(out->arena, uint16_t, len);
    for (uint32_t i = 0; i < len; i++) {
        assert(numbers[i] <= max_number);
        narrow[i] = (uint16_t)numbers[i];
    }
    put_section(out, header, section, narrow, len, sizeof *narrow);
}

/* Narrow tables have no hashes, wide ones stay as they are. */
static void put_table(struct text *out, struct header *header, unsigned section,
                      const struct table *table, uint32_t max_number)
{
    uint32_t num_slots = table->slots ? table->mask + 1 : 0;
    assert((num_slots & (num_slots - 1)) == 0 && table->num <= num_slots);
    if (!is_narrow(max_number)) {
        put_section(out, header, section, table->slots, num_slots, sizeof *table->slots);
        return;
    }
    uint32_t *numbers = ARENA_ARRAY(out->arena, uint32_t, num_slots);
    for (uint32_t i = 0; i < num_slots; i++)
        numbers[i] = table->slots[i].number;
    put_numbers(out, header, section, numbers, num_slots, max_number);
}

static uint32_t max_element(const struct library *lib)
{
    return lib->doc.first_element + lib->doc.elements.len;
}

/* The maximum of element_info. */
static uint32_t max_info(const struct library *lib)
{
    uint32_t counts[] = {lib->nodedefs.len, lib->impls.len, lib->graph_nodes.len,
                         lib->geomprops.len, lib->types.len};
    uint32_t most = 0;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        most = counts[i] > most ? counts[i] : most;
    return most;
}

/*
 * ---- Attributes: equal runs are stored once, because rows of templates repeat most of them ----
 */

struct runs {
    struct document *doc;
    const struct attribute *from; /* of the original */
    struct table table;           /* 1 + an element whose attributes are in `doc` */
};

static void share_run(struct runs *runs, uint32_t index, struct arena *arena)
{
    assert(index < runs->doc->elements.len);
    struct document *doc = runs->doc;
    struct element *e = &doc->elements.items[index];
    const struct attribute *attrs = runs->from + (e->first_attr - doc->first_attr);
    uint32_t hash = hash_bytes(attrs, e->num_attrs * sizeof *attrs);
    for (uint32_t at = hash, found; (found = table_next(&runs->table, hash, &at));) {
        const struct element *other = &doc->elements.items[found - 1];
        const struct attribute *have = doc->attrs.items + (other->first_attr - doc->first_attr);
        if (other->num_attrs == e->num_attrs
            && memcmp(have, attrs, e->num_attrs * sizeof *attrs) == 0) {
            e->first_attr = other->first_attr;
            return;
        }
    }
    table_add(&runs->table, arena, hash, index + 1);
    e->first_attr = doc->first_attr + doc->attrs.len;
    memcpy(vec_extend(arena, &doc->attrs, e->num_attrs), attrs, e->num_attrs * sizeof *attrs);
}

/*
 * Copies elements and attributes and merges equal runs of attributes. No attribute can be added
 * afterwards.
 */
static void share_attributes(struct document *doc, struct arena *arena)
{
    struct runs runs = {.doc = doc, .from = doc->attrs.items};
    uint32_t num_elements = doc->elements.len;
    const struct element *elements = doc->elements.items;
    memset(&doc->elements, 0, sizeof doc->elements);
    memset(&doc->attrs, 0, sizeof doc->attrs);
    memcpy(vec_extend(arena, &doc->elements, num_elements), elements,
           num_elements * sizeof *elements);
    assert(doc->elements.len == num_elements);
    for (uint32_t i = 0; i < num_elements; i++)
        if (doc->elements.items[i].num_attrs)
            share_run(&runs, i, arena);
}

/* ---- Writing ---- */

static void put_strings(const struct strpool *pool, struct text *out, struct header *header)
{
    /* Every string of a document is looked for here: half of the slots are free. */
    struct table table = {0};
    table_reserve(&table, out->arena, pool->num);
    for (str_id id = 1; id < pool->num; id++)
        table_add(&table, out->arena, hash_bytes(str_text(pool, id), str_len(pool, id)), id);
    assert(table.num == pool->num - 1);
    struct text bytes;
    text_init(&bytes, out->arena);
    uint32_t *offsets = ARENA_ARRAY(out->arena, uint32_t, pool->num + 1);
    for (uint32_t i = 0; i < pool->num; i++) {
        offsets[i] = (uint32_t)bytes.len;
        text_mem(&bytes, str_text(pool, i), str_len(pool, i) + 1);
    }
    offsets[pool->num] = (uint32_t)bytes.len;
    put_section(out, header, SECTION_STR_OFFSETS, offsets, pool->num + 1, sizeof *offsets);
    put_section(out, header, SECTION_STR_BYTES, bytes.data, (uint32_t)bytes.len, 1);
    put_table(out, header, SECTION_STR_TABLE, &table, pool->num);
}

void library_write_image(const struct library *lib, const struct lang_syntax *syntax,
                         struct text *out)
{
    assert(lib->base_nodedefs == 0 && lib->doc.first_element == 1);
    struct header header = {
        .fingerprint = fingerprint(),
        .first_element = lib->doc.first_element,
        .first_attr = lib->doc.first_attr,
        .first_file = lib->doc.first_file,
        .root = lib->doc.root,
        .has_attributedefs = lib->doc.has_attributedefs,
        .num_strings = lib->strings.num,
    };
    memcpy(header.magic, magic, sizeof magic);
    struct library packed = *lib;
    share_attributes(&packed.doc, out->arena);
    if (syntax)
        lang_make_texts(&packed.unit, syntax, out->arena);
    size_t start = out->len;
    assert(start % ALIGNMENT == 0);
    text_mem(out, (const char *)&header, sizeof header);
    for (unsigned i = 0; i < NUM_VECS; i++) {
        const struct any_vec *vec = (const void *)((const char *)&packed + section_infos[i].offset);
        put_section(out, &header, i, vec->items, vec->len, section_infos[i].item_size);
    }
    put_table(out, &header, SECTION_NAME_TABLE, &lib->doc.names, max_element(lib));
    put_table(out, &header, SECTION_NODE_TABLE, &lib->node_table, lib->nodedefs.len);
    put_numbers(out, &header, SECTION_ELEMENT_INFO, lib->element_info.items, lib->element_info.len,
                max_info(lib));
    put_strings(&lib->strings, out, &header);
    begin_section(out);
    header.size = out->len - start;
    memcpy(out->data + start, &header, sizeof header);
    header.checksum = checksum(out->data + start, header.size);
    memcpy(out->data + start, &header, sizeof header);
}

static const char *check_header(const struct header *header, const void *data, size_t size,
                                bool check_bytes)
{
    if (size < sizeof *header || memcmp(header->magic, magic, sizeof magic) != 0)
        return "it is not a library image";
    if (header->fingerprint != fingerprint())
        return "another version of mxgen packed it; pack it again";
    if (header->size != size)
        return "it is truncated";
    if (check_bytes && header->checksum != checksum(data, size))
        return "it is damaged (the checksum differs)";
    return NULL;
}

/* ---- Mapping ---- */

/* Nobody writes to it: a mapped layer does not change. */
static struct table map_table(const struct header *header, unsigned section, char *base,
                              uint32_t max_number)
{
    uint32_t len = header->sections[section].len;
    void *slots = len ? base + header->sections[section].offset : NULL;
    assert((len & (len - 1)) == 0);
    return is_narrow(max_number) ? (struct table){.narrow = slots, .mask = len - 1}
                                 : (struct table){.slots = slots, .mask = len - 1};
}

static void map_strings(struct strpool *strings, const struct header *header, char *base)
{
    *strings = (struct strpool){
        .num = header->num_strings,
        .table = map_table(header, SECTION_STR_TABLE, base, header->num_strings),
        .offsets = (const void *)(base + header->sections[SECTION_STR_OFFSETS].offset),
        .bytes = base + header->sections[SECTION_STR_BYTES].offset,
    };
}

static void map_element_info(struct library *lib, const struct header *header, char *base)
{
    void *table = base + header->sections[SECTION_ELEMENT_INFO].offset;
    if (header->sections[SECTION_ELEMENT_INFO].len < lib->doc.elements.len)
        return; /* the name table was never built */
    if (is_narrow(max_info(lib)))
        lib->narrow_info = table;
    else
        lib->element_info.items = table;
    lib->element_info.len = lib->narrow_info ? 0 : header->sections[SECTION_ELEMENT_INFO].len;
}

const char *library_map_image(struct library *lib, const void *data, size_t size, bool check_bytes)
{
    const struct header *header = data;
    const char *fault = (uintptr_t)data % ALIGNMENT ? "it is not aligned"
                                                    : check_header(header, data, size, check_bytes);
    if (fault)
        return fault;
    /* No code writes through these pointers: a mapped layer does not change. */
    char *base = (char *)(uintptr_t)data;
    memset(lib, 0, sizeof *lib);
    lib->digest = header->checksum;
    for (unsigned i = 0; i < NUM_VECS; i++) {
        struct any_vec *vec = (void *)((char *)lib + section_infos[i].offset);
        vec->items = base + header->sections[i].offset;
        vec->len = header->sections[i].len;
    }
    map_strings(&lib->strings, header, base);
    lib->doc.strings = &lib->strings;
    lib->doc.first_element = header->first_element;
    lib->doc.first_attr = header->first_attr;
    lib->doc.first_file = header->first_file;
    lib->doc.root = header->root;
    lib->doc.has_attributedefs = header->has_attributedefs;
    lib->doc.names = map_table(header, SECTION_NAME_TABLE, base, max_element(lib));
    lib->node_table = map_table(header, SECTION_NODE_TABLE, base, lib->nodedefs.len);
    map_element_info(lib, header, base);
    lib->unit.strings = &lib->strings;
    return NULL;
}
