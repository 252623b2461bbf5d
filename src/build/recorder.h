// SPDX-License-Identifier: Apache-2.0
/* A builder notes a network in these records. */
#ifndef MXG_BUILD_RECORDER_H
#define MXG_BUILD_RECORDER_H

#include "build/build_priv.h"

struct recorder {
    struct network *network;
    bool (*fits_family)(const char *family, const uint32_t *functions); /* target_network */
    struct name_set names;                                              /* of layers */
    uint32_t *layer_of; /* by variable of the shader: the layer with this output, + 1 */
    uint32_t num_layers_of;
    VEC(uint8_t) output_of; /* by variable of the shader: the output of the layer */
    ir_ref *source_of;      /* by node: the layer's output that stands for it */
    uint32_t num_sources;
    struct network_input *values; /* by variable: of the parameters of a whole shader */
    uint32_t num_values;
    bool is_full;    /* reported: it has too many layers */
    bool is_changed; /* no layer gives the closure of the node at hand */
};

/* The layer that gives a variable of the shader, + 1; 0: none does. */
static inline uint32_t recorder_layer_of(const struct recorder *r, uint32_t variable)
{
    return variable < r->num_layers_of ? r->layer_of[variable] : 0;
}

/*
 * "<UDIM>" for a tiled image, because targets that find tiles themselves read it in another way; 0
 * for another image.
 */
static inline str_id recorder_tiles(struct builder *b, str_id file)
{
    const char *name = build_text(b, file);
    return strstr(name, "<UDIM>") || strstr(name, "<UVTILE>")
               ? str_intern_z(b->shader->strings, "<UDIM>")
               : 0;
}

#endif
