// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include <stdio.h>

/* Reports the first error of the shader compiler: generated shaders should have none. */
static bool compile(struct bind *bind, struct compiled *compiled)
{
    const char *sources[MXG_NUM_STAGES];
    mxg_shader_info info = {sizeof info};
    if (mxg_result_info(bind->result, &info) != MXG_OK)
        return false;
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        sources[stage] = mxg_result_source(bind->result, (mxg_stage)stage, NULL);
    if (compile_program(info.target, sources, compiled))
        return true;
    for (size_t i = 0; i < compiled->num_messages; ++i) {
        const struct compile_message *message = &compiled->messages[i];
        if (message->severity != MXG_SEVERITY_ERROR)
            continue;
        bind->id = "bad-shader";
        snprintf(bind->reason, sizeof bind->reason,
                 "the shader does not compile: %s, line %u of the %s stage", message->text,
                 message->line, message->stage == MXG_STAGE_VERTEX ? "vertex" : "pixel");
        break;
    }
    return false;
}

static bool copy_reason(struct render *render)
{
    render->bind->id = render->gpu->id;
    snprintf(render->bind->reason, sizeof render->bind->reason, "%s", render->gpu->reason);
    return false;
}

bool render_open(struct render *render, struct gpu *gpu, struct bind *bind, uint32_t width,
                 uint32_t height)
{
    *render = (struct render){.gpu = gpu, .bind = bind};
    if (!compile(bind, &render->compiled) || !bind_shader(bind))
        return false;
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        bind->draw.code[stage] = render->compiled.stages[stage].words;
        bind->draw.code_words[stage] = render->compiled.stages[stage].num_words;
    }
    bind->draw.width = width;
    bind->draw.height = height;
    render->program = draw_open(gpu, &bind->draw);
    return render->program || copy_reason(render);
}

bool render_frame(struct render *render, float *out_pixels)
{
    return bind_scene(render->bind)
           && (draw_frame(render->program, out_pixels) || copy_reason(render));
}

void render_close(struct render *render)
{
    draw_close(render->program);
    compiled_finish(&render->compiled);
}

bool render_result(struct gpu *gpu, struct bind *bind, uint32_t width, uint32_t height,
                   float *out_pixels)
{
    struct render render;
    bool good = render_open(&render, gpu, bind, width, height) && render_frame(&render, out_pixels);
    render_close(&render);
    return good;
}
