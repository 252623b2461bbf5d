// SPDX-License-Identifier: Apache-2.0
/* Nodes whose implementation is code of a host. */
#include "dynamic/code.h"

/* mxg_build_fn: applies the definition that stands instead of this one. */
static bool apply_instead(void *user_data, mxg_build *build, mxg_ref *results)
{
    const struct mxg_node_code *code = user_data;
    struct builder *b = build->b;
    str_id name = str_find(b->shader->strings, code->instead, strlen(code->instead));
    uint32_t nodedef = name ? library_nodedef_by_name(b->lib, name) : LIBRARY_NONE, n = 0;
    const char **names = ARENA_ARRAY(b->arena, const char *, build->def->num_inputs);
    mxg_ref *args = ARENA_ARRAY(b->arena, mxg_ref, build->def->num_inputs);
    for (unsigned i = 0; nodedef != LIBRARY_NONE && i < build->def->num_inputs; i++) {
        if (library_find_input(b->lib, nodedef, build->ports[i].name) < 0)
            continue;
        names[n] = build_text(b, build->ports[i].name);
        args[n++] = code_issue(build, build->frame->args[i]);
    }
    return mxg_build_node(build, code->instead, names, args, n, results, build->def->num_outputs);
}

void code_build(struct builder *b, const struct frame *frame, ir_ref *results)
{
    assert(frame->impl->kind == IMPL_CODE && frame->impl->ref < b->options->num_codes);
    const struct mxg_node_code *code = &b->options->codes[frame->impl->ref];
    uint32_t first_node = b->graph->nodes.len;
    const struct frame use = *frame; /* frames move */
    elem_id outer = b->called;
    b->called = use.node.element;
    bool has_tiles = build_note_textures(b, &use);
    code_run(b, &use, code->build ? code->build : apply_instead,
             code->build ? code->user_data : (void *)(uintptr_t)code, code->name, results);
    if (has_tiles)
        build_check_tiles(b, &use, first_node);
    b->called = outer;
}
