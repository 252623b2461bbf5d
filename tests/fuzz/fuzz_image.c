// SPDX-License-Identifier: Apache-2.0
/*
 * Damage to a library image: each four bytes of the input change one byte of it, an odd rest cuts
 * it off. A damaged image is refused; the whole one is not.
 */
#include "files.h"

#include <string.h>

static const char library_text[] =
    "<materialx version='1.39'><nodedef name='ND_thrice' node='thrice'><input name='in' "
    "type='float' value='1.0'/>"
    "<output name='out' type='float'/></nodedef>"
    "<implementation name='IM_thrice' nodedef='ND_thrice' sourcecode='{{in}} * 3.0'/>"
    "<nodedef name='ND_wave' node='wave'><input name='in' type='color3' value='0.1, 0.2, "
    "0.3'/><output name='out' type='color3'/></nodedef>"
    "<implementation name='IM_wave' nodedef='ND_wave' file='wave.glsl' function='wave'/>"
    "<nodedef name='ND_both' node='both'><input name='in' type='float' value='1.0'/><output "
    "name='out' type='float'/></nodedef>"
    "<nodegraph name='NG_both' nodedef='ND_both'><thrice name='a' type='float'><input name='in' "
    "type='float' interfacename='in'/>"
    "</thrice><output name='out' type='float' nodename='a'/></nodegraph></materialx>"
    "\n== wave.glsl\nconst vec3 PHASE = vec3(0.0, 0.25, 0.5);\nvec3 wave(vec3 x) { return sin(x + "
    "PHASE); }\n";

static const char *image;
static size_t image_size;

static void pack(void)
{
    static const char *const paths[] = {"main.mtlx"};
    struct fuzz_files files;
    fuzz_files_split(&files, library_text, sizeof library_text - 1);
    mxg_context *context = fuzz_files_context(&files, NULL, (mxg_context_desc){0});
    mxg_library *library;
    const void *data;
    FUZZ_REQUIRE(context);
    FUZZ_REQUIRE(mxg_library_load(context, NULL, paths, 1, &library) == MXG_OK);
    FUZZ_REQUIRE(mxg_library_image(library, &data, &image_size) == MXG_OK);
    char *copy = malloc(image_size);
    FUZZ_REQUIRE(copy);
    image = memcpy(copy, data, image_size);
    mxg_library_unref(library);
    mxg_context_destroy(context);
}

/* The image after the damage; its size is told. */
static char *damaged(const unsigned char *data, size_t size, size_t *out_size)
{
    char *copy = malloc(image_size);
    FUZZ_REQUIRE(copy);
    memcpy(copy, image, image_size);
    for (; size >= 4; data += 4, size -= 4)
        copy[((size_t)data[0] << 16 | (size_t)data[1] << 8 | data[2]) % image_size] ^=
            (char)data[3];
    size_t cut = size ? data[0] : 0;
    *out_size = image_size - (cut < image_size ? cut : image_size);
    return copy;
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    static const char *const paths[] = {"image.mxlib"};
    if (!image)
        pack();
    size_t left;
    char *copy = damaged((const unsigned char *)data, size, &left);
    struct fuzz_files files = {.num = 1, .items = {{"image.mxlib", copy, left}}};
    mxg_context *context = fuzz_files_context(&files, heap, (mxg_context_desc){0});
    mxg_library *library = NULL;
    if (context) {
        bool is_whole = left == image_size && memcmp(copy, image, left) == 0;
        mxg_status status = mxg_library_load(context, NULL, paths, 1, &library);
        FUZZ_REQUIRE(status == (is_whole ? MXG_OK : MXG_ERROR_DOCUMENT)
                     || (status == MXG_ERROR_MEMORY && heap->fail_at));
        mxg_library_unref(library);
        mxg_context_destroy(context);
    }
    free(copy);
}
