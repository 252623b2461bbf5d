// SPDX-License-Identifier: Apache-2.0
/* The codes of a host: which definitions they serve for the target. */
#include "build/build_priv.h"

#include "base/hash.h"

#include <mxgen/mxgen.h>

static str_id known_name(const struct builder *b, const char *name)
{
    return str_find(b->shader->strings, name, strlen(name));
}

static bool is_for_target(const struct builder *b, const struct mxg_node_code *code)
{
    str_id target = code->target ? known_name(b, code->target) : 0;
    for (unsigned i = 0; target && i < b->options->num_languages; i++)
        if (b->options->targets[i] == target)
            return true;
    return !code->target;
}

/* 1 + the index of the first code of this name; 0: there is none. */
static uint32_t find_by_name(const struct builder *b, str_id name)
{
    uint32_t hash = hash_pair(name, 0);
    for (uint32_t at = hash, found; (found = table_next(&b->code_names, hash, &at));)
        if (known_name(b, b->options->codes[found - 1].name) == name)
            return found;
    return 0;
}

void code_find_all(struct builder *b)
{
    for (uint32_t i = 0; i < b->options->num_codes; i++) {
        str_id name = known_name(b, b->options->codes[i].name);
        if (name && is_for_target(b, &b->options->codes[i]) && !find_by_name(b, name))
            table_add(&b->code_names, b->arena, hash_pair(name, 0), i + 1);
    }
}

static const struct implementation *find_made(const struct builder *b, uint32_t nodedef)
{
    uint32_t hash = hash_pair(nodedef, 0);
    for (uint32_t at = hash, found; (found = table_next(&b->code_table, hash, &at));)
        if (b->code_impls.items[found - 1]->nodedef == nodedef)
            return b->code_impls.items[found - 1];
    return NULL;
}

const struct implementation *code_implementation(struct builder *b, uint32_t nodedef)
{
    if (!b->code_names.num || b->without_code == nodedef + 1)
        return NULL;
    const struct implementation *made = find_made(b, nodedef);
    if (made)
        return made;
    const struct nodedef *def = library_nodedef(b->lib, nodedef);
    uint32_t found = find_by_name(b, def->name);
    found = found ? found : find_by_name(b, def->node);
    if (!found)
        return NULL;
    struct implementation *impl = ARENA_NEW(b->arena, struct implementation);
    *impl = (struct implementation){.name = def->name,
                                    .nodedef = nodedef,
                                    .ref = found - 1,
                                    .next = LIBRARY_NONE,
                                    .element = def->element,
                                    .kind = IMPL_CODE};
    vec_push(b->arena, &b->code_impls, impl);
    table_add(&b->code_table, b->arena, hash_pair(nodedef, 0), b->code_impls.len);
    const struct mxg_node_code *code = &b->options->codes[found - 1];
    /* a sum, because the order of the nodes does not matter */
    b->shader->reflection.codes +=
        hash_mix(hash_stable(HASH_STABLE_SEED, code->name, strlen(code->name)), code->version);
    return impl;
}
