// SPDX-License-Identifier: Apache-2.0
#include "program/cli_targets.h"

#include <mxgen/catalogue.h>
#include <mxgen/dialect.h>

#include <string.h>

static bool is_called(const mxg_target *target, const char *name, size_t len)
{
    return (strlen(target->name) == len && memcmp(target->name, name, len) == 0)
           || (strlen(target->materialx_name) == len
               && memcmp(target->materialx_name, name, len) == 0);
}

static bool find_own(const char *name, mxg_target *out)
{
    for (uint32_t i = 0; mxg_catalogue_target(i, out) == MXG_OK; ++i)
        if (is_called(out, name, strlen(name)))
            return true;
    return false;
}

/* The context refuses a dialect without such a base. */
static bool read_dialect(const mxg_dialect *dialect, mxg_target *out)
{
    if (!find_own(dialect->base, out))
        return false;
    out->name = out->materialx_name = dialect->name;
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        if (out->stage_suffix[stage] && dialect->stage_suffix[stage])
            out->stage_suffix[stage] = dialect->stage_suffix[stage];
    return true;
}

bool cli_target(const struct cli *cli, uint32_t index, mxg_target *out)
{
    uint32_t num_own = mxg_catalogue_num_targets();
    out->size = sizeof *out;
    if (index < num_own)
        return mxg_catalogue_target(index, out) == MXG_OK;
    return index - num_own < cli->plugins.num_dialects
           && read_dialect(cli->plugins.dialects[index - num_own], out);
}

bool cli_find_target(const struct cli *cli, const char *name, size_t len, mxg_target *out)
{
    for (uint32_t i = 0; cli_target(cli, i, out); ++i)
        if (is_called(out, name, len))
            return true;
    fprintf(stderr, "mxgen: unknown target '%.*s'; expected one of", (int)len, name);
    for (uint32_t i = 0; cli_target(cli, i, out); ++i)
        fprintf(stderr, "%s %s", i ? "," : ":", out->name);
    fputs(" [unknown-target]\n", stderr);
    return false;
}

const char *cli_base_target(const struct cli *cli, const char *name)
{
    mxg_target base = {sizeof base};
    for (size_t i = 0; i < cli->plugins.num_dialects; ++i)
        if (strcmp(cli->plugins.dialects[i]->name, name) == 0
            && find_own(cli->plugins.dialects[i]->base, &base))
            return base.name;
    return name;
}

static bool applies_to_one(const struct cli *cli, uint32_t option, const char *const *targets,
                           size_t num_targets)
{
    bool applies = false;
    for (size_t i = 0; i < num_targets; ++i)
        applies |= mxg_catalogue_has_option(option, cli_base_target(cli, targets[i]));
    return applies;
}

static void print_inapplicable(uint32_t option, const char *key, const char *const *targets,
                               size_t num_targets)
{
    fprintf(stderr, "mxgen: option '--%s' does not apply to", key);
    for (size_t i = 0; i < num_targets; ++i)
        fprintf(stderr, "%s '%s'", i ? "," : "", targets[i]);
    const char *before = "; it applies to";
    mxg_target target = {sizeof target};
    for (uint32_t i = 0; mxg_catalogue_target(i, &target) == MXG_OK; ++i) {
        if (!mxg_catalogue_has_option(option, target.name))
            continue;
        fprintf(stderr, "%s '%s'", before, target.name);
        before = ",";
    }
    fputc('\n', stderr);
}

bool cli_options_apply(const struct cli *cli, const char *const *targets, size_t num_targets)
{
    for (uint32_t option = 0; option < mxg_catalogue_num_options(); ++option) {
        mxg_option known = {sizeof known};
        mxg_catalogue_option(option, &known);
        if (applies_to_one(cli, option, targets, num_targets))
            continue;
        for (size_t i = 0; i < cli->parser.num_settings; ++i) {
            if (strcmp(cli->parser.settings[i].key, known.key) != 0)
                continue;
            print_inapplicable(option, known.key, targets, num_targets);
            return false;
        }
    }
    return true;
}
