// SPDX-License-Identifier: Apache-2.0
/*
 * Plug-ins: shared objects with nodes in C and targets (mxgen/node.h), which a user names with
 * --plugin.
 */
#ifndef MXG_PROGRAM_PLUGIN_H
#define MXG_PROGRAM_PLUGIN_H

#include "program/args.h"

#include <mxgen/dialect.h>
#include <mxgen/mxgen.h>

struct plugins {
    void **handles; /* of the loaded objects */
    size_t num_handles;
    const mxg_node_code **codes;
    size_t num_codes;
    const mxg_dialect **dialects;
    size_t num_dialects;
    struct arg_list libraries; /* paths of their definitions */
};

/*
 * Loads the plug-ins. False after a message: a file is no plug-in, or one of another version.
 * Call plugins_finish in both cases, after the end of the context that has the codes and
 * dialects.
 */
bool plugins_load(struct plugins *plugins, const struct arg_list *files);
void plugins_finish(struct plugins *plugins);

#endif
