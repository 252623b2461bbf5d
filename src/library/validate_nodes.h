// SPDX-License-Identifier: Apache-2.0
/* Declarations that the files of the validation share. */
#ifndef MXG_LIBRARY_VALIDATE_NODES_H
#define MXG_LIBRARY_VALIDATE_NODES_H

#include "library/library.h"

struct validate {
    const struct library *lib;
    const struct document *doc; /* of the layer */
    struct diag_list *diags;
    struct resolve_out resolved;
    uint8_t *used;      /* per element of this layer: some connection uses it */
    str_id known_space; /* the last colour space that was valid; 0: none */
};

/*
 * validate_inputs.c: checks the value of a node's input against its definition, and reports a
 * missing required value.
 */
void validate_input(struct validate *v, elem_id node, uint32_t nodedef, const struct port *port,
                    const struct binding *binding);

/*
 * validate_inputs.c: checks the units, colour spaces, ranges and enumerations of an element's
 * attributes.
 */
void validate_attributes_of(struct validate *v, elem_id element);

/*
 * validate_rules.c: checks further rules of the specification: uniform inputs stay uniform,
 * declarations are consistent, only numeric types have units.
 */
void validate_uniform(struct validate *v, elem_id node, const struct port *port,
                      const struct binding *binding);
void validate_declaration(struct validate *v, elem_id element);
/* Reports a fault of a declaration: "<typedef> 'half' has …". */
void validate_report(struct validate *v, elem_id element, const char *what);
/* Strings, filenames and arrays, which do not vary over a surface. */
bool validate_is_uniform_type(doc_type type);
bool validate_is_among(const char *word, const char *const *words, size_t count);
/* The spaces of a change of space exist; its definition, as in MaterialX, has no list of them. */
void validate_space(struct validate *v, elem_id node, const struct port *port, elem_id input);
/* Reports two implementations of one definition for the same target. */
void validate_implementations(struct validate *v, struct arena *scratch);
/* Reports two versions of one definition that both say that they are the default. */
void validate_default_versions(struct validate *v);
void validate_unit(struct validate *v, elem_id node, const struct port *port, elem_id input);
/* The type of an element has the unit or the colour space that the element says. */
void validate_type_of_meaning(struct validate *v, elem_id element);
/* An input that reads a node says no colour space and no unit, except of a file. */
void validate_connected_meaning(struct validate *v, const struct port *port, elem_id input);

/*
 * validate_properties.c: a <geompropdef>; the type of what gives or reads the property of a name;
 * a node that reads a property.
 */
void validate_geompropdef(struct validate *v, elem_id element);
void validate_type_of_property(struct validate *v, elem_id element, str_id name);
void validate_reader(struct validate *v, elem_id node);

#endif
