// SPDX-License-Identifier: Apache-2.0
/* GLSL to SPIR-V by glslang. */
#include "spirv.h"

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t *take_words(glslang_program_t *program, glslang_stage_t stage, size_t *out_bytes)
{
    glslang_program_SPIRV_generate(program, stage);
    *out_bytes = glslang_program_SPIRV_get_size(program) * sizeof(uint32_t);
    uint32_t *words = malloc(*out_bytes);
    if (words)
        memcpy(words, glslang_program_SPIRV_get_ptr(program), *out_bytes);
    return words;
}

/* Once for the program: glslang parses its own functions here. */
static void begin(void)
{
    static bool has_begun;
    if (has_begun)
        return;
    has_begun = true;
    glslang_initialize_process();
    atexit(glslang_finalize_process);
}

uint32_t *compile_spirv(const char *source, VkShaderStageFlagBits stage, size_t *out_bytes)
{
    glslang_stage_t kind = stage == VK_SHADER_STAGE_VERTEX_BIT     ? GLSLANG_STAGE_VERTEX
                           : stage == VK_SHADER_STAGE_FRAGMENT_BIT ? GLSLANG_STAGE_FRAGMENT
                                                                   : GLSLANG_STAGE_COMPUTE;
    int rules = GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT;
    glslang_input_t input = {
        .language = GLSLANG_SOURCE_GLSL,
        .stage = kind,
        .client = GLSLANG_CLIENT_VULKAN,
        .client_version = GLSLANG_TARGET_VULKAN_1_0,
        .target_language = GLSLANG_TARGET_SPV,
        .target_language_version = GLSLANG_TARGET_SPV_1_0,
        .code = source,
        .default_version = 450,
        .default_profile = GLSLANG_NO_PROFILE,
        .messages = (glslang_messages_t)rules,
        .resource = glslang_default_resource(),
    };
    begin();
    glslang_shader_t *shader = glslang_shader_create(&input);
    glslang_program_t *program = glslang_program_create();
    uint32_t *words = NULL;
    bool parsed = glslang_shader_preprocess(shader, &input) && glslang_shader_parse(shader, &input);
    if (parsed)
        glslang_program_add_shader(program, shader);
    if (parsed && glslang_program_link(program, rules))
        words = take_words(program, kind, out_bytes);
    else
        fprintf(stderr, "%s%s", glslang_shader_get_info_log(shader),
                glslang_program_get_info_log(program));
    glslang_program_delete(program);
    glslang_shader_delete(shader);
    return words;
}
