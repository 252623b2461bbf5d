// SPDX-License-Identifier: Apache-2.0
/*
 * Reads the text form of a graph (docs/ir.md), as ir_print writes it: the notation of tests. The
 * builder makes the nodes, so it folds the text like any other input, unless graph->no_fold is set.
 */
#ifndef MXG_TESTS_UNIT_IR_TEXT_H
#define MXG_TESTS_UNIT_IR_TEXT_H

#include "ir/ir.h"

/*
 * Adds the text to a graph. "return" lines list the roots. Returns 0, or the number of the first
 * line that is no IR, or not sound.
 */
uint32_t ir_text_read(struct ir_graph *graph, const char *text, ir_ref **out_roots,
                      uint32_t *out_num_roots);

#endif
