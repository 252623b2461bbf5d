// SPDX-License-Identifier: Apache-2.0
/*
 * Options that have no meaning with a role or with each other: every pair of their values is
 * generated. A pair of src/api/combinations.def, or of a task that a role lacks, is an error that
 * names both options, and all others give a shader. A depth pass does not depend on options of
 * light and storage.
 */
#include <mxgen/mxgen.h>

#include "spell/target.h"
#include "test.h"

#include <string.h>

struct row {
    const char *option, *value, *other, *other_value; /* other_value NULL: any but the default */
};

static const struct row values[] = {
#define ROLE_VALUE(role, option, value, why) {"role", #role, #option, value},
#define COMBINATION(option, value, other, other_value, why) {#option, value, #other, other_value},
#include "api/combinations.def"
#undef ROLE_VALUE
#undef COMBINATION
};
enum { NUM_VALUES = sizeof values / sizeof *values, MAX_ROWS = 128 };

static const struct task {
    const char *option;
    enum role_task task;
} tasks[] = {
#define OPTION(id, key, type, caps, task, values, initial, doc) {#id, TASK_##task},
#include "api/options.def"
#undef OPTION
};

/* The rows of combinations.def, and those of the tasks that roles of the option lack. */
static struct row rows[MAX_ROWS];
static size_t num_rows;

static void find_rows(void)
{
    for (size_t i = 0; i < NUM_VALUES; i++)
        rows[num_rows++] = values[i];
    for (int role = 0; role < ROLE_closures; role++)
        for (size_t i = 0; i < sizeof tasks / sizeof *tasks; i++)
            if (roles[role].lacks[tasks[i].task] && REQUIRE(num_rows < MAX_ROWS))
                rows[num_rows++] = (struct row){"role", roles[role].name, tasks[i].option, NULL};
}

/* The values of the options that have rows; the first is the default, "" where it is not set. */
static const struct setting {
    const char *id, *key, *values[8];
} settings[] = {
    {"role",
     "role",
     {"raster", "function", "path", "scatter", "deferred", "depth", "payload", "pack"}},
    {"storage", "storage", {"dither", "round", "float"}},
    {"decals", "decals", {"over", "images"}},
    {"sss", "sss", {"wrap", "diffusion"}},
    {"rough_refraction", "rough-refraction", {"sharp", "blur"}},
    {"slots", "slots", {"blend", "stochastic"}},
    {"transparency", "transparency", {"auto", "opaque", "mask", "blend", "dual"}},
    {"transmission", "transmission", {"refraction", "opacity"}},
    {"layering", "layering", {"view", "two-sided", "occluding"}},
    {"encode", "encode", {"linear", "srgb"}},
    {"occlusion_map", "occlusion-map", {"false", "true"}},
    {"shadow_map", "shadow-map", {"false", "true"}},
    {"host_lights", "host-lights", {"false", "true"}},
    {"host_shadows", "host-shadows", {"false", "true"}},
    {"host_occlusion", "host-occlusion", {"false", "true"}},
    {"host_environment", "host-environment", {"false", "true"}},
    {"host_thickness", "host-thickness", {"false", "true"}},
    {"environment", "environment", {"importance", "prefiltered", "none"}},
    {"ambient_occlusion", "ambient-occlusion", {"map", "primvar", "none"}},
    {"quality", "quality", {"good", "reference"}},
    {"lights", "lights", {"", "point_light=2"}},
    {"max_lights", "max-lights", {"3", "8"}},
};
enum { NUM_SETTINGS = sizeof settings / sizeof *settings };
enum { DEFERRED = 4 }; /* of the first */

static const char *key_of(const char *id)
{
    size_t i = 0;
    while (strcmp(settings[i].id, id) != 0)
        i++;
    return settings[i].key;
}

struct run {
    mxg_context *context;
    mxg_document *document;
    bool is_found[MAX_ROWS];
    unsigned good, bad;
};

/* A value of an option. */
struct choice {
    const struct setting *setting;
    size_t value;
};

static const char *text_of(struct choice choice)
{
    return choice.setting->values[choice.value];
}

static bool is_row(const struct row *row, struct choice a, struct choice b)
{
    bool has_other = row->other_value ? strcmp(row->other_value, text_of(b)) == 0 : b.value > 0;
    return strcmp(row->option, a.setting->id) == 0 && strcmp(row->value, text_of(a)) == 0
           && strcmp(row->other, b.setting->id) == 0 && has_other;
}

/* The row of a pair, in any order; num_rows: there is none. */
static size_t row_of(struct choice a, struct choice b)
{
    size_t found = num_rows;
    for (size_t r = 0; r < num_rows; r++)
        if (is_row(&rows[r], a, b) || is_row(&rows[r], b, a)) {
            REQUIRE(found == num_rows);
            found = r;
        }
    return found;
}

/* The message of the only diagnostic names both options. */
static void check_message(const mxg_result *result, const struct row *row)
{
    char one[64], two[64];
    mxg_diagnostic diagnostic = {sizeof diagnostic};
    const mxg_diagnostics *list = mxg_result_diagnostics(result);
    snprintf(one, sizeof one, "'%s=%s'", key_of(row->option), row->value);
    snprintf(two, sizeof two, row->other_value ? "'%s=%s'" : "'%s'", key_of(row->other),
             row->other_value ? row->other_value : "");
    if (REQUIRE_EQ(mxg_diagnostics_num_items(list), 1)
        && REQUIRE(mxg_diagnostics_item(list, 0, &diagnostic) == MXG_OK))
        REQUIRE(strstr(diagnostic.message, one) && strstr(diagnostic.message, two));
}

/* Options of what is stored have a meaning with the role deferred alone. */
static bool is_of_storage(struct choice choice)
{
    return choice.value > 0
           && (strcmp(choice.setting->id, "storage") == 0
               || strcmp(choice.setting->id, "decals") == 0
               || strcmp(choice.setting->id, "sss") == 0);
}

/* Generates with the options; their rows are the errors, and without one there is a shader. */
static void test_choices(struct run *run, const struct choice *choices, size_t count)
{
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    size_t size = 0, num_found = 0, row = num_rows;
    REQUIRE(mxg_options_create(run->context, &options) == MXG_OK);
    for (size_t i = 0; i < count; i++) {
        const char *value = text_of(choices[i]);
        REQUIRE(!*value || mxg_options_set(options, choices[i].setting->key, value) == MXG_OK);
        for (size_t k = 0; k < i; k++) {
            size_t found = row_of(choices[i], choices[k]);
            row = found < num_rows ? found : row;
            num_found += found < num_rows;
        }
    }
    desc.target = "vulkan";
    desc.element = "SR";
    desc.options = options;
    mxg_status status = mxg_generate(run->context, run->document, &desc, &result);
    if (!REQUIRE((status == MXG_OK) == (num_found == 0)))
        for (size_t i = 0; i < count; i++)
            printf("    %s=%s\n", choices[i].setting->key, text_of(choices[i]));
    else if (num_found == 0)
        REQUIRE(mxg_result_source(result, MXG_STAGE_PIXEL, &size) && size > 0);
    else if (num_found == 1) {
        check_message(result, &rows[row]);
        run->is_found[row] = true;
    } else
        REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(result)), num_found);
    run->good += num_found == 0;
    run->bad += num_found != 0;
    mxg_result_destroy(result);
    mxg_options_destroy(options);
}

static void test_pair(struct run *run, struct choice a, struct choice b)
{
    bool has_role = a.setting == settings || b.setting == settings;
    struct choice choices[3] = {a, b, {settings, DEFERRED}};
    test_choices(run, choices, !has_role && (is_of_storage(a) || is_of_storage(b)) ? 3 : 2);
}

static void test_options(struct run *run, const struct setting *a, const struct setting *b)
{
    enum { MAX_VALUES = sizeof a->values / sizeof *a->values };
    for (size_t i = 0; i < MAX_VALUES && a->values[i]; i++)
        for (size_t k = 0; k < MAX_VALUES && b->values[k]; k++)
            test_pair(run, (struct choice){a, i}, (struct choice){b, k});
}

/* ---- Depth passes ---- */

/* The depth pass of a cut-out; one option more unless key is NULL. */
static mxg_result *generate_depth(const struct run *run, const char *key, const char *value)
{
    mxg_options *options = NULL;
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    REQUIRE(mxg_options_create(run->context, &options) == MXG_OK);
    REQUIRE(mxg_options_set(options, "role", "depth") == MXG_OK);
    REQUIRE(mxg_options_set(options, "transparency", "mask") == MXG_OK);
    REQUIRE(!key || mxg_options_set(options, key, value) == MXG_OK);
    desc.target = "vulkan";
    desc.element = "holes";
    desc.options = options;
    REQUIRE(mxg_generate(run->context, run->document, &desc, &result) == MXG_OK);
    mxg_options_destroy(options);
    return result;
}

static void test_depth(const struct run *run)
{
    static const struct {
        const char *key, *value;
    } without[] = {
        {"lights", "point_light=2"},  {"max-lights", "8"},         {"shadow-map", "true"},
        {"quality", "reference"},     {"encode", "srgb"},          {"storage", "float"},
        {"sss", "diffusion"},         {"layering", "two-sided"},   {"layering", "occluding"},
        {"rough-refraction", "blur"}, {"transmission", "opacity"}, {"host-lights", "true"},
        {"host-shadows", "true"},     {"host-occlusion", "true"},  {"host-environment", "true"},
        {"host-thickness", "true"}};
    mxg_result *plain = generate_depth(run, NULL, NULL);
    const char *text = mxg_result_source(plain, MXG_STAGE_PIXEL, NULL);
    REQUIRE(text && strstr(text, "discard"));
    for (size_t i = 0; i < sizeof without / sizeof *without; i++) {
        mxg_result *other = generate_depth(run, without[i].key, without[i].value);
        const char *same = mxg_result_source(other, MXG_STAGE_PIXEL, NULL);
        if (!REQUIRE(same && strcmp(text, same) == 0))
            printf("    %s=%s\n", without[i].key, without[i].value);
        mxg_result_destroy(other);
    }
    mxg_result_destroy(plain);
}

/* True if an option of a row is among the settings. */
static bool is_tried(const struct row *row)
{
    for (size_t i = 0; i < NUM_SETTINGS; i++)
        if (strcmp(settings[i].id, row->other) == 0)
            return true;
    return false;
}

int main(void)
{
    static const char text[] =
        "<materialx version='1.39'><slab name='matter' type='BSDF'/>"
        "<slab_surface name='SR' type='surfaceshader'>"
        "<input name='bsdf' type='BSDF' nodename='matter'/></slab_surface>"
        "<surface name='holes' type='surfaceshader'>"
        "<input name='bsdf' type='BSDF' nodename='matter'/>"
        "<input name='opacity' type='float' value='0.5'/></surface></materialx>";
    struct run run = {.good = 0};
    find_rows();
    REQUIRE(mxg_context_create(NULL, &run.context) == MXG_OK);
    mxg_library *library = mxg_library_builtin(run.context);
    REQUIRE(mxg_document_parse(run.context, library, "c.mtlx", text, strlen(text), &run.document)
            == MXG_OK);
    for (size_t i = 0; i < NUM_SETTINGS; i++)
        for (size_t k = i + 1; k < NUM_SETTINGS; k++)
            test_options(&run, &settings[i], &settings[k]);
    for (size_t r = 0; r < num_rows; r++)
        if (!REQUIRE(run.is_found[r] || !is_tried(&rows[r])))
            printf("    no pair has %s=%s, %s\n", rows[r].option, rows[r].value, rows[r].other);
    test_depth(&run);
    printf("%u pairs with a meaning, %u without\n", run.good, run.bad);
    mxg_document_destroy(run.document);
    mxg_library_unref(library);
    mxg_context_destroy(run.context);
    return test_report("combinations");
}
