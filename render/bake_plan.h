// SPDX-License-Identifier: Apache-2.0
/*
 * The plan of a new document: the nodes that stay (materials, shaders, closures, normal maps,
 * images without changes), and for each of their inputs whether it stays, too, or must be drawn.
 */
#ifndef MXG_RENDER_BAKE_PLAN_H
#define MXG_RENDER_BAKE_PLAN_H

#include "program/name_table.h"
#include "program/report.h"
#include "render/bake_tiles.h"

#include <mxgen/mxgen.h>

enum bake_way {
    BAKE_KEEPS, /* a value of the document, which stays */
    BAKE_NODE,  /* another node of the plan */
    BAKE_DRAWS  /* a drawing: what a graph gives */
};

struct bake_input {
    mxg_element port; /* the input of the node in the document */
    const char *name, *type;
    enum bake_way way;
    mxg_element origin; /* KEEPS: what has the value */
    char *copy;         /* KEEPS: the name of the copy of its file; NULL: the file stays */
    size_t index;       /* NODE: of the plan's nodes; DRAWS: of its drawings */
};

struct bake_node {
    mxg_element element;
    const char *category, *type;
    char *name;     /* in the new document */
    bool is_output; /* an <output>, whose only input is what it reads */
    struct bake_input *inputs;
    size_t num_inputs;
};

/* The needs that a drawing has of the surface, beside its texture coordinates: bits. */
enum bake_need {
    BAKE_VARIES = 1,   /* it is not the same everywhere */
    BAKE_FRAME = 2,    /* normals and tangents */
    BAKE_GEOMETRY = 4, /* positions, other texture coordinates, properties */
    BAKE_VIEW = 8      /* the eye or the light */
};

/* An output of a node whose values are drawn. */
struct bake_drawing {
    mxg_element source;
    const char *output; /* of the node; "" for its only one */
    const char *type;
    bool is_direction; /* of the world; drawn as what a normal map has */
    char *name;        /* of its image: letters, digits and '_' */
    mxg_element port;  /* the first input that reads it */
    char *path;        /* of what to generate: "NG_marble/color", "split/outr" */
    unsigned needs;
    uint32_t largest;        /* side of the largest texture that it reads; 0: it reads none */
    struct bake_tiles tiles; /* that its textures have; the first one if they have none */

    /* what was drawn */
    bool is_value;      /* the same everywhere: `value` has it */
    float value[4];     /* of the first texel */
    float low, high;    /* of all components */
    char *file;         /* of the image, in the output folder */
    const char *spaces; /* "srgb_texture"…; NULL: numbers as they are */
};

struct bake_plan {
    const mxg_document *document;
    struct report *report;
    const char *const *spaces; /* of colors in images that stay, which NULL ends; NULL: any */
    bool keeps_places;         /* images stay that are scaled and moved, with what places them */
    const char
        *drawn_missing;      /* the document's path: images without a file do not stay; NULL: do */
    struct bake_node *nodes; /* a node comes after those that it reads */
    size_t num_nodes;
    struct bake_drawing *drawings;
    size_t num_drawings;
    struct name_table names; /* that are taken, also without regard to case */
};

/* True for what belongs to the document's own definitions, which stay as they are. */
bool bake_is_definition(const mxg_document *document, mxg_element element);

/* True for looks, what they name beside materials, and facts of geometries (bake_looks.c). */
bool bake_is_of_look(const mxg_document *document, mxg_element element);

/* An empty plan for a document. */
void bake_plan_begin(struct bake_plan *plan, const mxg_document *document, struct report *report);
/* Plans a renderable with all that it reads. false after reporting an error. */
bool bake_plan_add(struct bake_plan *plan, const char *path);
/* The index of a node of the plan; num_nodes: it is not there. */
size_t bake_plan_find(const struct bake_plan *plan, mxg_element element);
/* A name that nothing of the new document has. The caller frees it. */
char *bake_plan_name(struct bake_plan *plan, const char *wanted);
/* A name for a file, without its ending, that no file of the plan has. */
char *bake_plan_file(struct bake_plan *plan, const char *wanted);
void bake_plan_finish(struct bake_plan *plan);

/* An element 0 is the root. */

/* The path of an element. The caller frees it. */
char *bake_path(const mxg_document *document, mxg_element element);
mxg_element_info bake_element(const mxg_document *document, mxg_element element);
/* An attribute of an element; NULL: it has none. */
const char *bake_attribute(const mxg_document *document, mxg_element element, const char *name);
/* The attribute of the element or the nearest one around it. */
const char *bake_inherited(const mxg_document *document, mxg_element element, const char *name);

/* bake_file.c */
bool bake_is_token(const mxg_document *document, mxg_element element);
/* The value of a token, which may name another one. NULL: it has none. */
const char *bake_token_value(const mxg_document *document, mxg_element token);
/*
 * The path of a file that an element names in the document at `path`, with its fileprefix and the
 * values of its tokens. The caller frees it.
 */
char *bake_file_path(const mxg_document *document, const char *path, mxg_element element,
                     const char *file);
/* True for a name that stands for several files: tiles, or frames. */
bool bake_is_set(const char *file);

/* The output of a nodegraph; "" is its only one. 0: there is none. */
mxg_element bake_find_output(const mxg_document *document, mxg_element graph, const char *name);

/* Where an input or output gets its value from. */
struct bake_end {
    mxg_element node;   /* 0: no node */
    const char *output; /* of the node */
    mxg_element value;  /* an element with a value; 0: none */
};
/* Follows connections through nodegraphs and their inputs to a node or a value. */
struct bake_end bake_follow(const mxg_document *document, mxg_element port);

#endif
