// SPDX-License-Identifier: Apache-2.0
/* Targets of hosts: a target of mxgen with another name, version, and defaults of options. */
#include "api/api.h"

#include <assert.h>

const struct target *context_target(const mxg_context *context, const char *name)
{
    for (uint32_t i = 0; i < context->num_dialects; i++)
        if (strcmp(context->dialects[i].target.name, name) == 0)
            return &context->dialects[i].target;
    return target_find(name);
}

const struct dialect *context_dialect(const mxg_context *context, const struct target *target)
{
    for (uint32_t i = 0; i < context->num_dialects; i++)
        if (&context->dialects[i].target == target)
            return &context->dialects[i];
    return NULL;
}

struct reading {
    const mxg_dialect *from;
    struct dialect *to;
    struct arena scratch;
    struct refusal *why;
    mxg_status status;
};

/* The version of the host comes first, so that it is the default. */
static bool take_versions(struct dialect *dialect, const char *version, const struct target *base)
{
    size_t num = 0, capacity = sizeof dialect->versions / sizeof *dialect->versions;
    bool is_known = !version;
    if (version)
        dialect->versions[num++] = version;
    for (const char *const *known = base->versions; known && *known && num + 1 < capacity;
         known++) {
        bool is_own = version && strcmp(*known, version) == 0;
        is_known |= is_own;
        if (!is_own)
            dialect->versions[num++] = *known;
    }
    dialect->target.versions = num ? dialect->versions : NULL;
    return is_known;
}

static mxg_status refuse_base(struct reading *r)
{
    const char *names[32];
    uint32_t num = 0, capacity = sizeof names / sizeof *names;
    struct diag_list list; /* for the suggestion */
    diag_list_init(&list, &r->scratch);
    for (mxg_target target = MXG_INIT(mxg_target);
         num < capacity && mxg_catalogue_target(num, &target) == MXG_OK; num++)
        names[num] = target.name;
    return refuse(r->why, "dialect '%s' has the unknown base '%s'%s", r->from->name, r->from->base,
                  diag_suggest(&list, r->from->base, names, num));
}

static mxg_status read_options(struct reading *r)
{
    const mxg_dialect *from = r->from;
    if (!from->options && from->num_options)
        return refuse(r->why, "dialect '%s' has num_options, but no options", from->name);
    for (size_t i = 0; i < from->num_options; i++) {
        const char *key = from->options[2 * i], *value = from->options[2 * i + 1];
        if (!key || !value)
            return refuse(r->why,
                          "dialect '%s': a key or a value of option %zu is NULL; num_options is "
                          "the number of pairs",
                          from->name, i);
        const char *fault = option_fault(&r->to->target, key, value, &r->scratch);
        if (fault)
            return refuse(r->why, "dialect '%s', option '%s': %s", from->name, key, fault);
    }
    return MXG_OK;
}

static void read_dialect(void *arg)
{
    struct reading *r = arg;
    const mxg_dialect *from = r->from;
    const struct target *base = target_find(from->base);
    if (!base || !*from->name || target_find(from->name)) {
        r->status =
            !base ? refuse_base(r)
                  : refuse(r->why, "dialect '%s' needs a name that no target has", from->name);
        return;
    }
    struct target *target = &r->to->target;
    *target = *base;
    target->base = base;
    target->name = target->materialx_name = from->name;
    for (int stage = 0; stage < NUM_STAGES; stage++)
        if (base->stage_suffix[stage] && from->stage_suffix[stage])
            target->stage_suffix[stage] = from->stage_suffix[stage];
    r->to->options = from->options;
    r->to->num_options = from->num_options;
    r->status = take_versions(r->to, from->version, base)
                    ? read_options(r)
                    : refuse(r->why, "dialect '%s': its base has no version '%s'", from->name,
                             from->version);
}

/* Adds a dialect; the context has room for it. */
static mxg_status add(mxg_context *context, const mxg_dialect *given, struct refusal *why)
{
    mxg_dialect from;
    if (!given || !struct_read(&from, sizeof from, given) || !from.name || !from.base)
        return refuse(why, "dialects[%u] is NULL, or has no size, name or base",
                      context->num_dialects);
    for (uint32_t i = 0; i < context->num_dialects; i++)
        if (strcmp(context->dialects[i].target.name, from.name) == 0)
            return refuse(why, "two dialects have the name '%s'", from.name);
    struct mem mem = context->mem;
    struct reading reading = {
        .from = &from, .to = &context->dialects[context->num_dialects], .why = why};
    arena_init(&reading.scratch, &mem);
    bool has_memory = mem_try(&mem, read_dialect, &reading);
    arena_finish(&reading.scratch);
    if (!has_memory)
        return MXG_ERROR_MEMORY;
    context->num_dialects += reading.status == MXG_OK;
    return reading.status;
}

static size_t size_of_all(uint32_t capacity)
{
    return capacity * sizeof(struct dialect);
}

mxg_status dialects_take(mxg_context *context, const mxg_context_desc *desc, struct refusal *why)
{
    assert(!context->dialects);
    if (!desc->num_dialects)
        return MXG_OK;
    if (!desc->dialects || desc->num_dialects > UINT16_MAX)
        return refuse(why, "dialects does not have num_dialects items");
    context->max_dialects = (uint32_t)desc->num_dialects;
    size_t size = size_of_all(context->max_dialects);
    context->dialects = context->mem.realloc(context->mem.user_data, NULL, 0, size);
    if (!context->dialects)
        return MXG_ERROR_MEMORY;
    memset(context->dialects, 0, size);
    atomic_fetch_add(&context->used, size);
    mxg_status status = MXG_OK;
    for (uint32_t i = 0; i < context->max_dialects && status == MXG_OK; i++)
        status = add(context, desc->dialects[i], why);
    return status;
}

void dialects_finish(mxg_context *context)
{
    if (context->dialects)
        context->mem.realloc(context->mem.user_data, context->dialects,
                             size_of_all(context->max_dialects), 0);
}
