// SPDX-License-Identifier: Apache-2.0
/* The results of all compilers have one form. */
#include "compile/command.h"
#include "compile/compile.h"
#include "compile/known.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void compiled_add(struct compiled *out, mxg_stage stage, mxg_severity severity, uint32_t line,
                  const char *text, size_t len)
{
    struct compile_message *more = realloc(out->messages, (out->num_messages + 1) * sizeof *more);
    char *copy = malloc(len + 1);
    if (more)
        out->messages = more;
    out->errors += severity == MXG_SEVERITY_ERROR;
    if (!more || !copy) {
        free(copy);
        return;
    }
    memcpy(copy, text, len);
    copy[len] = '\0';
    out->messages[out->num_messages++] = (struct compile_message){stage, severity, line, copy};
}

void compiled_finish(struct compiled *compiled)
{
    for (size_t i = 0; i < compiled->num_messages; ++i)
        free(compiled->messages[i].text);
    free(compiled->messages);
    for (size_t i = 0; i < compiled->num_places; ++i)
        free(compiled->places[i].name);
    free(compiled->places);
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        free(compiled->stages[stage].words);
    *compiled = (struct compiled){0};
}

/* "ND_image_color3.osl:12: text": no place of the document has such a line. */
static void add_part_message(struct compiled *out, const char *part,
                             const struct compile_message *message)
{
    size_t capacity = strlen(part) + strlen(message->text) + 32;
    char *text = malloc(capacity);
    if (text)
        snprintf(text, capacity, "%s.osl:%u: %s", part, message->line, message->text);
    const char *told = text ? text : message->text;
    compiled_add(out, message->stage, message->severity, 0, told, strlen(told));
    free(text);
}

static void compile_part(const char *target, const mxg_part *part, struct compiled *out)
{
    const char *sources[MXG_NUM_STAGES] = {NULL};
    struct compiled compiled = {0};
    sources[MXG_STAGE_PIXEL] = part->source;
    compile_program(target, sources, &compiled);
    for (size_t i = 0; i < compiled.num_messages; ++i)
        add_part_message(out, part->name, &compiled.messages[i]);
    out->stages[MXG_STAGE_PIXEL].body_instructions +=
        compiled.stages[MXG_STAGE_PIXEL].body_instructions;
    compiled_finish(&compiled);
}

/* ---- Functions ---- */

enum { MAX_ARGUMENTS = 8192 }; /* bytes of the arguments of a call */

#define ESSL_PRECISIONS \
    "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n" \
    "precision highp sampler2DArray;\n"
#define SLANG_STAGE "[shader(\"fragment\")] "

/* How a language declares functions. */
enum declarations { TYPE_FIRST, NAME_FIRST, IN_STRUCT, NUM_DECLARATIONS };

/*
 * The file of a host around a function, per target: what stands above it, and what calls it; `main`
 * NULL: functions that nothing calls are compiled, too. `scatter_main` calls scatter().
 * `feature_head` stands above, too, where the shader asks for a feature of the device. Functions of
 * the host have the text of `declarations`; they stand behind the source, or above it in the struct
 * that `struct_head` opens.
 */
static const struct host {
    const char *target, *head, *vec3, *output, *main, *scatter_main, *feature_head, *struct_head;
    enum declarations declarations;
} hosts[] = {
    {"glsl", "#version 450\n", "vec3", "out vec4 host_color;\n", "void main()", "void main()", "",
     NULL},
    {"vulkan", "#version 450\n", "vec3", "layout(location = 0) out vec4 host_color;\n",
     "void main()", "void main()", "", NULL},
    {"essl", "#version 300 es\n" ESSL_PRECISIONS, "vec3", "out vec4 host_color;\n", "void main()",
     "void main()", "", NULL},
    {"essl310", "#version 310 es\n" ESSL_PRECISIONS, "vec3",
     "layout(location = 0) out vec4 host_color;\n", "void main()", "void main()", "", NULL},
    {"hlsl", "", "float3", "", "void main(out float4 host_color : SV_Target0)", "void main()", "",
     NULL},
    {"slang", "", "float3", "", SLANG_STAGE "void fragmentMain(out float4 host_color : SV_Target0)",
     SLANG_STAGE "void main()", "", NULL},
    {"msl", "", "float3", "", NULL, NULL, "",
     "#include <metal_stdlib>\nusing namespace metal;\nstruct MxgHost {\n    int2 mxg_pixel;\n"
     "    const device float3 *read;\n    texture2d<float> sky;\n",
     IN_STRUCT},
    {"wgsl", "", "vec3f", "", NULL, NULL, "enable f16;\n", NULL, NAME_FIRST},
};

/*
 * Functions that a shader may ask its host for; $ is the type of three floats. A text that is NULL
 * is the first one.
 */
static const struct {
    const char *name, *texts[NUM_DECLARATIONS];
} host_functions[] = {
    {"mxg_light_count",
     {"int mxg_light_count() { return 2; }\n", "fn mxg_light_count() -> i32 { return 2; }\n"}},
    {"mxg_light",
     {"void mxg_light(int i, $ P, out $ L, out $ radiance) { L = normalize(P); radiance = P; }\n",
      "fn mxg_light(i: i32, P: $, L: ptr<function, $>, radiance: ptr<function, $>) { *L = "
      "normalize(P); *radiance = P; }\n",
      "void mxg_light(int i, $ P, thread $& L, thread $& radiance) { L = normalize(P); radiance = "
      "P; "
      "}\n"}},
    {"mxg_shadow",
     {"float mxg_shadow(int i, $ P, $ N, $ L) { return dot(N, L); }\n",
      "fn mxg_shadow(i: i32, P: $, N: $, L: $) -> f32 { return dot(N, L); }\n"}},
    {"mxg_ambient_occlusion",
     {"float mxg_ambient_occlusion($ P, $ N) { return dot(P, N); }\n",
      "fn mxg_ambient_occlusion(P: $, N: $) -> f32 { return dot(P, N); }\n"}},
    {"mxg_thickness",
     {"float mxg_thickness($ P, $ D) { return dot(P, D); }\n",
      "fn mxg_thickness(P: $, D: $) -> f32 { return dot(P, D); }\n"}},
    {"mxg_irradiance",
     {"$ mxg_irradiance($ P, $ N) { return P + N; }\n",
      "fn mxg_irradiance(P: $, N: $) -> $ { return P + N; }\n"}},
    {"mxg_radiance",
     {"$ mxg_radiance($ P, $ L, float roughness) { return P + L * roughness; }\n",
      "fn mxg_radiance(P: $, L: $, roughness: f32) -> $ { return P + L * roughness; }\n"}},
};
enum { NUM_HOST_FUNCTIONS = sizeof host_functions / sizeof *host_functions, MAX_HOST_TEXT = 4096 };

static bool calls(const char *source, const char *name)
{
    size_t len = strlen(name);
    for (const char *at = source; (at = strstr(at, name)) != NULL; at += len)
        if (at[len] == '(')
            return true;
    return false;
}

/* Writes those that a source calls, at most MAX_HOST_TEXT bytes. Returns their length. */
static size_t write_host_functions(const struct host *host, const char *source, char *out)
{
    size_t len = 0;
    for (size_t i = 0; i < NUM_HOST_FUNCTIONS; ++i) {
        const char *const *texts = host_functions[i].texts,
                          *text = texts[host->declarations] ? texts[host->declarations] : *texts;
        if (!calls(source, host_functions[i].name))
            continue;
        if (!len && host->struct_head)
            len = (size_t)sprintf(out, "%s", host->struct_head);
        for (; *text && len + strlen(host->vec3) < MAX_HOST_TEXT - 4; ++text)
            if (*text == '$')
                len += (size_t)sprintf(out + len, "%s", host->vec3);
            else
                out[len++] = *text;
    }
    if (len && host->struct_head)
        len += (size_t)sprintf(out + len, "};\n");
    out[len] = '\0';
    return len;
}

static const struct host *find_host(const char *target)
{
    for (size_t i = 0; i < sizeof hosts / sizeof *hosts; ++i)
        if (strcmp(hosts[i].target, target) == 0)
            return &hosts[i];
    return NULL;
}

static unsigned count_lines(const char *text)
{
    unsigned lines = 0;
    for (; *text; ++text)
        lines += *text == '\n';
    return lines;
}

/* "vec3 a0; int a1;" and "a0, a1": arguments of the types of the parameters. */
static void write_arguments(const mxg_result *result, bool declare, char *out, size_t capacity)
{
    mxg_block_info block = MXG_INIT(mxg_block_info);
    size_t len = 0;
    out[0] = '\0';
    mxg_result_block(result, MXG_BLOCK_VERTEX_DATA, &block);
    for (uint32_t i = 0; i < block.num_variables && len < capacity; ++i) {
        mxg_variable v = MXG_INIT(mxg_variable);
        mxg_result_variable(result, block.first_variable + i, &v);
        int more = declare ? snprintf(out + len, capacity - len, "%s a%u; ", v.type, i)
                           : snprintf(out + len, capacity - len, "%sa%u", i ? ", " : "", i);
        len += more > 0 ? (size_t)more : 0;
    }
}

/* A main that calls the function. */
static void write_caller(const struct host *host, const mxg_result *result,
                         const mxg_shader_info *info, char *out, size_t capacity)
{
    static const char of_surface[] = "host_color.xyz = s.color; host_color.w = s.alpha;",
                      of_words[] = "host_color.x = float(s.word_0);",
                      of_decal[] = "host_color = s.decal_albedo;";
    char declared[MAX_ARGUMENTS], given[MAX_ARGUMENTS];
    mxg_storage storage = MXG_INIT(mxg_storage);
    mxg_block_info outputs = MXG_INIT(mxg_block_info);
    mxg_variable first = MXG_INIT(mxg_variable);
    mxg_result_storage(result, &storage);
    mxg_result_block(result, MXG_BLOCK_OUTPUTS, &outputs);
    mxg_result_variable(result, outputs.first_variable, &first);
    bool is_decal = strcmp(first.name, "decal_albedo") == 0;
    write_arguments(result, true, declared, sizeof declared);
    write_arguments(result, false, given, sizeof given);
    snprintf(out, capacity, "%s%s\n{\n    %s\n    %s s = %s(%s);\n    %s\n}\n", host->output,
             host->main, declared, info->function_type, info->function, given,
             is_decal        ? of_decal
             : storage.words ? of_words
                             : of_surface);
}

/* A source in the file of a host. */
struct hosted {
    char *text;     /* malloc; NULL: no memory */
    unsigned above; /* lines above the source */
};

/* Puts a source between two texts, with functions of the host that it calls. */
static struct hosted surround(const struct host *host, const char *above, const char *source,
                              const char *behind)
{
    char functions[MAX_HOST_TEXT];
    size_t len = write_host_functions(host, source, functions),
           capacity = strlen(above) + len + strlen(source) + strlen(behind) + 2;
    const char *inside = host->struct_head ? functions : "",
               *after = host->struct_head ? "" : functions;
    struct hosted hosted = {malloc(capacity), count_lines(above) + count_lines(inside)};
    if (hosted.text)
        snprintf(hosted.text, capacity, "%s%s%s\n%s%s", above, inside, source, after, behind);
    return hosted;
}

/* Lines of messages count from the source on. */
static void free_hosted(struct hosted *hosted, struct compiled *out)
{
    for (size_t i = 0; i < out->num_messages; ++i)
        if (out->messages[i].stage == MXG_STAGE_PIXEL && out->messages[i].line > hosted->above)
            out->messages[i].line -= hosted->above;
    free(hosted->text);
}

static bool compile_hosted(const char *target, const char *vertex, struct hosted *hosted,
                           struct compiled *out)
{
    const char *const sources[MXG_NUM_STAGES] = {vertex, hosted->text};
    bool good = hosted->text && compile_program(target, sources, out);
    free_hosted(hosted, out);
    return good;
}

bool compile_pass(const char *target, const char *source, struct compiled *out)
{
    const struct host *host = find_host(target);
    *out = (struct compiled){0};
    if (!host)
        return false;
    struct hosted hosted = surround(host, "", source, "");
    bool good = hosted.text && compile_compute(target, hosted.text, out);
    free_hosted(&hosted, out);
    return good;
}

/* Compiles a function in the file of a host. */
static bool compile_function(const char *target, const mxg_result *result,
                             const mxg_shader_info *info, struct compiled *out)
{
    const struct host *host = find_host(target);
    char above[1024], behind[3 * MAX_ARGUMENTS] = "";
    *out = (struct compiled){0};
    if (!host)
        return false;
    snprintf(above, sizeof above, "%s%s", *info->device_features ? host->feature_head : "",
             host->head);
    if (host->main)
        write_caller(host, result, info, behind, sizeof behind);
    struct hosted hosted =
        surround(host, above, mxg_result_source(result, MXG_STAGE_PIXEL, NULL), behind);
    return compile_hosted(target, NULL, &hosted, out);
}

/* A function scatter() of a path tracer has a main where a compiler asks for a program. */
static bool compile_stages(const char *target, const mxg_result *result, const char *function,
                           struct compiled *out)
{
    const struct host *host = find_host(target);
    const char *sources[MXG_NUM_STAGES];
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        sources[stage] = mxg_result_source(result, (mxg_stage)stage, NULL);
    if (!host || !sources[MXG_STAGE_PIXEL])
        return compile_program(target, sources, out);
    char main[1024] = "";
    if (host->scatter_main && *function)
        snprintf(main, sizeof main, "%s\n{\n    %s();\n}\n", host->scatter_main, function);
    *out = (struct compiled){0};
    struct hosted hosted = surround(host, "", sources[MXG_STAGE_PIXEL], main);
    return compile_hosted(target, sources[MXG_STAGE_VERTEX], &hosted, out);
}

bool compile_result(const char *target, const mxg_result *result, struct compiled *out)
{
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    bool has_info = mxg_result_info(result, &info) == MXG_OK;
    if (has_info && info.function_type[0])
        return compile_function(target, result, &info, out);
    if (mxg_result_num_parts(result) == 0)
        return compile_stages(target, result, has_info ? info.function : "", out);
    *out = (struct compiled){0};
    for (uint32_t i = 0; i < mxg_result_num_parts(result); ++i) {
        mxg_part part = {sizeof part};
        mxg_result_part(result, i, &part);
        compile_part(target, &part, out);
    }
    return out->errors == 0;
}

/* Results whose code was not compiled yet. */
static void compile_new_results(const char *target, const mxg_result *const *results, size_t count,
                                struct compiled *outs)
{
    const char **sources = command_takes_modules(target) ? calloc(count, sizeof *sources) : NULL;
    for (size_t i = 0; i < count; ++i) {
        if (sources)
            sources[i] = mxg_result_source(results[i], MXG_STAGE_PIXEL, NULL);
        else
            compile_result(target, results[i], &outs[i]);
    }
    if (sources)
        command_compile_modules(target, sources, count, outs);
    free(sources);
}

void compile_results(const char *target, const mxg_result *const *results, size_t count,
                     struct compiled outs[COMPILE_MAX_RESULTS])
{
    const mxg_result *fresh[COMPILE_MAX_RESULTS];
    struct compiled compiled[COMPILE_MAX_RESULTS] = {0};
    uint64_t keys[COMPILE_MAX_RESULTS];
    size_t places[COMPILE_MAX_RESULTS], num_fresh = 0;
    for (size_t i = 0; i < count; ++i) {
        outs[i] = (struct compiled){0};
        keys[num_fresh] = known_key(target, results[i]);
        if (known_find(keys[num_fresh], &outs[i]))
            continue;
        places[num_fresh] = i;
        fresh[num_fresh++] = results[i];
    }
    compile_new_results(target, fresh, num_fresh, compiled);
    for (size_t i = 0; i < num_fresh; ++i) {
        outs[places[i]] = compiled[i];
        if (compiled[i].num_messages == 0)
            known_add(keys[i], &compiled[i]);
    }
}
