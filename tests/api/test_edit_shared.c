// SPDX-License-Identifier: Apache-2.0
/*
 * Edited documents share what they do not change: memory and work of an edit do not grow with the
 * document, and after any sequence of edits a document is what reading its text gives.
 */
#include "fixture.h"

static size_t used, allocated;

static void *count_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    (void)user_data;
    used += new_size - old_size;
    allocated += new_size;
    if (new_size)
        return realloc(block, new_size);
    free(block);
    return NULL;
}

struct world {
    mxg_context *context;
    mxg_library *library;
};

static struct world open_world(void)
{
    struct world w = {0};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.realloc = count_realloc;
    REQUIRE(mxg_context_create(&desc, &w.context) == MXG_OK);
    w.library = mxg_library_builtin(w.context);
    return w;
}

static void close_world(struct world *w)
{
    mxg_library_unref(w->library);
    mxg_context_destroy(w->context);
    REQUIRE_EQ(used, 0);
}

static mxg_document *parse(struct world *w, const char *text, size_t size)
{
    mxg_document *document = NULL;
    REQUIRE(mxg_document_parse(w->context, w->library, "shared.mtlx", text, size, &document)
            == MXG_OK);
    return document;
}

/* Shaders, each with a graph and, if `has_materials`, a material. */
static mxg_document *many_materials(struct world *w, unsigned count, bool has_materials)
{
    char *text = malloc(count * 800 + 1000);
    size_t len = (size_t)sprintf(
        text, "<materialx version='1.39'><nodedef name='ND_twice' node='twice'><input name='in' "
              "type='float' value='1'/><output name='out' type='float'/></nodedef><nodegraph "
              "name='NG_twice' nodedef='ND_twice'><add name='sum' type='float'><input name='in1' "
              "type='float' interfacename='in'/><input name='in2' type='float' "
              "interfacename='in'/></add><output name='out' type='float' nodename='sum'/>"
              "</nodegraph>");
    for (unsigned i = 0; i < count; ++i) {
        len += (size_t)sprintf(
            text + len,
            "<!-- material %u --><nodegraph name='G%u'><twice name='two' type='float'><input "
            "name='in' type='float' value='0.25'/></twice><output name='out' type='float' "
            "nodename='two'/></nodegraph><standard_surface name='S%u' type='surfaceshader'>"
            "<input name='base' type='float' value='0.5'/><input name='metalness' type='float' "
            "nodegraph='G%u'/></standard_surface>",
            i, i, i, i);
        if (has_materials)
            len += (size_t)sprintf(
                text + len,
                "<surfacematerial name='M%u' type='material'><input name='surfaceshader' "
                "type='surfaceshader' nodename='S%u'/></surfacematerial>",
                i, i);
    }
    len += (size_t)sprintf(text + len, "</materialx>");
    mxg_document *document = parse(w, text, len);
    free(text);
    return document;
}

/* ---- Memory ---- */

enum edit_kind {
    VALUE,
    NEW_INPUT,
    NEW_NODE,
    NEW_MATERIAL,
    CONNECTION,
    NAME_OF_NODE,
    NAME_OF_MATERIAL,
    NAME_OF_GRAPH,
    REMOVAL,
    REMOVED_MATERIAL,
    MOVE,
    COPY,
    NUM_KINDS
};

static void make_edit(mxg_edit *edit, const mxg_document *from, enum edit_kind kind)
{
    const float value = 0.25f;
    mxg_element shader = edited_at(edit, "S1"), material = edited_at(edit, "M1"), node;
    switch (kind) {
    case VALUE: mxg_edit_set_numbers(edit, shader, "base", NULL, &value, 1); break;
    case NEW_INPUT: mxg_edit_set_numbers(edit, shader, "coat", "float", &value, 1); break;
    case NEW_NODE: mxg_edit_add_element(edit, 0, "constant", "Grey", "float"); break;
    case NEW_MATERIAL:
        node = mxg_edit_add_element(edit, 0, "surfacematerial", "Grey", "material");
        mxg_edit_connect_input(edit, node, "surfaceshader", shader, NULL);
        break;
    case NAME_OF_NODE: mxg_edit_rename_element(edit, shader, "Shader"); break;
    case NAME_OF_MATERIAL: mxg_edit_rename_element(edit, material, "Material"); break;
    case NAME_OF_GRAPH: mxg_edit_rename_element(edit, edited_at(edit, "G1"), "Graph"); break;
    case REMOVAL: mxg_edit_remove_element(edit, edited_at(edit, "S1/base")); break;
    case REMOVED_MATERIAL: mxg_edit_remove_element(edit, material); break;
    case MOVE: mxg_edit_move_element(edit, material, 0, shader); break;
    case COPY: mxg_edit_copy_element(edit, 0, from, element_at(from, "S2"), "Copy"); break;
    default:
        node = mxg_edit_add_element(edit, 0, "constant", "Grey", "float");
        mxg_edit_connect_input(edit, shader, "base", node, NULL);
    }
    REQUIRE_EQ(mxg_edit_error(edit, NULL, 0), 0);
}

/* The bytes that a document takes beside the one that it comes from. */
static size_t bytes_of_edit(struct world *w, const mxg_document *from, enum edit_kind kind)
{
    mxg_edit *edit;
    mxg_document *next;
    size_t before = used;
    REQUIRE(mxg_edit_create(w->context, w->library, from, NULL, &edit) == MXG_OK);
    make_edit(edit, from, kind);
    REQUIRE(commit(edit, &next) == MXG_OK);
    size_t bytes = used - before;
    mxg_document_destroy(next);
    REQUIRE_EQ(used, before);
    return bytes;
}

/* A document with 40 times the materials takes the same memory for an edit. */
static void test_memory(void)
{
    struct world w = open_world();
    for (int has_materials = 0; has_materials < 2; ++has_materials) {
        mxg_document *small = many_materials(&w, 50, has_materials),
                     *large = many_materials(&w, 2000, has_materials);
        for (int kind = 0; kind < NUM_KINDS; ++kind) {
            bool is_of_material =
                kind == NAME_OF_MATERIAL || kind == REMOVED_MATERIAL || kind == MOVE;
            if (!has_materials && (is_of_material || kind == NEW_MATERIAL))
                continue; /* the first material: the document has other renderables then */
            size_t of_small = bytes_of_edit(&w, small, (enum edit_kind)kind),
                   of_large = bytes_of_edit(&w, large, (enum edit_kind)kind);
            REQUIRE(of_small > 0);
            if (!REQUIRE(of_large <= of_small + 64))
                printf("    kind %d: %zu bytes, and %zu with more materials\n", kind, of_small,
                       of_large);
        }
        mxg_document_destroy(small);
        mxg_document_destroy(large);
    }
    close_world(&w);
}

/* A series of edits, each of another material, copies a change a few times at most. */
static void test_series(void)
{
    struct world w = open_world();
    mxg_document *first = many_materials(&w, 2000, true), *document = first;
    size_t allocated_before = allocated;
    for (unsigned i = 0; i < 1000; ++i) {
        char name[16];
        mxg_edit *edit;
        mxg_document *next;
        const float value = 0.001f * (float)i;
        snprintf(name, sizeof name, "S%u", i);
        mxg_edit_create(w.context, w.library, document, NULL, &edit);
        mxg_edit_set_numbers(edit, edited_at(edit, name), "base", NULL, &value, 1);
        REQUIRE(commit(edit, &next) == MXG_OK);
        if (document != first)
            mxg_document_destroy(document);
        document = next;
    }
    size_t bytes = (allocated - allocated_before) / 1000;
    if (!REQUIRE(bytes < 65536))
        printf("    %zu bytes per edit\n", bytes);
    mxg_document_destroy(document);
    mxg_document_destroy(first);
    close_world(&w);
}

/* A slider: a thousand edits of one value take the memory of one. */
static void test_slider(void)
{
    struct world w = open_world();
    mxg_document *document = many_materials(&w, 500, true);
    size_t first = 0, most = 0, before = used;
    for (int i = 0; i < 1000; ++i) {
        mxg_edit *edit;
        mxg_document *next;
        const float value = 0.001f * (float)(i % 100);
        mxg_edit_create(w.context, w.library, document, NULL, &edit);
        mxg_edit_set_numbers(edit, edited_at(edit, "S7"), "base", NULL, &value, 1);
        REQUIRE(commit(edit, &next) == MXG_OK);
        mxg_document_destroy(document); /* its elements live on */
        document = next;
        first = i == 0 ? used - before : first;
        most = used - before > most ? used - before : most;
    }
    REQUIRE(most < first + 16384);
    mxg_document_destroy(document);
    close_world(&w);
}

/* ---- Equality with a document from the text ---- */

static unsigned next_random(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static void make_change(mxg_edit *edit, const mxg_document *from, unsigned *random)
{
    char name[32], other[32];
    const float value = 0.001f * (float)(next_random(random) % 1000);
    snprintf(name, sizeof name, "S%u", next_random(random) % 20);
    snprintf(other, sizeof other, "N%u", next_random(random) % 30);
    mxg_element shader = edited_at(edit, name), node = edited_at(edit, other), graph, two;
    snprintf(name, sizeof name, "G%u", next_random(random) % 20);
    graph = edited_at(edit, name);
    snprintf(name, sizeof name, "S%u", next_random(random) % 20);
    switch (next_random(random) % 22) {
    case 0:
    case 1:
    case 2: mxg_edit_set_numbers(edit, shader, "base", "float", &value, 1); break;
    case 3: mxg_edit_set_numbers(edit, shader, "coat", "float", &value, 1); break;
    case 4: mxg_edit_add_element(edit, 0, "constant", other, "float"); break;
    case 5: mxg_edit_connect_input(edit, shader, "specular", node, NULL); break;
    case 6: mxg_edit_remove_element(edit, mxg_edit_find_element(edit, shader, "coat")); break;
    case 7: mxg_edit_set_attribute(edit, shader, "doc", "changed"); break;
    case 8: mxg_edit_set_attribute(edit, shader, "doc", NULL); break;
    case 9: mxg_edit_move_element(edit, node, 0, shader); break;
    case 10: mxg_edit_rename_element(edit, node, "N99"); break;
    case 11: mxg_edit_copy_element(edit, 0, from, element_at(from, name), other); break;
    case 12: mxg_edit_remove_element(edit, shader); break;
    case 13: mxg_edit_rename_element(edit, graph, other); break;
    case 14: mxg_edit_rename_element(edit, shader, other); break;
    case 15:
        two = mxg_edit_find_element(edit, graph, "two");
        mxg_edit_rename_element(edit, two ? two : mxg_edit_find_element(edit, graph, "second"),
                                two ? "second" : "two");
        break;
    case 16:
        two = mxg_edit_find_element(edit, graph, "out");
        mxg_edit_rename_element(edit, two ? two : mxg_edit_find_element(edit, graph, "result"),
                                two ? "result" : "out");
        break;
    case 17: mxg_edit_move_element(edit, graph, 0, shader); break;
    case 18:
        node = mxg_edit_add_element(edit, 0, "surfacematerial", other, "material");
        mxg_edit_connect_input(edit, node, "surfaceshader", shader, NULL);
        break;
    case 19: mxg_edit_connect_input(edit, shader, "base", graph, NULL); break;
    case 20: mxg_edit_remove_element(edit, graph); break;
    default:
        node = mxg_edit_add_element(edit, 0, "nodegraph", other, NULL);
        mxg_edit_set_attribute(edit, node, "nodedef", next_random(random) % 2 ? "ND_own" : NULL);
    }
}

static void compare_renderables(const mxg_document *a, const mxg_document *b)
{
    REQUIRE_EQ(mxg_document_num_renderables(a), mxg_document_num_renderables(b));
    for (uint32_t i = 0; i < mxg_document_num_renderables(a); ++i) {
        mxg_renderable x = MXG_INIT(mxg_renderable), y = MXG_INIT(mxg_renderable);
        mxg_document_renderable(a, i, &x);
        if (mxg_document_renderable(b, i, &y) == MXG_OK)
            REQUIRE_STR(x.path, y.path);
    }
}

static void compare_elements(const mxg_document *a, const mxg_document *b)
{
    mxg_element x = element_at(a, ""), y = element_at(b, "");
    mxg_element_info p = MXG_INIT(mxg_element_info), q = MXG_INIT(mxg_element_info);
    mxg_document_element(a, x, &p);
    mxg_document_element(b, y, &q);
    for (x = p.first_child, y = q.first_child; x && y; x = p.next, y = q.next) {
        mxg_document_element(a, x, &p);
        mxg_document_element(b, y, &q);
        REQUIRE_STR(p.name, q.name);
        REQUIRE_EQ(p.num_attributes, q.num_attributes);
        REQUIRE_EQ(element_at(a, p.name), x);
    }
    REQUIRE(!x && !y);
}

/* The document equals the one that its text gives. */
static void compare_with_text(struct world *w, const mxg_document *document)
{
    size_t size;
    const char *xml = mxg_document_xml(document, &size);
    mxg_document *read = NULL;
    mxg_document_parse(w->context, w->library, "shared.mtlx", xml, size, &read);
    REQUIRE_STR(mxg_document_xml(read, NULL), xml);
    compare_renderables(document, read);
    compare_elements(document, read);
    mxg_result *own = NULL, *other = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = "glsl";
    mxg_status status = mxg_generate(w->context, document, &desc, &own);
    REQUIRE_EQ(mxg_generate(w->context, read, &desc, &other), status);
    if (status == MXG_OK)
        REQUIRE_STR(mxg_result_source(own, MXG_STAGE_PIXEL, NULL),
                    mxg_result_source(other, MXG_STAGE_PIXEL, NULL));
    mxg_result_destroy(own);
    mxg_result_destroy(other);
    mxg_document_destroy(read);
}

static void test_sequences(void)
{
    struct world w = open_world();
    for (unsigned seed = 1; seed <= 12; ++seed) {
        unsigned random = seed;
        mxg_document *document = many_materials(&w, 20, seed % 2), *kept = NULL;
        for (int i = 0; i < 40; ++i) {
            mxg_edit *edit;
            mxg_document *next = NULL;
            mxg_edit_create(w.context, w.library, document, NULL, &edit);
            for (unsigned k = next_random(&random) % 4; k > 0; --k)
                make_change(edit, document, &random);
            commit(edit, &next);
            if (!REQUIRE(next))
                break;
            if (i % 5 == 0)
                compare_with_text(&w, next);
            if (i == 10)
                kept = document; /* its successors may end before it */
            else
                mxg_document_destroy(document);
            document = next;
        }
        compare_with_text(&w, document);
        mxg_document_destroy(document);
        compare_with_text(&w, kept);
        mxg_document_destroy(kept);
    }
    close_world(&w);
}

/* ---- Values for a program ---- */

static mxg_document *edited(struct world *w, const mxg_document *from, const char *input,
                            const char *type, const char *value)
{
    mxg_edit *edit;
    mxg_document *next = NULL;
    mxg_edit_create(w->context, w->library, from, NULL, &edit);
    if (value)
        mxg_edit_set_value(edit, edited_at(edit, "S1"), input, type, value);
    else
        mxg_edit_connect_input(edit, edited_at(edit, "S1"), input,
                               mxg_edit_add_element(edit, 0, "constant", "Grey", type), NULL);
    REQUIRE_EQ(mxg_edit_error(edit, NULL, 0), 0);
    commit(edit, &next);
    return next;
}

static mxg_result *generate(struct world *w, const mxg_document *document)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *result = NULL;
    desc.target = "vulkan";
    desc.element = "M1";
    REQUIRE(mxg_generate(w->context, document, &desc, &result) == MXG_OK);
    return result;
}

/* The values of an edited document are those that its generation gives. */
static void test_values(void)
{
    static const char *const edits[][3] = {{"base", "float", "0.125"},
                                           {"coat_color", "color3", "0.1, 0.2, 0.3"},
                                           {"thin_walled", "boolean", "true"}};
    struct world w = open_world();
    mxg_document *document = many_materials(&w, 20, true);
    mxg_result *program = generate(&w, document);
    unsigned char now[2048], expected[2048];
    mxg_block_info block = MXG_INIT(mxg_block_info);
    mxg_result_block(program, MXG_BLOCK_PUBLIC_UNIFORMS, &block);
    size_t size = block.byte_size;
    REQUIRE(size > 0 && size <= sizeof now);
    for (size_t i = 0; i < sizeof edits / sizeof *edits; ++i) {
        mxg_document *next = edited(&w, document, edits[i][0], edits[i][1], edits[i][2]);
        mxg_result *after = generate(&w, next);
        REQUIRE_EQ(mxg_result_change(program, after, NULL, 0, NULL), MXG_CHANGE_VALUES);
        mxg_result_pack_block(after, NULL, MXG_BLOCK_PUBLIC_UNIFORMS, expected, sizeof expected);
        mxg_result_pack_block(program, NULL, MXG_BLOCK_PUBLIC_UNIFORMS, now, sizeof now);
        REQUIRE(memcmp(now, expected, size) != 0);
        REQUIRE_EQ(mxg_result_pack_block(program, next, MXG_BLOCK_PUBLIC_UNIFORMS, now, sizeof now),
                   MXG_OK);
        REQUIRE(memcmp(now, expected, size) == 0);
        mxg_result_destroy(after);
        mxg_document_destroy(next);
    }
    mxg_document *connected = edited(&w, document, "base", "float", NULL);
    memset(now, 7, sizeof now);
    REQUIRE_EQ(
        mxg_result_pack_block(program, connected, MXG_BLOCK_PUBLIC_UNIFORMS, now, sizeof now),
        MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(now[0], 7);
    REQUIRE_EQ(mxg_result_pack_block(program, document, MXG_BLOCK_TEXTURES, now, sizeof now),
               MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_result_pack_block(program, document, MXG_BLOCK_PUBLIC_UNIFORMS, now, size - 1),
               MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_result_pack_block(NULL, document, MXG_BLOCK_PUBLIC_UNIFORMS, now, size),
               MXG_ERROR_ARGUMENT);
    static const char other[] = "<materialx version='1.39'/>";
    mxg_document *empty = parse(&w, other, sizeof other - 1);
    REQUIRE_EQ(mxg_result_pack_block(program, empty, MXG_BLOCK_PUBLIC_UNIFORMS, now, sizeof now),
               MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(mxg_result_pack_block(program, empty, MXG_BLOCK_PRIVATE_UNIFORMS, now, sizeof now),
               MXG_OK);
    mxg_document_destroy(empty);
    mxg_document_destroy(connected);
    mxg_result_destroy(program);
    mxg_document_destroy(document);
    close_world(&w);
}

/* A nodegraph that hands on an input. */
static mxg_document *graph_of(struct world *w, const char *type, const char *root,
                              const char *input)
{
    char text[1024];
    int len = snprintf(text, sizeof text,
                       "<materialx version='1.39' %s><nodegraph name='g'>"
                       "<input name='k' type='%s' %s/><dot name='d' type='%s'>"
                       "<input name='in' type='%s' interfacename='k'/></dot>"
                       "<output name='o' type='%s' nodename='d'/></nodegraph></materialx>",
                       root, type, input, type, type, type);
    return parse(w, text, (size_t)len);
}

/* Packs the values of `after` for the program of `before`; where that works, they are right. */
static void check_pack(struct world *w, mxg_document *before, mxg_document *after,
                       mxg_status status)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    mxg_result *old = NULL, *new = NULL;
    unsigned char now[64], expected[64];
    desc.target = "vulkan";
    desc.element = "g/o";
    REQUIRE_EQ(mxg_generate(w->context, before, &desc, &old), MXG_OK);
    REQUIRE_EQ(mxg_generate(w->context, after, &desc, &new), MXG_OK);
    mxg_block_info block = MXG_INIT(mxg_block_info);
    mxg_result_block(old, MXG_BLOCK_PUBLIC_UNIFORMS, &block);
    REQUIRE(block.byte_size > 0 && block.byte_size <= sizeof now);
    REQUIRE_EQ(mxg_result_pack_block(old, after, MXG_BLOCK_PUBLIC_UNIFORMS, now, sizeof now),
               status);
    if (status == MXG_OK) {
        REQUIRE_EQ(mxg_result_change(old, new, NULL, 0, NULL), MXG_CHANGE_VALUES);
        mxg_result_pack_block(new, NULL, MXG_BLOCK_PUBLIC_UNIFORMS, expected, sizeof expected);
        REQUIRE(memcmp(now, expected, block.byte_size) == 0);
    } else {
        REQUIRE_EQ(mxg_result_change(old, new, NULL, 0, NULL), MXG_CHANGE_SHADER);
    }
    mxg_result_destroy(old);
    mxg_result_destroy(new);
    mxg_document_destroy(before);
    mxg_document_destroy(after);
}

/*
 * A value whose meaning changes needs a generation: the program has its conversion compiled in. One
 * whose meaning stays is packed.
 */
static void test_meanings(void)
{
    static const struct {
        const char *type, *before, *after;
        mxg_status status;
    } rows[] = {
        {"float", "value='1' unit='foot' unittype='distance'",
         "value='2' unit='foot' unittype='distance'", MXG_OK},
        {"float", "value='1' unit='foot' unittype='distance'",
         "value='2' unit='inch' unittype='distance'", MXG_ERROR_DOCUMENT},
        {"float", "value='1' unit='foot' unittype='distance'", "value='2'", MXG_ERROR_DOCUMENT},
        {"float", "value='1'", "value='2' unit='inch' unittype='distance'", MXG_ERROR_DOCUMENT},
        {"color3", "value='1,1,1' colorspace='srgb_texture'",
         "value='.5,1,1' colorspace='srgb_texture'", MXG_OK},
        {"color3", "value='1,1,1' colorspace='srgb_texture'", "value='.5,1,1' colorspace='acescg'",
         MXG_ERROR_DOCUMENT},
        {"color3", "value='1,1,1' colorspace='srgb_texture'", "value='.5,1,1'", MXG_ERROR_DOCUMENT},
        {"color3", "value='1,1,1'", "value='.5,1,1' colorspace='srgb_texture'", MXG_ERROR_DOCUMENT},
        {"color3", "value='1,1,1'", "value='.5,1,1' colorspace='lin_rec709'", MXG_OK},
        {"color3", "value='1,1,1' colorspace='none'", "value='.5,1,1'", MXG_OK},
        {"vector3", "value='1,1,1'", "value='.5,1,1' colorspace='acescg'", MXG_OK},
        {"vector3", "value='1,1,1'", "defaultgeomprop='Pworld'", MXG_ERROR_DOCUMENT},
        {"vector3", "value='1,1,1'", "value='2,1,1' defaultgeomprop='Pworld'", MXG_ERROR_DOCUMENT},
    };
    struct world w = open_world();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        mxg_document *before = graph_of(&w, rows[i].type, "", rows[i].before),
                     *after = graph_of(&w, rows[i].type, "", rows[i].after);
        check_pack(&w, before, after, rows[i].status);
    }
    check_pack(&w, graph_of(&w, "color3", "", "value='1,1,1'"),
               graph_of(&w, "color3", "colorspace='acescg'", "value='.5,1,1'"), MXG_ERROR_DOCUMENT);
    close_world(&w);
}

/* Without materials, outputs are what can be drawn: one of them goes, and the other stays. */
static void test_outputs(void)
{
    static const char text[] =
        "<materialx version='1.39'><nodegraph name='G'><constant name='a' type='color3'/>"
        "<output name='one' type='color3' nodename='a'/>"
        "<output name='two' type='color3' nodename='a'/></nodegraph>"
        "<constant name='b' type='color3'/><output name='three' type='color3' nodename='b'/>"
        "</materialx>";
    struct world w = open_world();
    mxg_document *document = parse(&w, text, sizeof text - 1), *next = NULL;
    mxg_edit *edit = NULL;
    REQUIRE_EQ(mxg_edit_create(w.context, w.library, document, NULL, &edit), MXG_OK);
    REQUIRE_EQ(mxg_edit_remove_element(edit, edited_at(edit, "G/one")), MXG_OK);
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    compare_with_text(&w, next);
    REQUIRE_EQ(mxg_document_num_renderables(next), 2);
    mxg_document_destroy(next);
    mxg_document_destroy(document);
    close_world(&w);
}

static void change_outputs(mxg_edit *edit, int step)
{
    mxg_element graph = edited_at(edit, "G"), added;
    switch (step) {
    case 0: mxg_edit_remove_element(edit, edited_at(edit, "G/two")); break;
    case 1: mxg_edit_set_attribute(edit, edited_at(edit, "G/one"), "type", "color3"); break;
    case 2:
        mxg_edit_move_element(edit, edited_at(edit, "G/three"), graph, edited_at(edit, "G/a"));
        break;
    case 3:
        added = mxg_edit_add_element(edit, graph, "output", "four", "color3");
        mxg_edit_connect_input(edit, added, NULL, edited_at(edit, "G/d"), NULL);
        mxg_edit_move_element(edit, added, graph, edited_at(edit, "G/three"));
        break;
    case 4: mxg_edit_set_attribute(edit, edited_at(edit, "G/four"), "type", "float"); break;
    case 5: mxg_edit_set_attribute(edit, edited_at(edit, "G/four"), "type", "color3"); break;
    case 6: mxg_edit_remove_element(edit, edited_at(edit, "G/four")); break;
    case 7: mxg_edit_remove_element(edit, edited_at(edit, "G/three")); break;
    case 8: mxg_edit_set_attribute(edit, edited_at(edit, "S1"), "uiname", "x"); break;
    default: mxg_edit_remove_element(edit, edited_at(edit, "G/one"));
    }
    REQUIRE_EQ(mxg_edit_error(edit, NULL, 0), 0);
}

/* A port that names none of a graph's outputs has the first one of its type, also after edits. */
static void test_assumed_outputs(void)
{
    static const char text[] =
        "<materialx version='1.39'><nodegraph name='G'>"
        "<position name='a' type='vector3'/><normal name='b' type='vector3'/>"
        "<tangent name='c' type='vector3'/><bitangent name='d' type='vector3'/>"
        "<output name='one' type='vector3' nodename='a'/>"
        "<convert name='e' type='color3'><input name='in' type='vector3' nodename='b'/></convert>"
        "<convert name='f' type='color3'><input name='in' type='vector3' nodename='c'/></convert>"
        "<output name='two' type='color3' nodename='e'/>"
        "<output name='three' type='color3' nodename='f'/></nodegraph>"
        "<standard_surface name='S1' type='surfaceshader'><input name='base_color' type='color3' "
        "nodegraph='G'/></standard_surface><surfacematerial name='M1' type='material'><input "
        "name='surfaceshader' type='surfaceshader' nodename='S1'/></surfacematerial></materialx>";
    struct world w = open_world();
    mxg_document *document = parse(&w, text, sizeof text - 1);
    for (int step = 0; step < 10; ++step) {
        mxg_edit *edit = NULL;
        mxg_document *next = NULL;
        REQUIRE_EQ(mxg_edit_create(w.context, w.library, document, NULL, &edit), MXG_OK);
        change_outputs(edit, step);
        REQUIRE_EQ(commit(edit, &next), MXG_OK);
        compare_with_text(&w, next);
        mxg_document_destroy(document);
        document = next;
    }
    mxg_document_destroy(document);
    close_world(&w);
}

int main(void)
{
    test_outputs();
    test_assumed_outputs();
    test_values();
    test_meanings();
    test_memory();
    test_series();
    test_slider();
    test_sequences();
    return test_report("api-edit_shared");
}
