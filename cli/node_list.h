// SPDX-License-Identifier: Apache-2.0
/* The nodes of a library as text, for `mxgen library list` and `mxgen explain`. */
#ifndef MXG_CLI_NODE_LIST_H
#define MXG_CLI_NODE_LIST_H

#include <mxgen/mxgen.h>

/*
 * Prints a line per definition, "ND_mix_float  mix(fg:float, bg:float, mix:float) -> out:float":
 * those with one of the words in the name of the definition or the node, in any case; without
 * words all. Returns the number of lines.
 */
uint32_t nodes_list(const mxg_library *library, const char *const *words, size_t num_words);

/* Prints a node, by its name or the name of a definition. false: there is no such node. */
bool nodes_explain(const mxg_library *library, const char *name);

/* The name of a node or definition that is most like the word; NULL: none. */
const char *nodes_closest(const mxg_library *library, const char *word);

#endif
