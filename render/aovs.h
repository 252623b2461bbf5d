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
bool aovs_is_whole(const char *type);
/* True for BSDFs, whose light needs a whole path. */
bool aovs_is_scattered(const struct picture_aov *aov);
/* True for up to three numbers, behind which the alpha stands. */
bool aovs_has_alpha(const struct picture_aov *aov);
/* The outputs of an AOV in a shader: its value; for path tracers also the light of a BSDF. */
enum aovs_output { AOVS_VALUE, AOVS_WEIGHT, AOVS_RESPONSE, AOVS_LIGHT };
/* The variable of a shader with an output of an AOV; false: it has none. */
bool aovs_find(const struct picture_aov *aov, const mxg_result *result, enum aovs_output which,
               mxg_variable *out);

/* The values that a path tracer keeps of a BSDF at the first hit. */
#define AOVS_SCATTERED 3
/* aovs may be NULL: none. */
size_t aovs_num(const struct aovs *aovs);
/* Those that are BSDFs. */
size_t aovs_num_scattered(const struct aovs *aovs);
/* The values of a pixel: one for each AOV, then AOVS_SCATTERED for each BSDF. */
size_t aovs_stride(const struct aovs *aovs);

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
