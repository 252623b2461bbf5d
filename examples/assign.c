// SPDX-License-Identifier: Apache-2.0
/*
 * A tree of primitives in an application calls these functions while an artist assigns materials:
 * the layers of a scene are found once, and after each change only those that it touches. Argument:
 * the number of primitives (100000).
 */
#include <mxgen/mxgen.h>
#include <mxgen/document.h>
#include <mxgen/scene.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char document_text[] =
    "<materialx version='1.39'>"
    "<standard_surface name='SR' type='surfaceshader'/>"
    "<surfacematerial name='Paint' type='material'>"
    "<input name='surfaceshader' type='surfaceshader' nodename='SR'/></surfacematerial>"
    "<surfacematerial name='Dust' type='material'>"
    "<input name='surfaceshader' type='surfaceshader' nodename='SR'/></surfacematerial>"
    "<look name='day'>"
    "<materialassign name='all' material='Paint' geom='/'/>"
    "<materialassign name='dusty' slot='050' material='Dust' geom='//shelf_*/item_*7'/>"
    "</look></materialx>";

struct shop {
    mxg_context *context;
    mxg_document *document;
    mxg_scene *scene;
    mxg_bindings *bindings;
    double milliseconds; /* of the last search */
};

/* Halls of a hundred shelves, each of a hundred items; one primitive in each call. */
struct stock {
    unsigned num, count;
    char name[64];
};

static bool next_item(void *user_data, uint32_t last, mxg_primitive *out)
{
    struct stock *stock = user_data;
    unsigned i = stock->num++;
    (void)last;
    snprintf(stock->name, sizeof stock->name, "hall_%u/shelf_%u/item_%u", i / 10000, i / 100 % 100,
             i % 100);
    *out = (mxg_primitive){sizeof *out, .parent = MXG_NONE, .name = stock->name, .type = "Mesh"};
    out->name_len = strlen(out->name);
    out->type_len = strlen(out->type);
    return i < stock->count;
}

/* Finds the layers again; those of before say which have not changed. */
static bool find_layers(struct shop *shop)
{
    mxg_bindings_desc desc = MXG_BINDINGS_DESC_INIT;
    mxg_bindings *bindings = NULL;
    struct timespec begin, end;
    desc.previous = shop->bindings;
    timespec_get(&begin, TIME_UTC);
    mxg_status status =
        mxg_bindings_create(shop->context, shop->document, shop->scene, &desc, &bindings);
    timespec_get(&end, TIME_UTC);
    shop->milliseconds =
        (double)(end.tv_sec - begin.tv_sec) * 1e3 + (double)(end.tv_nsec - begin.tv_nsec) * 1e-6;
    mxg_bindings_destroy(shop->bindings);
    shop->bindings = bindings;
    return status == MXG_OK;
}

/* A line of the tree: the layers of a primitive, base first, and the work that they took. */
static void show(const struct shop *shop, const char *change, const char *path)
{
    uint32_t primitive = mxg_scene_find_primitive(shop->scene, path);
    printf("%-28s %s", change, path);
    for (uint32_t i = 0; i < mxg_bindings_num_layers(shop->bindings, primitive); i++) {
        mxg_layer layer = {.size = sizeof layer};
        mxg_bindings_layer(shop->bindings, primitive, i, &layer);
        printf(" [%s %s]", layer.slot, layer.material);
    }
    printf(", %u primitives\n", mxg_bindings_num_resolved_primitives(shop->bindings));
    fprintf(stderr, "%-28s %.2f ms\n", change, shop->milliseconds);
}

/* For a material that is dropped on a line of the tree; NULL: takes the artist's binding away. */
static bool assign(struct shop *shop, const char *path, const char *slot, const char *material)
{
    uint32_t primitive = mxg_scene_find_primitive(shop->scene, path);
    mxg_status status = material ? mxg_scene_set_binding(shop->scene, primitive, slot, material)
                                 : mxg_scene_remove_binding(shop->scene, primitive, slot);
    return status == MXG_OK && find_layers(shop);
}

static bool work(struct shop *shop, unsigned count)
{
    static const char item[] = "/hall_0/shelf_12/item_17", shelf[] = "/hall_0/shelf_12";
    struct stock stock = {.count = count};
    if (mxg_scene_add_primitives(shop->scene, next_item, &stock) != MXG_OK || !find_layers(shop))
        return false;
    show(shop, "the scene", item);
    if (!assign(shop, item, "100", "Paint"))
        return false;
    show(shop, "a layer on an item", item);
    if (!assign(shop, item, "000", ""))
        return false;
    show(shop, "no paint below it", item);
    if (!assign(shop, shelf, "070", "Dust"))
        return false;
    show(shop, "a layer on a shelf", item);
    if (!assign(shop, shelf, "070", "Paint"))
        return false;
    show(shop, "another material there", item);
    if (!assign(shop, item, "000", NULL))
        return false;
    show(shop, "the paint again", item);
    return true;
}

int main(int argc, char **argv)
{
    struct shop shop = {0};
    unsigned count = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : 100000;
    if (mxg_context_create(NULL, &shop.context) != MXG_OK)
        return 1;
    mxg_library *library = mxg_library_builtin(shop.context);
    bool good = mxg_document_parse(shop.context, library, "shop.mtlx", document_text,
                                   strlen(document_text), &shop.document)
                    == MXG_OK
                && mxg_scene_create(shop.context, &shop.scene) == MXG_OK && work(&shop, count);
    mxg_bindings_destroy(shop.bindings);
    mxg_scene_destroy(shop.scene);
    mxg_document_destroy(shop.document);
    mxg_library_unref(library);
    mxg_context_destroy(shop.context);
    return good ? 0 : 1;
}
