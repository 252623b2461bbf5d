// SPDX-License-Identifier: Apache-2.0
/* Names in the source that the host chooses. */
#include "api/generation.h"

static bool report(struct generation *g, enum option_id option, const char *value,
                   const char *expected)
{
    diag_add(&g->result->object.diagnostics.list, DIAG_ID_bad_option, (struct diag_place){0}, value,
             option_key(option), expected);
    return false;
}

void naming_pairs(const struct option_value *value, struct arena *arena, struct name_rules *out)
{
    out->renamed = ARENA_ARRAY(arena, struct name_pair, value->list.len + 1);
    for (out->num_renamed = 0; out->num_renamed < value->list.len; out->num_renamed++) {
        const char *item = value->list.items[out->num_renamed];
        size_t len = strcspn(item, "=");
        const char *to = item + len + (item[len] == '=');
        out->renamed[out->num_renamed] =
            (struct name_pair){.from = arena_strndup(arena, item, len),
                               .to = arena_strndup(arena, to, strlen(to)),
                               .from_len = len};
    }
}

/* Returns what is wrong with a pair, as the text of what is expected; NULL: nothing. */
static const char *fault_of(struct generation *g, const struct name_rules *rules, uint32_t i)
{
    const struct name_pair *pair = &rules->renamed[i];
    if (!pair->from_len || !identifier_is(pair->to, strlen(pair->to)))
        return "FROM=TO, where TO is an identifier without '__' and 'gl_'";
    if (lang_syntax_is_reserved(g->result->target->syntax, pair->to, strlen(pair->to)))
        return "a name that is no word of the language";
    if (strcmp(pair->to, g->role->entry) == 0)
        return "a name that is not that of the shader's own function";
    const char *from = arena_strndup(&g->scratch, pair->from, pair->from_len);
    if (names_frame_has(rules, g->role, pair->to, from, &g->scratch))
        return "a name that the shader does not have already";
    for (uint32_t k = 0; k < i; k++)
        if (strcmp(rules->renamed[k].to, pair->to) == 0
            || strcmp(rules->renamed[k].from, pair->from) == 0)
            return "names that no other item has";
    return NULL;
}

static bool check_renamed(struct generation *g)
{
    struct name_rules rules = {.prefix = g->options[OPTION_prefix].text};
    bool good = true;
    naming_pairs(&g->options[OPTION_rename], &g->scratch, &rules);
    for (uint32_t i = 0; i < rules.num_renamed; i++) {
        const char *expected = fault_of(g, &rules, i);
        if (expected)
            good = report(g, OPTION_rename, g->options[OPTION_rename].list.items[i], expected);
    }
    return good;
}

/* The language's own modules, and words of the language, are no names of modules. */
static bool check_module(struct generation *g)
{
    const struct target *target = g->result->target;
    const char *name = g->options[OPTION_mdl_module].text;
    size_t len = strlen(name);
    bool is_good =
        !len || (identifier_is(name, len) && !lang_syntax_is_reserved(target->syntax, name, len));
    for (const char *const *own = target->modules; own && *own; own++)
        is_good = is_good && strcmp(name, *own) != 0;
    return is_good
           || report(g, OPTION_mdl_module, name,
                     "an identifier that is no word and no module of the language");
}

static bool check_lights(struct generation *g)
{
    const struct option_value *lights = &g->options[OPTION_lights];
    for (uint32_t i = 0; i < lights->list.len && lights->list.len > 1; i++)
        if (strcmp(lights->list.items[i], "none") == 0)
            return report(g, OPTION_lights, "none", "'none' alone, or names of lights");
    return true;
}

bool generation_check_names(struct generation *g)
{
    bool renamed = check_renamed(g), module = check_module(g), lights = check_lights(g);
    return renamed && module && lights;
}
