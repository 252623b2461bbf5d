// SPDX-License-Identifier: Apache-2.0
/* The AOVs of a picture, which become further channels of its EXR file. */
#ifndef MXG_RENDER_AOVS_H
#define MXG_RENDER_AOVS_H

#include "render/image.h"

#include <mxgen/mxgen.h>

struct picture_aov {
    char *name, *type; /* of the document: "dirt", "color3" */
    float *pixels;     /* RGBA of the picture, top row first; NULL before it is drawn */
};

struct aovs {
    struct picture_aov *items;
    size_t len;
};

/* Adds the AOVs of a shader that the list lacks. */
void aovs_add(struct aovs *aovs, const mxg_result *result);
/* True for integers and booleans, which have no mean. */
bool aovs_is_whole(const struct picture_aov *aov);
/* True for up to three numbers, behind which the alpha stands. */
bool aovs_has_alpha(const struct picture_aov *aov);
/* The variable of a shader with an AOV; false: it has none. */
bool aovs_find(const struct picture_aov *aov, const mxg_result *result, mxg_variable *out);
/* Makes generation give all shaders these AOVs, in this order. */
void aovs_list(const struct aovs *aovs, size_t first, size_t count, mxg_options *options);
void aovs_finish(struct aovs *aovs);

/* The channels of all AOVs, "dirt.R"; free with aovs_finish_planes. */
struct image_plane *aovs_planes(const struct aovs *aovs, uint32_t *out_count);
void aovs_finish_planes(struct image_plane *planes, uint32_t count);

/*
 * Replaces a picture by one of the slots: colours by slot, either blended by weight or that of the
 * greatest weight. The AOVs are those of the option `mattes`. Writes "000 #cc3333" per slot to
 * `legend`, which may be NULL.
 */
void aovs_show(const struct aovs *aovs, bool blends, struct image *picture,
               void (*legend)(void *user_data, const char *slot, const unsigned char color[3]),
               void *user_data);

#endif
