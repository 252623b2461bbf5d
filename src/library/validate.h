// SPDX-License-Identifier: Apache-2.0
/* What the files of the validation share. */
#ifndef MXG_LIBRARY_VALIDATE_H
#define MXG_LIBRARY_VALIDATE_H

#include "library/library.h"

struct validate {
    const struct library *lib;
    const struct document *doc; /* its own layer's */
    struct diag_list *diags;
    struct resolve_out resolved;
    uint8_t *used;      /* per own element: a connection leads there */
    str_id known_space; /* the colour space that was found good last; 0: none */
};

/*
 * validate_inputs.c: the value of a node's input against its definition; that it has one, where it
 * must.
 */
void validate_input(struct validate *v, elem_id node, uint32_t nodedef, const struct port *port,
                    const struct binding *binding);

/*
 * validate_inputs.c: units, colour spaces, ranges and lists of words that an element says by
 * itself.
 */
void validate_attributes_of(struct validate *v, elem_id element);

/*
 * validate_rules.c: what the specification asks beyond that: uniform inputs stay uniform,
 * declarations fit, units have a type of numbers.
 */
void validate_uniform(struct validate *v, elem_id node, const struct port *port,
                      const struct binding *binding);
void validate_declaration(struct validate *v, elem_id element);
/*
 * Two implementations of one definition for the same target, where nothing says which of them
 * counts.
 */
void validate_implementations(struct validate *v, struct arena *scratch);
void validate_unit(struct validate *v, elem_id node, const struct port *port, elem_id input);
void validate_unit_type(struct validate *v, elem_id element);

#endif
