// SPDX-License-Identifier: Apache-2.0
/* Finds what drives the inputs of a layer's material (docs/slots.md, "Overrides"). */
#ifndef MXG_BIND_DRIVE_H
#define MXG_BIND_DRIVE_H

#include "bind/bind.h"
#include "bind/substance.h"

/* The states of an output of an override, by element. */
enum drive_seen { DRIVE_MET = 1, DRIVE_MATCHED = 2, DRIVE_REPORTED = 4 };

struct drive_output {
    elem_id source;
    struct diag_place place; /* of its assignment */
    const char *slot;
};

/* Notes about the drives of all stacks together, for messages. */
struct drive_notes {
    struct arena *arena;
    struct diag_list *diags;
    elem_id first_element;
    uint8_t *seen; /* by element of the document: enum drive_seen */
    VEC(struct drive_output) outputs;
};
void drive_note(struct drive_notes *notes, elem_id source, struct diag_place place,
                const char *slot);

/* The number of items of the layer that begins a list: it, its products and its overrides. */
uint32_t bind_num_parts(const struct bind_item *items, uint32_t num);

/*
 * Adds the drives of one layer, whose items bind_num_parts counts. notes NULL: faulty ones are left
 * out silently, because bind_check_drives reports them.
 */
void bind_drives(const struct bindings *b, const struct library *lib, const struct bind_item *items,
                 uint32_t num, struct drive_notes *notes, struct arena *arena,
                 struct library_drives *out);

/* Reports the faults of the overrides of all stacks, and outputs that drive nothing, once each. */
void bind_check_drives(const struct bindings *b, const struct library *lib, struct arena *scratch,
                       struct diag_list *diags);

#endif
