// SPDX-License-Identifier: Apache-2.0
/* Answers what the rooms of closures and slabs ask about the library. */
#include "material/texels.h"
#include "slabs/joined_surfaces.h"

static const uint32_t *leaf_functions(void *user_data, uint32_t callee)
{
    _Static_assert((int)LEAF_EVAL == FAMILY_EVAL && (int)LEAF_FACTOR == FAMILY_FACTOR
                       && (int)LEAF_FACET == FAMILY_FACET,
                   "leaf functions are the first members of a family");
    return build_leaf_family(user_data, callee)->functions;
}

static const char *leaf_input(void *user_data, uint32_t callee, unsigned index)
{
    return build_leaf_input(user_data, callee, index);
}

struct closure_host build_closure_host(struct builder *b, struct closure_point *point)
{
    return (struct closure_host){.user_data = b,
                                 .point = point,
                                 .leaf_functions = leaf_functions,
                                 .leaf_input = leaf_input,
                                 .lang = build_lang_host(b),
                                 .asks_thickness = b->options->asks_thickness};
}

static ir_ref slab_lobes(void *user_data, const ir_ref *inputs, const struct slab_place *place)
{
    return build_slab_lobes(user_data, inputs, place);
}

static ir_ref marked_lobes(void *user_data, const ir_ref *inputs, const struct slab_place *place)
{
    return build_marked_lobes(user_data, inputs, place);
}

static ir_ref slab_of(void *user_data, ir_ref leaf, bool is_top, bool loosely)
{
    return build_slab_of(user_data, leaf, is_top, loosely);
}

static ir_ref slab_like(void *user_data, ir_ref leaf, ir_ref albedo)
{
    return build_slab_like(user_data, leaf, albedo);
}

static ir_ref lit_from_behind(void *user_data, ir_ref color)
{
    return build_leaf_of_color(user_data, "ND_translucent_bsdf", color);
}

static const float *texels(void *user_data, uint32_t variable)
{
    return build_texels(user_data, variable);
}

static ir_ref blurred(void *user_data, ir_ref value, ir_ref position, ir_ref deviation)
{
    return build_blur_around(user_data, value, position, deviation);
}

static struct slabs_host slabs_host(struct builder *b, const struct closure_host *closures)
{
    return (struct slabs_host){.user_data = b,
                               .lobes = slab_lobes,
                               .slab_of = slab_of,
                               .slab_like = slab_like,
                               .lit_from_behind = lit_from_behind,
                               .texels = texels,
                               .closures = closures,
                               .walks = b->shader->role->returns == RETURNS_PATH};
}

/* Only the walk ends in storage. */
static struct slabs_host walking_host(struct builder *b, const struct closure_host *closures)
{
    struct slabs_host host = slabs_host(b, closures);
    host.lobes = marked_lobes;
    host.asks_thickness = b->options->asks_thickness;
    if (!role_stores(b->shader->role))
        host.blurred = blurred;
    return host;
}

ir_ref build_walk_slabs(struct builder *b, const struct closure_host *closures, ir_ref root)
{
    struct slabs_host host = walking_host(b, closures);
    if (host.walks)
        root = slabs_join_matter(b->shader, &host, root);
    return slabs_walk(b->shader, &host, root);
}

ir_ref build_budget_slabs(struct builder *b, const struct closure_host *closures,
                          struct arena *scratch, const struct slab_budget *budget, ir_ref root,
                          struct slab_report *out)
{
    struct slabs_host host = slabs_host(b, closures);
    host.scratch = scratch;
    return slabs_budget(b->shader, &host, budget, root, out);
}

void build_fill_sheet(struct builder *b, const struct closure_host *closures, struct arena *scratch,
                      const struct slab_budget *budget, ir_ref root, struct slab_sheet *out)
{
    struct slabs_host host = slabs_host(b, closures);
    host.scratch = scratch;
    slabs_fill_sheet(b->shader, &host, budget, root, out);
}

/* The root is a layer of a stack. */
static ir_ref without_slabs(struct builder *b, ir_ref root)
{
    struct closure_point point = {0};
    struct closure_host closures = build_closure_host(b, &point);
    struct slabs_host host = walking_host(b, &closures);
    host.is_on_matter = true;
    return slabs_walk(b->shader, &host, root);
}

void build_know_slabs(struct builder *b)
{
    b->without_slabs = without_slabs;
}
