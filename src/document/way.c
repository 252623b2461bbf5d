// SPDX-License-Identifier: Apache-2.0
/*
 * Names of files in includes are relative to the folder of the include. A text that holds the
 * elements of several files gives those names a `fileprefix` that leads there from its own folder.
 */
#include "document/document.h"

static bool is_absolute(const char *name)
{
    return *name == '/' || strstr(name, "://");
}

/* The length of the folder that two files share. */
static size_t shared_folder(const char *from, const char *to)
{
    const char *host = strstr(to, "://");
    size_t shared = 0;
    for (size_t i = 0; from[i] && from[i] == to[i]; i++)
        if (from[i] == '/')
            shared = i + 1;
    return host && shared <= (size_t)(host + 3 - to) ? 0 : shared;
}

/* The way from the folder of a file to that of another one: "../maps/". False: it is unknown. */
static bool write_way(const char *from, const char *to, struct text *out)
{
    size_t shared = shared_folder(from, to);
    const char *slash = strrchr(to, '/');
    bool is_known = shared || (!is_absolute(from) && !is_absolute(to));
    if (is_known && strstr(from + shared, ".."))
        return false;
    for (const char *up = is_known ? from + shared : ""; (up = strchr(up, '/')) != NULL; up++)
        text_str(out, "../");
    if (slash)
        text_mem(out, to + shared, (size_t)(slash + 1 - to) - shared);
    return is_known || is_absolute(to);
}

const char *doc_prefix_from(const struct document *doc, elem_id element, const char *from,
                            struct arena *arena)
{
    const char *to = doc_place(doc, element).file;
    if (!from || !to || doc_attr_value(doc, element, STR_type) != STR_filename)
        return NULL;
    const char *value = str_text(doc->strings, doc_attr_value(doc, element, STR_value)),
               *prefix = str_text(doc->strings, doc_inherited_attr(doc, element, STR_fileprefix));
    struct text way;
    text_init(&way, arena);
    if (!*value || is_absolute(*prefix ? prefix : value) || !write_way(from, to, &way) || !way.len)
        return NULL;
    text_str(&way, prefix);
    return text_cstr(&way);
}
