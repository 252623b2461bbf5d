// SPDX-License-Identifier: Apache-2.0
/*
 * bench-edit [MATERIALS [EDITS [KIND]]]: microseconds and bytes per edit, from mxg_edit_create to
 * the next document, in a document of so many materials (2,000: 5 MB). Each edit begins with the
 * document that the last one made, and changes another material.
 */
#define _POSIX_C_SOURCE 200809L
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char *const kinds[] = {"value", "input", "node",    "material", "connection",
                                    "name",  "graph", "removal", "move",     "copy"};
enum { NUM_KINDS = sizeof kinds / sizeof *kinds };

static size_t used;

static void *count_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    (void)user_data;
    used += new_size - old_size;
    if (new_size)
        return realloc(block, new_size);
    free(block);
    return NULL;
}

/* A material as an application writes it: a shader with all its inputs, and a graph. */
static size_t add_material(char *text, unsigned i)
{
    size_t len = (size_t)sprintf(text, "<nodegraph name='G%u'>", i);
    for (unsigned k = 0; k < 6; k++)
        len += (size_t)sprintf(
            text + len,
            "<mix name='mix%u' type='color3'><input name='fg' type='color3' value='0.1, 0.2, 0.3'/>"
            "<input name='bg' type='color3' %s='%s%u'/><input name='mix' type='float' "
            "value='0.5'/></mix>",
            k, k ? "nodename" : "value", k ? "mix" : "0, 0, ", k ? k - 1 : i % 10);
    len += (size_t)sprintf(text + len,
                           "<output name='out' type='color3' nodename='mix5'/></nodegraph>"
                           "<standard_surface name='S%u' type='surfaceshader'>",
                           i);
    static const char *const inputs[] = {
        "base",  "metalness", "specular",     "specular_roughness",  "coat",
        "sheen", "emission",  "transmission", "thin_film_thickness", "subsurface"};
    for (size_t k = 0; k < sizeof inputs / sizeof *inputs; k++)
        len += (size_t)sprintf(text + len, "<input name='%s' type='float' value='0.%u'/>",
                               inputs[k], (i + (unsigned)k) % 97);
    return len
           + (size_t)sprintf(text + len,
                             "<input name='base_color' type='color3' nodegraph='G%u' output='out'/>"
                             "</standard_surface><surfacematerial name='M%u' type='material'>"
                             "<input name='surfaceshader' type='surfaceshader' nodename='S%u'/>"
                             "</surfacematerial>",
                             i, i, i);
}

static mxg_document *many_materials(mxg_context *context, mxg_library *library, unsigned count)
{
    char *text = malloc((size_t)count * 4096 + 100);
    mxg_document *document = NULL;
    if (!text)
        exit(1);
    size_t len = (size_t)sprintf(text, "<materialx version='1.39'>");
    for (unsigned i = 0; i < count; i++)
        len += add_material(text + len, i);
    len += (size_t)sprintf(text + len, "</materialx>");
    if (mxg_document_parse(context, library, "many.mtlx", text, len, &document) != MXG_OK)
        exit(1);
    printf("%u materials, %.1f MB\n", count, (double)len / 1e6);
    free(text);
    return document;
}

static void change(mxg_edit *edit, const mxg_document *from, unsigned kind, unsigned i,
                   unsigned count)
{
    char name[32], shader_name[32], graph_name[32], new_name[32];
    unsigned at = i * 7919u % count;
    const float value = 0.001f * (float)(i % 1000);
    snprintf(name, sizeof name, "M%u", at);
    snprintf(shader_name, sizeof shader_name, "S%u", at);
    snprintf(graph_name, sizeof graph_name, "G%u", at);
    snprintf(new_name, sizeof new_name, "New%u", i);
    mxg_element shader = mxg_edit_find_element(edit, 0, shader_name),
                graph = mxg_edit_find_element(edit, 0, graph_name),
                material = mxg_edit_find_element(edit, 0, name), made;
    switch (kind) {
    case 0: mxg_edit_set_numbers(edit, shader, "base", NULL, &value, 1); break;
    case 1: mxg_edit_set_numbers(edit, shader, "coat_roughness", "float", &value, 1); break;
    case 2: mxg_edit_add_element(edit, 0, "constant", new_name, "float"); break;
    case 3:
        made = mxg_edit_add_element(edit, 0, "surfacematerial", new_name, "material");
        mxg_edit_connect_input(edit, made, "surfaceshader", shader, NULL);
        break;
    case 4:
        made = mxg_edit_add_element(edit, 0, "constant", new_name, "float");
        mxg_edit_connect_input(edit, shader, "base", made, NULL);
        break;
    case 5: mxg_edit_rename_element(edit, i % 2 ? material : shader, new_name); break;
    case 6: mxg_edit_rename_element(edit, graph, new_name); break;
    case 7: mxg_edit_remove_element(edit, mxg_edit_find_element(edit, shader, "coat")); break;
    case 8: mxg_edit_move_element(edit, graph, 0, i % 2 ? shader : 0); break;
    default:
        mxg_edit_copy_element(edit, 0, from, mxg_document_find_element(from, 0, shader_name),
                              new_name);
    }
    char reason[256];
    if (mxg_edit_error(edit, reason, sizeof reason)) {
        fprintf(stderr, "%s: %s\n", kinds[kind], reason);
        exit(1);
    }
}

static double microseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e6 + (double)now.tv_nsec * 1e-3;
}

static void measure(mxg_context *context, mxg_library *library, const mxg_document *from,
                    unsigned kind, unsigned edits, unsigned count)
{
    mxg_document *document = NULL;
    size_t before = used, most = 0;
    double total = 0, longest = 0;
    for (unsigned i = 0; i < edits; i++) {
        mxg_edit *edit;
        mxg_document *next;
        double start = microseconds();
        mxg_edit_create(context, library, document ? document : from, NULL, &edit);
        change(edit, document ? document : from, kind, i, count);
        if (mxg_edit_commit(edit, &next) != MXG_OK)
            exit(1);
        mxg_edit_destroy(edit);
        mxg_document_destroy(document);
        document = next;
        double time = microseconds() - start;
        total += time;
        longest = time > longest ? time : longest;
        most = used - before > most ? used - before : most;
    }
    printf("%-10s %9.1f us mean, %9.1f us at most; %8zu bytes at most\n", kinds[kind],
           total / edits, longest, most);
    mxg_document_destroy(document);
}

int main(int argc, char **argv)
{
    unsigned count = argc > 1 ? (unsigned)atoi(argv[1]) : 2000,
             edits = argc > 2 ? (unsigned)atoi(argv[2]) : 400;
    mxg_context *context;
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.realloc = count_realloc;
    if (count < edits || mxg_context_create(&desc, &context) != MXG_OK)
        return 1;
    mxg_library *library = mxg_library_builtin(context);
    mxg_document *document = many_materials(context, library, count);
    for (unsigned kind = 0; kind < NUM_KINDS; kind++)
        if (argc <= 3 || strcmp(argv[3], kinds[kind]) == 0)
            measure(context, library, document, kind, edits, count);
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    return 0;
}
