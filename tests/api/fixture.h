// SPDX-License-Identifier: Apache-2.0
/*
 * What tests of the public interface share: an allocator that counts and fails, files in memory, a
 * document with a bit of everything.
 */
#ifndef MXG_TESTS_API_FIXTURE_H
#define MXG_TESTS_API_FIXTURE_H

#include "tests/unit/test.h"

#include <mxgen/mxgen.h>

#include <stdlib.h>

/* ---- Memory: each block knows its size, so that what mxgen says of it is checked ---- */

struct heap {
    size_t held, peak;
    unsigned calls;   /* that asked for memory */
    unsigned fail_at; /* this one fails, and ... */
    bool fails_from;  /* ... all behind it; 0: none */
    unsigned wrong_sizes;
};

union heap_header {
    size_t size;
    max_align_t align;
};

static inline void *heap_realloc(void *user_data, void *block, size_t old_size, size_t new_size)
{
    struct heap *heap = user_data;
    union heap_header *header = block ? (union heap_header *)block - 1 : NULL;
    heap->wrong_sizes += old_size != (header ? header->size : 0);
    if (new_size && ++heap->calls >= heap->fail_at && heap->fail_at
        && (heap->fails_from || heap->calls == heap->fail_at))
        return NULL;
    heap->held += new_size - old_size;
    heap->peak = heap->held > heap->peak ? heap->held : heap->peak;
    if (new_size == 0) {
        free(header);
        return NULL;
    }
    header = realloc(header, sizeof *header + new_size);
    if (!header)
        abort();
    header->size = new_size;
    return header + 1;
}

/* ---- Edits ---- */

static inline mxg_status commit(mxg_edit *edit, mxg_document **out_document)
{
    mxg_status status = mxg_edit_commit(edit, out_document);
    mxg_edit_destroy(edit);
    return status;
}

/* ---- Files in memory ---- */

struct memory_file {
    const char *name, *text; /* text NULL: it is there but cannot be read */
};

struct memory_files {
    const struct memory_file *files; /* up to one without name */
    unsigned num_open, num_opened, num_released;
    unsigned fail_at; /* this opening fails; 0: none */
};

static inline bool memory_open(void *user_data, const char *from, const char *ref,
                               mxg_blob *out_blob, const char **out_reason)
{
    struct memory_files *files = user_data;
    (void)from;
    if (files->fail_at && --files->fail_at == 0) {
        *out_reason = "this opening fails";
        return false;
    }
    for (const struct memory_file *file = files->files; file->name; file++) {
        if (strcmp(file->name, ref) != 0)
            continue;
        out_blob->name = file->name;
        if (!file->text) {
            *out_reason = "it is locked";
            return false;
        }
        out_blob->data = file->text;
        out_blob->size = strlen(file->text);
        out_blob->handle = files;
        files->num_open++;
        files->num_opened++;
        return true;
    }
    return false;
}

static inline void memory_release(void *user_data, mxg_blob *blob)
{
    struct memory_files *files = user_data;
    if (blob->handle != files || files->num_open == 0)
        abort();
    files->num_open--;
    files->num_released++;
}

static inline mxg_resolver memory_resolver(struct memory_files *files)
{
    return (mxg_resolver){files, memory_open, memory_release, NULL};
}

/* ---- A document: textures, a graph, a definition with source of its own, an include ---- */

static const struct memory_file fixture_files[] = {
    {"main.mtlx",
     "<?xml version=\"1.0\"?>\n"
     "<materialx version=\"1.39\" xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n"
     "  <xi:include href=\"tint.mtlx\"/>\n"
     "  <nodegraph name=\"G\">\n"
     "    <input name=\"scale\" type=\"float\" value=\"2\" uiname=\"Scale\"/>\n"
     "    <image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" "
     "value=\"wood.png\"/></image>\n"
     "    <noise2d name=\"n\" type=\"float\"><input name=\"amplitude\" type=\"float\" "
     "interfacename=\"scale\"/></noise2d>\n"
     "    <tint name=\"t\" type=\"color3\"><input name=\"in\" type=\"color3\" nodename=\"i\"/>"
     "<input name=\"by\" type=\"float\" nodename=\"n\"/></tint>\n"
     "    <output name=\"out\" type=\"color3\" nodename=\"t\"/>\n"
     "  </nodegraph>\n"
     "  <standard_surface name=\"S\" type=\"surfaceshader\">\n"
     "    <input name=\"base_color\" type=\"color3\" nodegraph=\"G\" output=\"out\"/>\n"
     "    <input name=\"coat\" type=\"float\" value=\"0.5\"/>\n"
     "  </standard_surface>\n"
     "  <surfacematerial name=\"M\" type=\"material\">"
     "<input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"S\"/></surfacematerial>\n"
     "</materialx>\n"},
    {"tint.mtlx", "<materialx version=\"1.39\">\n"
                  "  <nodedef name=\"ND_tint\" node=\"tint\"><input name=\"in\" type=\"color3\" "
                  "value=\"1, 1, 1\"/>"
                  "<input name=\"by\" type=\"float\" value=\"1\"/><output name=\"out\" "
                  "type=\"color3\"/></nodedef>\n"
                  "  <implementation name=\"IM_tint\" nodedef=\"ND_tint\" file=\"tint.glsl\" "
                  "function=\"tint\"/>\n"
                  "</materialx>\n"},
    {"tint.glsl", "#include \"curve.glsl\"\nvoid tint(vec3 color, float by, out vec3 result) { "
                  "result = curve(color * by); }\n"},
    {"curve.glsl", "vec3 curve(vec3 x) { return x * x * (3.0 - 2.0 * x); }\n"},
    {"model.mtlx", /* a library that stands alone, with a shading model */
     "<materialx version=\"1.39\">\n"
     "  <nodedef name=\"ND_lobe\" node=\"lobe\"><input name=\"weight\" type=\"float\" value=\"1\"/>"
     "<input name=\"color\" type=\"color3\" value=\"0.5, 0.5, 0.5\"/><output name=\"out\" "
     "type=\"BSDF\"/></nodedef>\n"
     "  <implementation name=\"IM_lobe\" nodedef=\"ND_lobe\" file=\"lobe.glsl\" "
     "function=\"lobe\"/>\n"
     "  <nodedef name=\"ND_surface\" node=\"surface\"><input name=\"bsdf\" type=\"BSDF\" "
     "value=\"\"/>"
     "<input name=\"edf\" type=\"EDF\" value=\"\"/><input name=\"opacity\" type=\"float\" "
     "value=\"1\"/>"
     "<input name=\"thin_walled\" type=\"boolean\" value=\"false\"/><output name=\"out\" "
     "type=\"surfaceshader\"/></nodedef>\n"
     "  <implementation name=\"IM_surface\" nodedef=\"ND_surface\"/>\n"
     "  <nodedef name=\"ND_model\" node=\"model\"><input name=\"color\" type=\"color3\" value=\"1, "
     "0, 0\"/>"
     "<output name=\"out\" type=\"surfaceshader\"/></nodedef>\n"
     "  <nodegraph name=\"NG_model\" nodedef=\"ND_model\">"
     "<lobe name=\"l\" type=\"BSDF\"><input name=\"color\" type=\"color3\" "
     "interfacename=\"color\"/></lobe>"
     "<surface name=\"s\" type=\"surfaceshader\"><input name=\"bsdf\" type=\"BSDF\" "
     "nodename=\"l\"/></surface>"
     "<output name=\"out\" type=\"surfaceshader\" nodename=\"s\"/></nodegraph>\n"
     "</materialx>\n"},
    {"lobe.glsl",
     "vec3 lobe_environment(vec3 color, vec3 V) { return color * (V * 0.5 + 0.5); }\n"},
    {NULL, NULL},
};

static inline bool has_diagnostic(const mxg_diagnostics *list, const char *id)
{
    for (uint32_t i = 0; i < mxg_diagnostics_num_items(list); i++) {
        mxg_diagnostic diagnostic = {sizeof diagnostic};
        if (mxg_diagnostics_item(list, i, &diagnostic) == MXG_OK && strcmp(diagnostic.id, id) == 0)
            return true;
    }
    return false;
}

#endif
