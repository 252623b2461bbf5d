// SPDX-License-Identifier: Apache-2.0
/* A maker turns the networks of a stage into a document: elements, values and nodes. */
#ifndef MXG_BIND_NETWORK_MAKER_H
#define MXG_BIND_NETWORK_MAKER_H

#include "bind/materials.h"
#include "bind/preview.h"

/* A node that was made; its inputs are read later, so no network is too deep. */
struct made_node {
    usda_prim_id prim;
    elem_id element;
    uint32_t nodedef;
    const struct preview_shader *preview; /* NULL: the shader is a definition of MaterialX */
    bool is_made;                         /* for the prim, beside the node that it is */
    uint32_t last; /* 1 + the node that ends the arithmetic of a texture; 0: not known */
};

/* An input of the nodegraph. */
struct made_input {
    str_id name, type;
};

/* An output of the nodegraph. */
struct made_output {
    elem_id node;
    str_id port, name;
};

/* Where a connection ends. */
struct source {
    uint32_t node; /* 1 + index in `nodes`; 0: a value */
    str_id port;
    const struct usda_property *value; /* NULL: nothing */
    bool is_interface;                 /* the value is an input of the Material */
};

struct maker {
    const struct scene *scene;
    const struct usda_layer *layer;
    struct library *lib;
    struct document *doc;
    const struct bind_images *images;
    struct arena *scratch;
    struct diag_list *diags;
    usda_prim_id material;
    const char *name; /* of the material in the document */
    elem_id graph;    /* 0: not made yet */
    uint16_t file;
    VEC(struct made_node) nodes; /* of the material */
    VEC(struct made_output) outputs;
    VEC(struct made_input) interface;
    struct table node_table;      /* (prim, material) → 1 + index in `nodes` */
    struct table output_table;    /* (node, port) → the same in `outputs` */
    struct table interface_table; /* (name, material) → the same in `interface` */
};

str_id maker_intern(struct maker *m, struct text_word word);
void maker_set(struct maker *m, elem_id element, const char *name, str_id value);
elem_id maker_add(struct maker *m, elem_id parent, const char *category, str_id name, uint32_t line,
                  uint32_t column);
/* Adds an element whose name no other one below the parent has: a number follows one that is taken.
 */
elem_id maker_add_free(struct maker *m, elem_id parent, const char *category, struct text *name,
                       const struct usda_prim *at);
struct diag_place maker_place(const struct maker *m, const struct usda_property *property);
/* A copy for diagnostics. */
const char *maker_text(struct maker *m, struct text_word word);
/* The value as MaterialX writes it. */
str_id maker_value(struct maker *m, const struct usda_property *property);
/*
 * Reports a property whose type is another than the wanted one, or whose value is none of its type.
 * Each place is reported once, however many inputs read it.
 */
void maker_check_type(struct maker *m, const struct usda_property *property, const char *wanted);
/* The outputs of a definition. */
const struct port *maker_outputs(struct maker *m, uint32_t nodedef, uint32_t *out_num);
/* The nodegraph of the material; made on first use. */
elem_id maker_graph(struct maker *m);
/* The node of a Shader prim: 1 + index; makes it on first use. 0: it has no definition. */
uint32_t maker_node(struct maker *m, usda_prim_id prim);
/*
 * A new node for the prim of another one, whose input reads that one; its first output. Its name
 * has the suffix behind that of the other one.
 */
struct source maker_add_after(struct maker *m, const struct source *from, const char *nodedef,
                              const char *input, const char *suffix);
/*
 * A new node likewise that an input of another one reads, which has no such input yet; without a
 * node: the library lacks the definition.
 */
struct source maker_add_before(struct maker *m, const struct made_node *node, const char *nodedef,
                               const char *input, const char *suffix);

/* ---- materials.c ---- */

/* The connection of "inputs:x" or "outputs:x" of a prim; NULL: it has none. */
const struct usda_property *maker_connection(struct maker *m, usda_prim_id prim,
                                             struct text_word name);
/* Follows "/M/NG.outputs:x" through the ports of graphs to a shader, or to a value. */
struct source maker_follow(struct maker *m, const struct usda_property *connection);
/* Connects an input of `user`, whose type is known, to a node. */
void maker_connect(struct maker *m, elem_id input, elem_id user, const struct source *to);
/* Makes the input of a node from "inputs:x" or "inputs:x.connect" of its prim. */
void maker_read_input(struct maker *m, const struct made_node *node,
                      const struct usda_property *property, str_id name);

/* ---- usd_shaders.c ---- */

/*
 * The name that MaterialX has for an input of a node; 0: the node has none, or usd_add_values gives
 * it.
 */
str_id usd_input(struct maker *m, const struct made_node *node, struct text_word name);
/* Gives a shader of USD the values that MaterialX writes in other words, and USD's defaults. */
void usd_add_values(struct maker *m, const struct made_node *node);
/* Sets the colour space of a texture: what sourceColorSpace, metadata or the image says. */
void usd_set_color_space(struct maker *m, const struct made_node *node, elem_id input,
                         const struct usda_property *file);
/* An output of a texture of USD, "rgb"; port 0: it has no such output. */
struct source usd_texture_output(struct maker *m, uint32_t texture, struct text_word name);
/*
 * The shader of the displacement that a surface of USD has as an input; without a node: it has
 * none. In MaterialX it is a shader of its own.
 */
struct source usd_displacement(struct maker *m, const struct made_node *surface);

#endif
