// SPDX-License-Identifier: Apache-2.0
/*
 * The data of the page: the primitives in the order of the tree (name, depth, set), and the sets of
 * layers, which primitives share. A layer says on which depth its assignment stands.
 */
#include "cli/bind_page.h"

#include "program/cli.h"
#include "program/markup.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

/* A layer in a set; texts are numbers in `texts`. */
struct page_layer {
    uint32_t kind, slot, material, depth, place;
};

struct page_set {
    uint32_t first, num; /* in `layers` */
};

/* Numbers by a hash of what they stand for. */
struct page_table {
    uint32_t *slots; /* 1 + number; 0: free */
    size_t capacity, len;
};

struct page {
    FILE *out;
    struct bind_substances *substances;
    const mxg_scene *scene;
    const mxg_bindings *bindings;
    uint32_t *depths, *set_of, num;
    char **texts;
    struct page_table text_table, set_table;
    struct page_layer *layers;
    struct page_set *sets;
    size_t num_layers, layer_capacity, text_capacity, set_capacity;
};

/* FNV-1a */
static uint64_t hash_of(const void *data, size_t size)
{
    uint64_t hash = 14695981039346656037u;
    for (const unsigned char *byte = data; size--; byte++)
        hash = (hash ^ *byte) * 1099511628211u;
    return hash;
}

/* Doubles a table that is half full; `again` gives the hash of a number. */
static void grow(struct page *page, struct page_table *table,
                 uint64_t (*again)(const struct page *page, uint32_t number))
{
    if (2 * table->len < table->capacity)
        return;
    size_t capacity = table->capacity ? 2 * table->capacity : 64;
    uint32_t *slots = memory_alloc(capacity * sizeof *slots);
    for (size_t i = 0; i < table->capacity; i++) {
        if (!table->slots[i])
            continue;
        size_t at = again(page, table->slots[i] - 1) & (capacity - 1);
        while (slots[at])
            at = (at + 1) & (capacity - 1);
        slots[at] = table->slots[i];
    }
    free(table->slots);
    table->slots = slots;
    table->capacity = capacity;
}

static uint64_t hash_of_text(const struct page *page, uint32_t number)
{
    return hash_of(page->texts[number], strlen(page->texts[number]));
}

static uint64_t hash_of_set(const struct page *page, uint32_t number)
{
    const struct page_set *set = &page->sets[number];
    return hash_of(page->layers + set->first, set->num * sizeof *page->layers);
}

static uint32_t number_of_text(struct page *page, const char *text)
{
    grow(page, &page->text_table, hash_of_text);
    size_t mask = page->text_table.capacity - 1, at = hash_of(text, strlen(text)) & mask;
    for (uint32_t found; (found = page->text_table.slots[at]) != 0; at = (at + 1) & mask)
        if (strcmp(page->texts[found - 1], text) == 0)
            return found - 1;
    size_t number = page->text_table.len++;
    if (number == page->text_capacity) {
        page->text_capacity = number ? 2 * number : 64;
        page->texts = memory_resize(page->texts, page->text_capacity * sizeof *page->texts);
    }
    page->texts[number] = cli_format("%s", text);
    page->text_table.slots[at] = (uint32_t)number + 1;
    return (uint32_t)number;
}

static struct page_layer describe(struct page *page, const mxg_layer *layer)
{
    char *place = cli_format("%s%s%s %s:%u", layer->look, *layer->look && *layer->assign ? "/" : "",
                             layer->assign, layer->file, layer->line);
    struct page_layer out = {.kind = (uint32_t)layer->kind,
                             .slot = number_of_text(page, layer->slot),
                             .material = number_of_text(page, layer->material),
                             .depth = layer->from == UINT32_MAX ? 0 : page->depths[layer->from],
                             .place = number_of_text(page, place)};
    free(place);
    return out;
}

/* The number of the set of layers that stand behind the others; an equal one is found. */
static uint32_t number_of_set(struct page *page, struct page_set set)
{
    grow(page, &page->set_table, hash_of_set);
    size_t size = set.num * sizeof *page->layers, mask = page->set_table.capacity - 1;
    size_t at = hash_of(page->layers + set.first, size) & mask;
    for (uint32_t found; (found = page->set_table.slots[at]) != 0; at = (at + 1) & mask) {
        const struct page_set *other = &page->sets[found - 1];
        if (other->num == set.num
            && (size == 0
                || memcmp(page->layers + other->first, page->layers + set.first, size) == 0))
            return found - 1;
    }
    size_t number = page->set_table.len++;
    if (number == page->set_capacity) {
        page->set_capacity = number ? 2 * number : 64;
        page->sets = memory_resize(page->sets, page->set_capacity * sizeof *page->sets);
    }
    page->sets[number] = set;
    page->set_table.slots[at] = (uint32_t)number + 1;
    return (uint32_t)number;
}

static uint32_t read_set(struct page *page, uint32_t primitive)
{
    uint32_t num = mxg_bindings_num_layers(page->bindings, primitive);
    size_t first = page->num_layers;
    if (first + num > page->layer_capacity) {
        page->layer_capacity = 2 * (first + num) + 64;
        page->layers = memory_resize(page->layers, page->layer_capacity * sizeof *page->layers);
    }
    for (uint32_t i = 0; i < num; i++) {
        mxg_layer layer = {sizeof layer};
        mxg_bindings_layer(page->bindings, primitive, i, &layer);
        page->layers[first + i] = describe(page, &layer);
    }
    uint32_t sets = (uint32_t)page->set_table.len;
    uint32_t number = number_of_set(page, (struct page_set){(uint32_t)first, num});
    if (number == sets) /* it is new: its layers stay */
        page->num_layers += num;
    return number;
}

static void read(struct page *page)
{
    page->num = mxg_scene_num_primitives(page->scene);
    page->depths = memory_alloc(page->num * sizeof *page->depths + 1);
    page->set_of = memory_alloc(page->num * sizeof *page->set_of + 1);
    for (uint32_t i = 0; i < page->num; i++) { /* a parent comes before its children */
        mxg_primitive at = {sizeof at};
        mxg_scene_primitive(page->scene, i, &at);
        page->depths[i] = at.parent == UINT32_MAX ? 1 : page->depths[at.parent] + 1;
        page->set_of[i] = read_set(page, i);
    }
}

/* A text in JSON inside of <script>, where "</" would end it. */
static void put_text(FILE *out, const char *text, size_t len)
{
    putc('"', out);
    for (size_t i = 0; i < len; i++) {
        unsigned char c = (unsigned char)text[i];
        if (c < 0x20 || c == '<' || c == '"' || c == '\\')
            fprintf(out, "\\u%04x", c);
        else
            putc(c, out);
    }
    putc('"', out);
}

/* The primitives in the order of the tree. */
static void put_rows(const struct page *page)
{
    mxg_primitive at = {sizeof at};
    uint32_t next = page->num ? 0 : UINT32_MAX;
    fputs("\"rows\": [", page->out);
    while (next != UINT32_MAX) {
        mxg_scene_primitive(page->scene, next, &at);
        put_text(page->out, at.name, at.name_len);
        fprintf(page->out, ",%u,%u", page->depths[next], page->set_of[next]);
        uint32_t up = at.parent;
        next = at.first_child != UINT32_MAX ? at.first_child : at.next_sibling;
        while (next == UINT32_MAX && up != UINT32_MAX) {
            mxg_scene_primitive(page->scene, up, &at);
            next = at.next_sibling;
            up = at.parent;
        }
        fputs(next == UINT32_MAX ? "" : ",\n", page->out);
    }
    fputs("],\n", page->out);
}

/* Graph and picture of each material and override, by the number of its name. */
static void put_substances(const struct page *page)
{
    bool *is_told = memory_alloc(page->text_table.len * sizeof *is_told + 1);
    const char *before = "";
    for (size_t i = 0; i < page->num_layers; i++) {
        uint32_t text = page->layers[i].material;
        if (is_told[text])
            continue;
        is_told[text] = true;
        char *graph = substance_graph(page->substances, page->texts[text]);
        char *picture = substance_picture(page->substances, page->texts[text]);
        fprintf(page->out, "%s\"%u\": {\"graph\": ", before, text);
        put_text(page->out, graph, strlen(graph));
        if (picture)
            fprintf(page->out, ", \"picture\": \"data:image/png;base64,%s\"", picture);
        putc('}', page->out);
        before = ",\n";
        free(graph);
        free(picture);
    }
    free(is_told);
}

static void put_data(const struct page *page)
{
    putc('{', page->out);
    put_rows(page);
    fputs("\"sets\": [", page->out);
    for (size_t s = 0; s < page->set_table.len; s++) {
        fputs(s ? ",\n[" : "[", page->out);
        for (uint32_t i = 0; i < page->sets[s].num; i++) {
            const struct page_layer *l = &page->layers[page->sets[s].first + i];
            fprintf(page->out, "%s[%u,%u,%u,%u,%u]", i ? "," : "", l->kind, l->slot, l->material,
                    l->depth, l->place);
        }
        putc(']', page->out);
    }
    fputs("],\n\"texts\": [", page->out);
    for (size_t i = 0; i < page->text_table.len; i++) {
        fputs(i ? "," : "", page->out);
        put_text(page->out, page->texts[i], strlen(page->texts[i]));
    }
    fputs("],\n\"substances\": {", page->out);
    put_substances(page);
    fputs("}}\n", page->out);
}

void bind_page_write(FILE *out, const mxg_scene *scene, const mxg_bindings *bindings,
                     struct bind_substances *substances, const char *title)
{
    struct page page = {.out = out, .substances = substances, .scene = scene, .bindings = bindings};
    read(&page);
    fputs("<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Layers</title>\n"
          "<style>\n",
          out);
    markup_lines(out, layers_style);
    fputs(
        "</style>\n<header><h1>Layers</h1><input type=\"search\" placeholder=\"path, slot or "
        "material\" aria-label=\"Search\"><button id=\"fold\">Fold all</button><button "
        "id=\"unfold\">Unfold all</button><output></output></header>\n"
        "<main><div id=\"list\" tabindex=\"0\"><div id=\"rows\"></div></div>"
        "<aside id=\"detail\"><p>Click on a layer to see where it comes from.</p></aside></main>\n"
        "<script id=\"look\" type=\"application/json\">",
        out);
    put_text(out, title, strlen(title));
    fputs("</script>\n<script id=\"data\" type=\"application/json\">\n", out);
    put_data(&page);
    fputs("</script>\n<script>\n", out);
    markup_lines(out, layers_script);
    fputs("</script>\n</html>\n", out);
    for (size_t i = 0; i < page.text_table.len; i++)
        free(page.texts[i]);
    free(page.texts);
    free(page.text_table.slots);
    free(page.set_table.slots);
    free(page.layers);
    free(page.sets);
    free(page.depths);
    free(page.set_of);
}
