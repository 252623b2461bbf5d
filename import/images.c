// SPDX-License-Identifier: Apache-2.0
/* Images: those inside of the file become files beside the document, others stay where they are. */
#include "import/import.h"

#include "program/file_name.h"
#include "program/files.h"
#include "program/relocate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The ending of an image by its first bytes; NULL: it is of no kind that a texture may be. */
static const char *ending_of(const uint8_t *data, size_t size)
{
    static const struct {
        const char *begin, *ending;
    } kinds[] = {{"\x89PNG", "png"}, {"\xff\xd8\xff", "jpg"}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i)
        if (size > strlen(kinds[i].begin)
            && memcmp(data, kinds[i].begin, strlen(kinds[i].begin)) == 0)
            return kinds[i].ending;
    return NULL;
}

/* Writes the bytes of an image beside the document. NULL after an error or a loss. */
static char *write_image(struct importing *importing, const char *name, const uint8_t *data,
                         size_t size)
{
    const char *ending = data ? ending_of(data, size) : NULL;
    if (!ending) {
        import_tell_loss(importing, name, "%s",
                         data ? "the image is neither PNG nor JPEG"
                              : "the bytes of the image are missing");
        return NULL;
    }
    char *file = cli_format("%s.%s", name, ending);
    if (import_write_file(importing, file, data, size))
        return file;
    free(file);
    return NULL;
}

static bool has_file(void *user_data, const char *name)
{
    const struct importing *importing = user_data;
    char *path = cli_format("%s%s.png", importing->folder, name),
         *other = cli_format("%s%s.jpg", importing->folder, name);
    bool has = outputs_has(&importing->outputs, path) || outputs_has(&importing->outputs, other);
    free(path);
    free(other);
    return has;
}

/* "wood" of an image that has a name, or else "FILE_image3". */
static char *name_of(struct importing *importing, const json_t *image, size_t index)
{
    const char *own = json_text_of(image, "name"), *base = files_base_name(importing->output);
    char *wanted;
    if (*own)
        wanted = cli_format("%s", own);
    else
        wanted = cli_format("%.*s_image%zu", (int)strcspn(base, "."), base, index);
    for (char *at = wanted; *at; ++at)
        *at = *at == '/' || *at == '.' ? '_' : *at;
    char *clean = file_name_clean(wanted),
         *name = import_free_name(importing, "images", clean, has_file, importing);
    free(wanted);
    free(clean);
    return name;
}

static char *find_image(struct importing *importing, const json_t *image, size_t index)
{
    struct gltf_source *source = &importing->source;
    const char *uri = json_text_of(image, "uri"), *fault = NULL;
    char *path = NULL, *name = name_of(importing, image, index), *file = NULL;
    size_t size = 0;
    if (*uri) {
        uint8_t *data = gltf_source_resolve(source, uri, &size, &path, &fault);
        if (path && !files_is_regular(path))
            import_tell_loss(importing, name, "there is no file '%s'", path);
        if (path)
            file = relocate_file(importing->folder, path);
        else if (data)
            file = write_image(importing, name, data, size);
        else
            import_tell_loss(importing, name, "'%s': %s", uri,
                             fault ? fault : "it is no file beside it");
        free(data);
        free(path);
    } else {
        const uint8_t *data = gltf_source_view(source, gltf_index_of(image, "bufferView"), &size);
        file = write_image(importing, name, data, size);
    }
    free(name);
    return file;
}

/* MaterialX replaces "<UDIM>", "{frame}" and "[token]" in names of files. */
static void tell_tokens(struct importing *importing, const char *file)
{
    static const char *const begins[] = {"<UDIM>", "<UVTILE>", "{", "["};
    for (size_t i = 0; i < sizeof begins / sizeof *begins; ++i)
        if (strstr(file, begins[i])) {
            import_tell_loss(importing, file,
                             "MaterialX reads '%s' in a name as a token; rename the file",
                             begins[i]);
            return;
        }
}

const char *import_image(struct importing *importing, size_t index)
{
    if (index >= importing->num_images)
        return NULL;
    struct import_image *image = &importing->images[index];
    if (!image->is_tried)
        image->name =
            find_image(importing, gltf_source_item(&importing->source, "images", index), index);
    if (!image->is_tried && image->name)
        tell_tokens(importing, image->name);
    image->is_tried = true;
    return image->name;
}
