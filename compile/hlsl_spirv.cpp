// SPDX-License-Identifier: Apache-2.0
#include "compile/hlsl_spirv.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <cstdlib>
#include <cstring>
#include <memory>

static const EShMessages messages = static_cast<EShMessages>(
    EShMsgSpvRules | EShMsgVulkanRules | EShMsgReadHlsl | EShMsgCascadingErrors);

static bool parse(glslang::TShader &shader, EShLanguage stage, const char *source)
{
    shader.setStrings(&source, 1);
    shader.setEntryPoint("main");
    shader.setSourceEntryPoint("main");
    shader.setEnvInput(glslang::EShSourceHlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    return shader.parse(GetDefaultResources(), 100, false, messages);
}

/* The legaliser would inline all calls: what it makes valid is valid here. */
static void make_module(glslang::TProgram &program, EShLanguage stage, hlsl_module &out)
{
    std::vector<unsigned> words;
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    options.generateDebugInfo = true;
    glslang::GlslangToSpv(*program.getIntermediate(stage), words, &options);
    out.words = static_cast<uint32_t *>(malloc(words.size() * sizeof *out.words));
    if (!out.words)
        return;
    out.num_words = words.size();
    memcpy(out.words, words.data(), words.size() * sizeof *out.words);
}

static bool link(glslang::TProgram &program, hlsl_module out_modules[])
{
    if (program.link(messages))
        return true;
    hlsl_module &pixel = out_modules[MXG_STAGE_PIXEL];
    free(pixel.log);
    pixel.log = strdup(program.getInfoLog());
    return false;
}

bool hlsl_compile(const char *const sources[], bool is_compute, hlsl_module out_modules[])
{
    const EShLanguage stages[MXG_NUM_STAGES] = {EShLangVertex,
                                                is_compute ? EShLangCompute : EShLangFragment};
    glslang::TProgram program;
    std::unique_ptr<glslang::TShader> shaders[MXG_NUM_STAGES];
    bool good = true;
    for (int i = 0; i < MXG_NUM_STAGES; ++i) {
        out_modules[i] = hlsl_module{};
        if (!sources[i])
            continue;
        shaders[i] = std::make_unique<glslang::TShader>(stages[i]);
        good &= parse(*shaders[i], stages[i], sources[i]);
        out_modules[i].log = strdup(shaders[i]->getInfoLog());
        program.addShader(shaders[i].get());
    }
    good = good && link(program, out_modules);
    for (int i = 0; i < MXG_NUM_STAGES && good; ++i)
        if (sources[i])
            make_module(program, stages[i], out_modules[i]);
    return good;
}

void hlsl_module_free(hlsl_module *module)
{
    free(module->words);
    free(module->log);
}
