// SPDX-License-Identifier: Apache-2.0
/*
 * The role of a generation: the option `role`, or that of a pass. Checks that the target can have
 * it, and that the values of options have a meaning with it and with each other.
 */
#include "api/generation.h"

static const struct role_value {
    enum role_id role;
    enum option_id option;
    const char *value, *why;
} role_values[] = {
#define ROLE_VALUE(role, option, value, why) {ROLE_##role, OPTION_##option, value, why},
#define COMBINATION(option, value, other, other_value, why)
#include "api/combinations.def"
#undef ROLE_VALUE
#undef COMBINATION
};

static const struct combination {
    enum option_id option, other;
    const char *value, *other_value, *why;
} combinations[] = {
#define ROLE_VALUE(role, option, value, why)
#define COMBINATION(option, value, other, other_value, why) \
    {OPTION_##option, OPTION_##other, value, other_value, why},
#include "api/combinations.def"
#undef ROLE_VALUE
#undef COMBINATION
};

/* The texts say what a capability allows, as the end of "only … can" and of "the first to". */
static const struct ability {
    uint64_t cap;
    const char *text;
} abilities[] = {{CAP_STORES, "store slabs"},
                 {CAP_PASSES, "have passes"},
                 {CAP_TWO_SOURCES, "blend with two sources"},
                 {CAP_HOST_FILES, "be a function in a file of the host"},
                 {CAP_LIGHTING, "compute light in the shader"},
                 {CAP_PICKS, "pick a layer of a stack"},
                 {CAP_DERIVATIVES, "take derivatives"},
                 {CAP_CLOSURES, "return closures"},
                 {CAP_MODULES, "have modules"}};

/* Values of options that ask targets for more than their options do. */
static const struct {
    enum option_id option;
    const char *value;
    uint64_t caps;
} asking[] = {{OPTION_transparency, "dual", CAP_TWO_SOURCES},
              {OPTION_slots, "stochastic", CAP_PICKS},
              {OPTION_rough_refraction, "blur", CAP_DERIVATIVES}};

static void tell_clash(struct generation *g, const char *option, const char *value,
                       const char *other, const char *other_value, const char *why)
{
    diag_add(diags_of(g), DIAG_ID_options_clash, (struct diag_place){0}, option, value, other,
             other_value, why);
}

/* ---- Targets ---- */

static void tell_other_targets(struct generation *g, const struct ability *ability,
                               const char *option, const char *value)
{
    struct text why;
    const char *between = "only ";
    text_init(&why, &g->scratch);
    for (const struct target *const *t = targets; *t; t++)
        if (!target_lacks(*t, NULL, ability->cap)) {
            text_fmt(&why, "%s%s", between, (*t)->name);
            between = ", ";
        }
    text_fmt(&why, " can %s", ability->text);
    tell_clash(g, option, value, "target", g->result->target->name, text_cstr(&why));
}

/* The value of an option asks the target for capabilities. */
static void check_target(struct generation *g, const char *option, const char *value,
                         uint64_t wanted)
{
    const struct target *target = g->result->target;
    const char *version = g->options[OPTION_version].text;
    uint64_t never = target_lacks(target, NULL, wanted),
             not_yet = target_lacks(target, version, wanted) & ~never;
    for (size_t i = 0; i < sizeof abilities / sizeof *abilities; i++) {
        const struct ability *ability = &abilities[i];
        struct text why;
        if (never & ability->cap) {
            tell_other_targets(g, ability, option, value);
            return;
        }
        if (!(not_yet & ability->cap))
            continue;
        text_init(&why, &g->scratch);
        text_fmt(&why, "%s is the first version to %s", target->since.version, ability->text);
        tell_clash(g, option, value, option_key(OPTION_version), version, text_cstr(&why));
        return;
    }
}

/* ---- Options ---- */

static bool has_value(const struct generation *g, enum option_id option, const char *value)
{
    const struct option_value *v = &g->options[option];
    return v->text ? strcmp(v->text, value) == 0 : v->number != 0 && strcmp(value, "true") == 0;
}

/* A value that the default has, too, changes nothing. */
static bool is_changed(const struct generation *g, enum option_id option)
{
    const struct option_value *value = &g->options[option];
    bool is_none = value->list.len == 1 && strcmp(value->list.items[0], "none") == 0;
    return value->is_set && !is_none && option_differs(option, value);
}

static void check_tasks(struct generation *g, const struct role *role)
{
    for (unsigned i = 0; i < NUM_OPTIONS; i++) {
        enum option_id option = (enum option_id)i;
        const char *why = role->lacks[option_task(option)];
        if (why && is_changed(g, option))
            diag_add(diags_of(g), DIAG_ID_option_without_effect, (struct diag_place){0},
                     option_key(option), option_key(OPTION_role), role->name, why);
    }
}

static void check_values(struct generation *g, const struct role *role)
{
    for (size_t i = 0; i < sizeof role_values / sizeof *role_values; i++) {
        const struct role_value *v = &role_values[i];
        if (role == &roles[v->role] && has_value(g, v->option, v->value))
            tell_clash(g, option_key(OPTION_role), role->name, option_key(v->option), v->value,
                       v->why);
    }
    for (size_t i = 0; i < sizeof combinations / sizeof *combinations; i++) {
        const struct combination *c = &combinations[i];
        if (!has_value(g, c->option, c->value))
            continue;
        if (c->other_value && has_value(g, c->other, c->other_value))
            tell_clash(g, option_key(c->option), c->value, option_key(c->other), c->other_value,
                       c->why);
        if (!c->other_value && is_changed(g, c->other))
            diag_add(diags_of(g), DIAG_ID_option_without_effect, (struct diag_place){0},
                     option_key(c->other), option_key(c->option), c->value, c->why);
    }
}

/* A pass takes the options of the materials that it lights; those of tasks that it lacks go. */
static void leave_tasks(struct generation *g)
{
    for (unsigned i = 0; i < NUM_OPTIONS; i++)
        if (g->role->lacks[option_task((enum option_id)i)])
            option_reset((enum option_id)i, &g->result->object.arena, &g->options[i]);
}

/* ---- Roles ---- */

static const struct role *role_of_options(const struct generation *g)
{
    const struct option_value *role = &g->options[OPTION_role];
    bool has_one_role = g->result->target->closures && !role->is_set;
    return has_one_role ? &roles[ROLE_closures] : role_find(role->text);
}

/* The role of the materials that a pass lights. The options may be those of a payload, too. */
static const struct role *check_pass(struct generation *g)
{
    const struct option_value *option = &g->options[OPTION_role];
    const struct role *material = &roles[ROLE_deferred];
    if (is_changed(g, OPTION_role) && !role_stores(role_find(option->text)))
        tell_clash(g, option_key(OPTION_role), option->text, "pass",
                   deferred_pass_name(g->result->pass), "a pass lights what materials store");
    return material;
}

bool generation_has_module(struct generation *g)
{
    const char *key = option_key(OPTION_mdl_module), *name = g->options[OPTION_mdl_module].text;
    uint32_t before = diags_of(g)->num_errors;
    check_target(g, key, name, CAP_MODULES);
    if (diags_of(g)->num_errors == before && !*name)
        diag_add(diags_of(g), DIAG_ID_bad_option, (struct diag_place){0}, name, key,
                 "the name of the module");
    return diags_of(g)->num_errors == before;
}

bool generation_find_role(struct generation *g)
{
    uint32_t before = diags_of(g)->num_errors;
    bool is_known = g->role != NULL; /* of a pass: its name says it */
    if (!is_known)
        g->role = role_of_options(g);
    const struct role *asked = is_known ? check_pass(g) : g->role;
    if (is_known)
        check_target(g, "pass", deferred_pass_name(g->result->pass), g->role->caps);
    else
        check_target(g, option_key(OPTION_role), asked->name, asked->caps);
    for (size_t i = 0; i < sizeof asking / sizeof *asking; i++)
        if (has_value(g, asking[i].option, asking[i].value))
            check_target(g, option_key(asking[i].option), asking[i].value, asking[i].caps);
    check_tasks(g, asked);
    check_values(g, asked);
    if (is_known)
        leave_tasks(g);
    return diags_of(g)->num_errors == before;
}
