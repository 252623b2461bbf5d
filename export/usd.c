// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "export/usd.h"

#include "export/zip.h"
#include "program/files.h"
#include "program/memory.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* ---- Text ---- */

static void indent(struct usd *usd)
{
    enum { SPACES = 4 };
    fprintf(usd->out, "%*s", (int)usd->depth * SPACES, "");
}

void usd_put(struct usd *usd, const char *format, ...)
{
    va_list arguments;
    indent(usd);
    va_start(arguments, format);
    vfprintf(usd->out, format, arguments);
    va_end(arguments);
    fputc('\n', usd->out);
}

void usd_open(struct usd *usd, const char *type, const char *name)
{
    usd_put(usd, "def %s \"%s\"", type, name);
    usd_put(usd, "{");
    ++usd->depth;
}

void usd_close(struct usd *usd)
{
    --usd->depth;
    usd_put(usd, "}");
}

void usd_put_numbers(struct usd *usd, const float *values, unsigned num)
{
    for (unsigned i = 0; i < num; ++i)
        fprintf(usd->out, "%s%.7g", i ? ", " : num > 1 ? "(" : "", (double)values[i]);
    fputs(num > 1 ? ")" : "", usd->out);
}

char *usd_name(struct name_table *names, const char *wanted)
{
    const char *start = isdigit((unsigned char)*wanted) || !*wanted ? "_" : "";
    char *base = cli_format("%s%s", start, wanted);
    for (char *c = base; *c; ++c)
        *c = isalnum((unsigned char)*c) && (unsigned char)*c < 128 ? *c : '_';
    char *name = cli_format("%s", base);
    bool is_new;
    names_add(names, name, &is_new);
    for (unsigned number = 2; !is_new; ++number) {
        free(name);
        name = cli_format("%s_%u", base, number);
        names_add(names, name, &is_new);
    }
    free(base);
    return name;
}

char *usd_quote(const char *text)
{
    char *out = memory_alloc(4 * strlen(text) + 3), *at = out;
    *at++ = '"';
    for (; *text; ++text) {
        unsigned char byte = (unsigned char)*text;
        if (byte == '"' || byte == '\\')
            *at++ = '\\';
        if (byte < ' ' || byte == 127)
            at += snprintf(at, 5, "\\x%02x", byte);
        else
            *at++ = *text;
    }
    *at = '"';
    return out;
}

char *usd_asset(const char *path)
{
    const char *mark = strchr(path, '@') ? "@@@" : "@";
    bool is_plain = *path && !strchr("./", *path);
    return cli_format("%s%s%s%s", mark, is_plain ? "./" : "", path, mark);
}

/* ---- Files ---- */

const struct usd_file *usd_find_file(const struct usd *usd, const char *key)
{
    for (size_t i = 0; i < usd->num_files; ++i)
        if (strcmp(usd->files[i].key, key) == 0)
            return &usd->files[i];
    return NULL;
}

static bool is_taken(const struct usd *usd, const char *name)
{
    for (size_t i = 0; i < usd->num_files; ++i)
        if (strcmp(usd->files[i].name, name) == 0)
            return true;
    return false;
}

const struct usd_file *usd_add_file(struct usd *usd, const char *key, const char *name, void *data,
                                    size_t size)
{
    char *stem = usd->is_package ? cli_format("%s", "") : write_stem(usd->writing),
         *whole = cli_format("%s%s%s", stem, *stem ? "_" : "", name);
    for (unsigned number = 2; is_taken(usd, whole); ++number) {
        free(whole);
        whole = cli_format("%s%s%u_%s", stem, *stem ? "_" : "", number, name);
    }
    free(stem);
    MEMORY_PUSH(usd->files, usd->num_files,
                (struct usd_file){cli_format("%s", key), whole, data, size});
    return &usd->files[usd->num_files - 1];
}

static bool write_files(const struct usd *usd, const char *text, size_t size)
{
    bool good = true;
    for (size_t i = 0; good && i < usd->num_files; ++i)
        good =
            write_beside(usd->writing, usd->files[i].name, usd->files[i].data, usd->files[i].size);
    return good && write_beside(usd->writing, files_base_name(usd->writing->path), text, size);
}

/* The first file of a package is its stage. */
static bool write_archive(const struct usd *usd, const char *text, size_t size)
{
    struct zip zip = {0};
    char *stem = write_stem(usd->writing), *name = cli_format("%s.usda", stem);
    bool good = zip_add(&zip, name, text, size);
    for (size_t i = 0; good && i < usd->num_files; ++i)
        good = zip_add(&zip, usd->files[i].name, usd->files[i].data, usd->files[i].size);
    good = good && zip_end(&zip);
    if (!good)
        report_error(&usd->writing->cli->report, "output-failed",
                     "cannot write '%s': a .usdz has less than 4 GiB; write a .usda",
                     usd->writing->path);
    good = good
           && write_beside(usd->writing, files_base_name(usd->writing->path), zip.files.data,
                           zip.files.size);
    zip_finish(&zip);
    free(stem);
    free(name);
    return good;
}

/* ---- The stage ---- */

static bool put_material(struct usd *usd, const struct flat_material *material, const char *path)
{
    struct name_table names = {0};
    usd_open(usd, "Material", strrchr(path, '/') + 1);
    bool good = usd_put_preview(usd, material, path, &names);
    if (good)
        usd_put_network(usd, material, path, &names);
    usd_close(usd);
    names_finish(&names);
    return good;
}

static bool put_stage(struct usd *usd)
{
    const size_t num = usd->flat->num_materials;
    struct name_table names = {0}, roots = {0};
    char *stem = write_stem(usd->writing), *root = usd_name(&roots, stem),
         **paths = memory_alloc((num + 1) * sizeof *paths);
    bool good = true;
    fprintf(usd->out,
            "#usda 1.0\n(\n    defaultPrim = \"%s\"\n    doc = \"mxgen %s\"\n"
            "    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n",
            root, mxg_version_string());
    usd_open(usd, "Xform", root);
    usd_open(usd, "Scope", "Materials");
    for (size_t i = 0; good && i < num; ++i) {
        char *name = usd_name(&names, usd->flat->materials[i].name);
        paths[i] = cli_format("/%s/Materials/%s", root, name);
        free(name);
        good = put_material(usd, &usd->flat->materials[i], paths[i]);
    }
    usd_close(usd);
    if (good)
        usd_put_objects(usd, paths);
    usd_close(usd);
    for (size_t i = 0; i < num; ++i)
        free(paths[i]);
    free(paths);
    free(root);
    free(stem);
    names_finish(&names);
    names_finish(&roots);
    return good;
}

static bool write_stage(struct writing *writing, const struct flat *flat, bool is_package)
{
    char *text = NULL;
    size_t size = 0;
    struct usd usd = {.flat = flat,
                      .writing = writing,
                      .is_package = is_package,
                      .out = open_memstream(&text, &size)};
    if (!usd.out)
        memory_fail();
    bool good = put_stage(&usd);
    if (fclose(usd.out) != 0)
        memory_fail();
    good = good && (is_package ? write_archive(&usd, text, size) : write_files(&usd, text, size));
    for (size_t i = 0; i < usd.num_files; ++i) {
        free(usd.files[i].key);
        free(usd.files[i].name);
        free(usd.files[i].data);
    }
    free(usd.files);
    free(text);
    return good;
}

bool usd_write(struct writing *writing, const struct flat *flat)
{
    return write_stage(writing, flat, false);
}

bool usd_write_package(struct writing *writing, const struct flat *flat)
{
    return write_stage(writing, flat, true);
}
