// SPDX-License-Identifier: Apache-2.0
/*
 * The code of nodes in C (mxgen/node.h), of mxgen and of hosts.
 *
 * Code of a host is foreign: no jump may cross it (base/mem.h). So each function of node.h that
 * takes memory sets its own trap, and the code runs to its end before the builder jumps on.
 */
#ifndef MXG_DYNAMIC_CODE_H
#define MXG_DYNAMIC_CODE_H

#include "build/build_priv.h"

#include <mxgen/mxgen.h>

struct mxg_build {
    struct builder *b;
    const struct frame *frame;
    const struct nodedef *def;
    const struct port *ports;
    ir_type_id type;     /* of the first output */
    uint32_t serial;     /* of this use; its values have it */
    const char *foreign; /* name of a host's code; NULL: code of mxgen */
    bool has_failed;     /* after a report, or a consequence of one */
    bool has_no_memory;  /* the builder jumps when the code has ended */
};

/* The arguments of a function of node.h, for its work inside a trap. */
struct code_request {
    struct mxg_build *build;
    const char *name, *type, *text;
    const char *const *names;
    const mxg_ref *args;
    const float *numbers;
    uint32_t num;
    uint32_t num_results;
    mxg_ref *results;
    const mxg_build_uniform *uniform;
    mxg_ref value, result; /* result: 0 after a failure */
};

/* Runs work(request), unless the use has failed; returns request->result. */
mxg_ref code_request(struct code_request *request, void (*work)(void *request));

/* The value for a ref of the graph; 0 for 0. Takes memory. */
mxg_ref code_issue(struct mxg_build *build, ir_ref ref);
/* The ref of a value, which may be 0; false after a report: no value of this use has the number. */
bool code_ref(struct mxg_build *build, mxg_ref value, ir_ref *out);
/* Takes several values; the refs live as long as the builder. */
bool code_refs(struct mxg_build *build, const mxg_ref *values, uint32_t n, ir_ref **out);
/* api/node_values.c: the value of a type from its components; false after a report. */
bool code_numbers(struct mxg_build *build, ir_type_id type, const float *numbers, uint32_t n,
                  struct ir_value *out);
/* A type by name; VOID after a report. */
ir_type_id code_type(struct mxg_build *build, const char *name);

/* The node, in its document. */
struct diag_place code_place(const struct mxg_build *build);

/* Reports a mistake of the code: "'ND_gain' asks for an input that it does not have: 'x'". */
void code_fault(struct mxg_build *build, const char *fault, const char *word);

/*
 * Builds a node by code. `foreign` is NULL for the code of mxgen, whose results may have any type.
 * Writes one ref per output: poison after an error.
 */
void code_run(struct builder *b, const struct frame *frame, mxg_build_fn build, void *user_data,
              const char *foreign, ir_ref *results);

/* code_node.c: builds a node whose implementation is such a one. */
void code_build(struct builder *b, const struct frame *frame, ir_ref *results);

#endif
