// SPDX-License-Identifier: Apache-2.0
/* Options that mean nothing together. */
#include "api/generation.h"

static const struct combination {
    enum option_id option, other;
    const char *value, *other_value, *why;
} combinations[] = {
#define COMBINATION(option, value, other, other_value, why) \
    {OPTION_##option, OPTION_##other, value, other_value, why},
#include "api/combinations.def"
#undef COMBINATION
};

/* The passes belong to the pipeline whatever the option says. */
static const char *pipeline_of(const struct generation *g)
{
    return g->is_pass ? "deferred" : g->options[OPTION_pipeline].text;
}

static bool has_value(const struct generation *g, enum option_id option, const char *value)
{
    const struct option_value *v = &g->options[option];
    if (option == OPTION_pipeline)
        return strcmp(pipeline_of(g), value) == 0;
    return v->text ? strcmp(v->text, value) == 0 : v->number != 0 && strcmp(value, "true") == 0;
}

/* Options of a value that the default has, too, change nothing. */
static bool is_changed(const struct generation *g, enum option_id option)
{
    const struct option_value *value = &g->options[option];
    bool is_none = value->list.len == 1 && strcmp(value->list.items[0], "none") == 0;
    return value->is_set && !is_none && option_differs(option, value);
}

static void tell_clash(struct generation *g, const char *option, const char *value,
                       const char *other, const char *other_value, const char *why)
{
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_options_clash, (struct diag_place){0},
             option, value, other, other_value, why);
}

static void check_combination(struct generation *g, const struct combination *c)
{
    const char *option = option_key(c->option), *other = option_key(c->other);
    if (!has_value(g, c->option, c->value))
        return;
    if (!c->other_value && is_changed(g, c->other))
        diag_add(&g->result->object.diagnostics.list, DIAG_ID_option_without_effect,
                 (struct diag_place){0}, other, option, c->value, c->why);
    else if (c->other_value && has_value(g, c->other, c->other_value))
        tell_clash(g, option, c->value, other, c->other_value, c->why);
}

/* What stores closures needs unsigned words: OpenGL has all of it, with compute stages, from 4.3
 * on. */
static void check_target(struct generation *g)
{
    const struct target *target = g->result->target;
    if (has_value(g, OPTION_transparency, "dual") && !(target->caps & CAP_TWO_SOURCES))
        tell_clash(g, option_key(OPTION_transparency), "dual", "target", target->name,
                   "only the targets vulkan and glsl have a second source to blend with");
    const char *version = g->options[OPTION_version].text;
    bool packs = generation_packs(g);
    const char *option = option_key(packs ? OPTION_form : OPTION_pipeline),
               *value = packs ? "payload" : pipeline_of(g);
    if (!packs && has_value(g, OPTION_pipeline, "forward"))
        return;
    if (!(target->caps & CAP_STORES))
        tell_clash(g, option, value, "target", target->name,
                   "only the targets vulkan and glsl store closures");
    else if (*version && strcmp(version, "430") < 0)
        tell_clash(g, option, value, option_key(OPTION_version), version,
                   "stored closures need compute stages, from 430 on");
}

bool generation_check_combinations(struct generation *g)
{
    uint32_t before = g->result->object.diagnostics.list.num_errors;
    check_target(g);
    for (size_t i = 0; i < sizeof combinations / sizeof *combinations; i++)
        check_combination(g, &combinations[i]);
    return g->result->object.diagnostics.list.num_errors == before;
}
