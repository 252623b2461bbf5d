// SPDX-License-Identifier: Apache-2.0
/* Plug-ins that mxgen must refuse: KIND selects the fault. */
#include <mxgen/mxgen.h>

#define OTHER_VERSION 1
#define NOTHING 2
#define NO_ENTRY 3
#define BAD_NODE 4
#define BAD_DIALECT 5

MXG_API const mxg_plugin *mxgen_plugin(void);
MXG_API int mxgen_other(void);

#if KIND == NO_ENTRY
int mxgen_other(void)
{
    return 0;
}
#else
const mxg_plugin *mxgen_plugin(void)
{
    static const mxg_node_code node = {sizeof node, "ND_x", "genmoon", 1, NULL, NULL, "ND_y"};
    static const mxg_node_code *const nodes[] = {&node};
    static const mxg_dialect dialect = {.size = sizeof dialect, .name = "moon", .base = "genmoon"};
    static const mxg_dialect *const dialects[] = {&dialect};
    static const mxg_plugin plugin = {.version = MXG_PLUGIN_VERSION + (KIND == OTHER_VERSION),
                                      .name = "wrong",
                                      .nodes = nodes,
                                      .num_nodes = KIND == BAD_NODE,
                                      .dialects = dialects,
                                      .num_dialects = KIND == BAD_DIALECT};
    return KIND == NOTHING ? NULL : &plugin;
}
#endif
