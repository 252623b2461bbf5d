// SPDX-License-Identifier: Apache-2.0
#define _POSIX_C_SOURCE 200809L
#include "program/plugin.h"

#include "program/cli.h"
#include "program/memory.h"

#include <assert.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

typedef const mxg_plugin *entry_fn(void);

/* POSIX lets dlsym return functions, ISO C does not convert pointers to them. */
static entry_fn *find_entry(void *handle)
{
    entry_fn *entry = NULL;
    void *symbol = dlsym(handle, "mxgen_plugin");
    static_assert(sizeof symbol == sizeof entry, "pointers of one size");
    memcpy(&entry, &symbol, sizeof entry);
    return entry;
}

static bool refuse(const char *file, const char *reason)
{
    fprintf(stderr, "mxgen: cannot load the plug-in '%s': %s\n", file, reason);
    return false;
}

/* "nodes.mtlx" beside "lib/studio.so" is "lib/nodes.mtlx". */
static char *beside(const char *file, const char *name)
{
    const char *slash = strrchr(file, '/');
    int len = slash && *name != '/' ? (int)(slash - file + 1) : 0;
    return cli_format("%.*s%s", len, file, name);
}

static void take(struct plugins *plugins, const char *file, const mxg_plugin *plugin)
{
    for (size_t i = 0; i < plugin->num_nodes; ++i)
        MEMORY_PUSH(plugins->codes, plugins->num_codes, plugin->nodes[i]);
    for (size_t i = 0; i < plugin->num_dialects; ++i)
        MEMORY_PUSH(plugins->dialects, plugins->num_dialects, plugin->dialects[i]);
    for (size_t i = 0; i < plugin->num_libraries; ++i)
        args_append(&plugins->libraries, beside(file, plugin->libraries[i]));
}

static bool load(struct plugins *plugins, const char *file)
{
    /* without a '/', dlopen would search the folders of the system */
    char *path = cli_format("%s%s", strchr(file, '/') ? "" : "./", file);
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    free(path);
    if (!handle)
        return refuse(file, dlerror());
    MEMORY_PUSH(plugins->handles, plugins->num_handles, handle);
    entry_fn *entry = find_entry(handle);
    const mxg_plugin *plugin = entry ? entry() : NULL;
    if (!plugin)
        return refuse(file, entry ? "mxgen_plugin() returns NULL"
                                  : "it has no function mxgen_plugin (mxgen/node.h)");
    if (plugin->version != MXG_PLUGIN_VERSION) {
        char *reason = cli_format("it is for version %u of the interface; this mxgen has %d: "
                                  "compile it again",
                                  plugin->version, MXG_PLUGIN_VERSION);
        refuse(file, reason);
        free(reason);
        return false;
    }
    take(plugins, file, plugin);
    return true;
}

bool plugins_load(struct plugins *plugins, const struct arg_list *files)
{
    bool is_good = true;
    for (size_t i = 0; i < files->len && is_good; ++i)
        is_good = load(plugins, files->items[i]);
    return is_good;
}

void plugins_finish(struct plugins *plugins)
{
    args_free(&plugins->libraries);
    free(plugins->codes);
    free(plugins->dialects);
    for (size_t i = 0; i < plugins->num_handles; ++i)
        dlclose(plugins->handles[i]);
    free(plugins->handles);
    *plugins = (struct plugins){0};
}
