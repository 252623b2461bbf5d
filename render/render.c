// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include "validate/compile.h"

#include <stdio.h>

/* The first error of the shader compiler: generated shaders should have none. */
static bool compile(struct bind *bind, struct compiled *compiled)
{
    const char *sources[MXG_NUM_STAGES];
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        sources[stage] = mxg_result_source(bind->result, (mxg_stage)stage, NULL);
    if (compile_program("vulkan", sources, compiled))
        return true;
    for (size_t i = 0; i < compiled->num_messages; ++i) {
        const struct compile_message *message = &compiled->messages[i];
        if (message->severity != MXG_SEVERITY_ERROR)
            continue;
        snprintf(bind->reason, sizeof bind->reason, "the shader does not compile: %s, line %u of the %s stage",
                 message->text, message->line, message->stage == MXG_STAGE_VERTEX ? "vertex" : "pixel");
        break;
    }
    return false;
}

bool render_result(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height, float *out_pixels)
{
    struct compiled compiled;
    bool good = compile(bind, &compiled) && bind_shader(bind);
    if (good) {
        for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
            bind->draw.code[stage] = compiled.stages[stage].words;
            bind->draw.code_words[stage] = compiled.stages[stage].num_words;
        }
        bind->draw.width = width;
        bind->draw.height = height;
        good = draw_run(gpu, &bind->draw, out_pixels);
        if (!good)
            snprintf(bind->reason, sizeof bind->reason, "%s", gpu->reason);
    }
    compiled_finish(&compiled);
    return good;
}
