// SPDX-License-Identifier: Apache-2.0
#include "compile/compile.h"
#include "compile/command.h"
#include "compile/hlsl_spirv.h"
#include "compile/spirv.h"
#include "compile/compiler_process.h"

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>
#include <spirv-tools/libspirv.h>

#include <stdlib.h>
#include <string.h>

/* How a target's shaders are read. */
struct dialect {
    const char *target;
    glslang_client_t client;
    glslang_target_client_version_t client_version;
    glslang_profile_t profile;
    bool is_spirv_source; /* written for SPIR-V: every location and binding stands in the source */
    int spirv_version;    /* #version under which SPIR-V is made; 0: the source's own */
    spv_target_env environment; /* whose rules the SPIR-V keeps, if the source is written for it */
};

static const struct dialect dialects[] = {
    {"glsl", GLSLANG_CLIENT_OPENGL, GLSLANG_TARGET_OPENGL_450, GLSLANG_CORE_PROFILE, false, 0, 0},
    {"vulkan", GLSLANG_CLIENT_VULKAN, GLSLANG_TARGET_VULKAN_1_0, GLSLANG_CORE_PROFILE, true, 0,
     SPV_ENV_VULKAN_1_0},
    /* There is no SPIR-V of ESSL 3.00; 3.10 contains it. */
    {"essl", GLSLANG_CLIENT_OPENGL, GLSLANG_TARGET_OPENGL_450, GLSLANG_ES_PROFILE, false, 310, 0},
    {"essl310", GLSLANG_CLIENT_OPENGL, GLSLANG_TARGET_OPENGL_450, GLSLANG_ES_PROFILE, true, 0,
     SPV_ENV_OPENGL_4_5},
};

static const glslang_stage_t glslang_stages[MXG_NUM_STAGES] = {GLSLANG_STAGE_VERTEX,
                                                               GLSLANG_STAGE_FRAGMENT};

void compile_begin(void)
{
    glslang_initialize_process();
}

void compile_end(void)
{
    workers_end();
    command_end();
    glslang_finalize_process();
}

static const struct dialect *find_dialect(const char *target)
{
    for (size_t i = 0; i < sizeof dialects / sizeof *dialects; ++i) {
        if (strcmp(target, dialects[i].target) == 0)
            return &dialects[i];
    }
    return NULL;
}

bool compile_knows_target(const char *target)
{
    return find_dialect(target) || strcmp(target, "hlsl") == 0 || command_knows_target(target)
           || worker_knows_target(target);
}

/* ---- Messages ---- */

/*
 * One line of a log, "ERROR: 0:12: 'x' : undeclared identifier"; the first number is the source
 * string.
 */
static void add_log_line(struct compiled *out, mxg_stage stage, const char *text, size_t len)
{
    static const char error[] = "ERROR: ", warning[] = "WARNING: ";
    bool is_error = len > sizeof error && memcmp(text, error, sizeof error - 1) == 0;
    bool is_warning = len > sizeof warning && memcmp(text, warning, sizeof warning - 1) == 0;
    if (!is_error && !is_warning)
        return;
    const char *end = text + len;
    text += is_error ? sizeof error - 1 : sizeof warning - 1;
    unsigned long line = 0;
    if (*text == '0' && text[1] == ':') {
        char *behind;
        line = strtoul(text + 2, &behind, 10);
        text = *behind == ':' ? behind + 2 : behind;
    }
    if (line == 0 && strstr(text, "compilation errors") == text + strspn(text, "0123456789 "))
        return; /* "2 compilation errors. No code generated." */
    compiled_add(out, stage, is_error ? MXG_SEVERITY_ERROR : MXG_SEVERITY_WARNING, (uint32_t)line,
                 text, text < end ? (size_t)(end - text) : 0);
}

static void add_log(struct compiled *out, mxg_stage stage, const char *log)
{
    for (const char *line = log; line && *line;) {
        size_t len = strcspn(line, "\n");
        add_log_line(out, stage, line, len);
        line += len + (line[len] == '\n');
    }
}

/* ---- GLSL ---- */

static glslang_input_t input_of(const struct dialect *dialect, glslang_stage_t stage,
                                const char *source, bool to_spirv)
{
    int messages = GLSLANG_MSG_CASCADING_ERRORS_BIT;
    if (to_spirv)
        messages |= GLSLANG_MSG_SPV_RULES_BIT;
    if (dialect->client == GLSLANG_CLIENT_VULKAN)
        messages |= GLSLANG_MSG_VULKAN_RULES_BIT;
    return (glslang_input_t){
        .language = GLSLANG_SOURCE_GLSL,
        .stage = stage,
        .client = to_spirv ? dialect->client : GLSLANG_CLIENT_NONE,
        .client_version = dialect->client_version,
        .target_language = to_spirv ? GLSLANG_TARGET_SPV : GLSLANG_TARGET_NONE,
        .target_language_version = GLSLANG_TARGET_SPV_1_0,
        .code = source,
        .default_version = 100,
        .default_profile = dialect->profile,
        .messages = (glslang_messages_t)messages,
        .resource = glslang_default_resource(),
    };
}

static glslang_shader_t *parse_stage(const struct dialect *dialect, mxg_stage stage,
                                     const char *source, bool to_spirv, struct compiled *out)
{
    glslang_input_t input = input_of(dialect, glslang_stages[stage], source, to_spirv);
    glslang_shader_t *shader = glslang_shader_create(&input);
    if (to_spirv && !dialect->is_spirv_source) {
        glslang_shader_set_options(shader, GLSLANG_SHADER_AUTO_MAP_BINDINGS
                                               | GLSLANG_SHADER_AUTO_MAP_LOCATIONS);
        if (dialect->spirv_version)
            glslang_shader_set_glsl_version(shader, dialect->spirv_version);
    }
    bool good = glslang_shader_preprocess(shader, &input) && glslang_shader_parse(shader, &input);
    if (!good || !to_spirv || dialect->is_spirv_source) /* warnings are told once */
        add_log(out, stage, glslang_shader_get_info_log(shader));
    if (good)
        return shader;
    glslang_shader_delete(shader);
    return NULL;
}

/* ---- SPIR-V ---- */

#define SPIRV_MAGIC 0x07230203u

/*
 * Only of shaders that are written for SPIR-V: glslang has no valid form for a loose uniform that
 * is a bool.
 */
static void validate_spirv(mxg_stage stage, spv_target_env environment, struct compiled *out)
{
    const struct compiled_stage *code = &out->stages[stage];
    spv_context context = spvContextCreate(environment);
    spv_diagnostic diagnostic = NULL;
    if (spvValidateBinary(context, code->words, code->num_words, &diagnostic) != SPV_SUCCESS) {
        const char *text = diagnostic ? diagnostic->error : "invalid SPIR-V";
        compiled_add(out, stage, MXG_SEVERITY_ERROR, 0, text, strlen(text));
    }
    spvDiagnosticDestroy(diagnostic);
    spvContextDestroy(context);
}

static void generate_spirv(const struct dialect *dialect, glslang_program_t *program,
                           mxg_stage stage, struct compiled *out)
{
    struct compiled_stage *code = &out->stages[stage];
    /* lines, for spirv_count */
    glslang_spv_options_t options = {.disable_optimizer = true, .generate_debug_info = true};
    glslang_program_SPIRV_generate_with_options(program, glslang_stages[stage], &options);
    add_log(out, stage, glslang_program_SPIRV_get_messages(program));
    const unsigned *words = glslang_program_SPIRV_get_ptr(program);
    size_t num_words = glslang_program_SPIRV_get_size(program);
    /* glslang 12 appends a stage's module to those made before from the same program. */
    size_t before = stage == MXG_STAGE_PIXEL ? out->stages[MXG_STAGE_VERTEX].num_words : 0;
    if (before && num_words > before && words[before] == SPIRV_MAGIC) {
        words += before;
        num_words -= before;
    }
    code->words = malloc(num_words * sizeof *code->words);
    if (!code->words)
        return;
    code->num_words = num_words;
    memcpy(code->words, words, num_words * sizeof *code->words);
    code->body_instructions = spirv_count(code->words, code->num_words, NULL, NULL);
    if (dialect->is_spirv_source)
        validate_spirv(stage, dialect->environment, out);
}

static const char unexplained[] = "the stages do not link";

static bool link_stages(const struct dialect *dialect, glslang_program_t *program, bool to_spirv,
                        struct compiled *out)
{
    int messages = (int)input_of(dialect, GLSLANG_STAGE_FRAGMENT, NULL, to_spirv).messages;
    bool linked = glslang_program_link(program, messages);
    if (linked && to_spirv && !dialect->is_spirv_source)
        linked = glslang_program_map_io(program);
    if (linked)
        return true;
    add_log(out, MXG_STAGE_PIXEL, glslang_program_get_info_log(program));
    if (out->errors == 0)
        compiled_add(out, MXG_STAGE_PIXEL, MXG_SEVERITY_ERROR, 0, unexplained,
                     sizeof unexplained - 1);
    return false;
}

/* Parses and links the stages once: as the language itself, or towards SPIR-V. */
static void compile_once(const struct dialect *dialect, const char *const sources[MXG_NUM_STAGES],
                         bool to_spirv, struct compiled *out)
{
    glslang_program_t *program = glslang_program_create();
    glslang_shader_t *shaders[MXG_NUM_STAGES] = {0};
    bool good = true;
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        if (!sources[stage])
            continue;
        shaders[stage] = parse_stage(dialect, (mxg_stage)stage, sources[stage], to_spirv, out);
        good = good && shaders[stage];
        if (shaders[stage])
            glslang_program_add_shader(program, shaders[stage]);
    }
    good = good && link_stages(dialect, program, to_spirv, out);
    for (int stage = 0; good && to_spirv && stage < MXG_NUM_STAGES; ++stage) {
        if (shaders[stage])
            generate_spirv(dialect, program, (mxg_stage)stage, out);
    }
    glslang_program_delete(program);
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        if (shaders[stage])
            glslang_shader_delete(shaders[stage]);
    }
}

/* Vulkan 1.1 is the first to allow the packing of constant buffers. */
static bool compile_hlsl(const char *const sources[MXG_NUM_STAGES], bool is_compute,
                         struct compiled *out)
{
    struct hlsl_module modules[MXG_NUM_STAGES];
    bool good = hlsl_compile(sources, is_compute, modules);
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        struct hlsl_module *module = &modules[stage];
        struct compiled_stage *code = &out->stages[stage];
        add_log(out, (mxg_stage)stage, module->log);
        if (good && module->words) {
            code->words = module->words;
            code->num_words = module->num_words;
            module->words = NULL;
            code->body_instructions = spirv_count(code->words, code->num_words, NULL, NULL);
            validate_spirv((mxg_stage)stage, SPV_ENV_VULKAN_1_1, out);
        }
        hlsl_module_free(module);
    }
    if (!good && out->errors == 0)
        compiled_add(out, MXG_STAGE_PIXEL, MXG_SEVERITY_ERROR, 0, unexplained,
                     sizeof unexplained - 1);
    return out->errors == 0;
}

static bool compile_by_worker(const char *target, const char *const sources[MXG_NUM_STAGES],
                              struct compiled *out)
{
    worker_compile_program(target, sources, out);
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        if (out->stages[stage].words)
            validate_spirv((mxg_stage)stage, SPV_ENV_VULKAN_1_2, out);
    return out->errors == 0;
}

bool compile_program(const char *target, const char *const sources[MXG_NUM_STAGES],
                     struct compiled *out)
{
    *out = (struct compiled){0};
    if (command_knows_target(target))
        return command_compile_program(target, sources, out);
    if (worker_knows_target(target))
        return compile_by_worker(target, sources, out);
    if (strcmp(target, "hlsl") == 0)
        return compile_hlsl(sources, false, out);
    const struct dialect *dialect = find_dialect(target);
    if (!dialect) {
        compiled_add(out, MXG_STAGE_PIXEL, MXG_SEVERITY_ERROR, 0, "unknown dialect", 15);
        return false;
    }
    if (!dialect->is_spirv_source)
        compile_once(dialect, sources, false, out);
    if (out->errors == 0)
        compile_once(dialect, sources, true, out);
    return out->errors == 0;
}

static bool compile_glsl_compute(const char *source, struct compiled *out)
{
    glslang_input_t input = input_of(find_dialect("vulkan"), GLSLANG_STAGE_COMPUTE, source, true);
    glslang_shader_t *shader = glslang_shader_create(&input);
    glslang_program_t *program = glslang_program_create();
    bool good = glslang_shader_preprocess(shader, &input) && glslang_shader_parse(shader, &input);
    if (good) {
        glslang_program_add_shader(program, shader);
        good = glslang_program_link(program, (int)input.messages);
    }
    add_log(out, MXG_STAGE_PIXEL, glslang_shader_get_info_log(shader));
    if (good) {
        glslang_program_SPIRV_generate(program, GLSLANG_STAGE_COMPUTE);
        struct compiled_stage *code = &out->stages[MXG_STAGE_PIXEL];
        code->num_words = glslang_program_SPIRV_get_size(program);
        code->words = malloc(code->num_words * sizeof *code->words);
        good = code->words != NULL;
        if (good)
            memcpy(code->words, glslang_program_SPIRV_get_ptr(program),
                   code->num_words * sizeof *code->words);
    }
    glslang_program_delete(program);
    glslang_shader_delete(shader);
    return good;
}

bool compile_compute(const char *target, const char *source, struct compiled *out)
{
    const char *const sources[MXG_NUM_STAGES] = {[MXG_STAGE_PIXEL] = source};
    *out = (struct compiled){0};
    return worker_knows_target(target)   ? compile_by_worker(target, sources, out)
           : strcmp(target, "hlsl") == 0 ? compile_hlsl(sources, true, out)
                                         : compile_glsl_compute(source, out);
}
