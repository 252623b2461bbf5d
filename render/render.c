// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include "render/unwrap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *target_of(const struct bind *bind)
{
    mxg_shader_info info = {sizeof info};
    if (bind->program || mxg_result_info(bind->result, &info) != MXG_OK)
        return "vulkan";
    return info.target;
}

/* Reports the first error of the shader compiler: generated shaders should have none. */
static bool compile(struct bind *bind, struct compiled *compiled)
{
    const char *sources[MXG_NUM_STAGES];
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        sources[stage] = bind->program ? bind->program->sources[stage]
                                       : mxg_result_source(bind->result, (mxg_stage)stage, NULL);
    char *flat = NULL;
    if (bind->unwraps) {
        flat = unwrap_stage(sources[MXG_STAGE_VERTEX], bind_unwrapped_location(bind));
        sources[MXG_STAGE_VERTEX] = flat ? flat : sources[MXG_STAGE_VERTEX];
    }
    bool good = compile_program(target_of(bind), sources, compiled);
    free(flat);
    if (good)
        return true;
    for (size_t i = 0; i < compiled->num_messages; ++i) {
        const struct compile_message *message = &compiled->messages[i];
        if (message->severity == MXG_SEVERITY_ERROR)
            return bind_fail_as(bind, "bad-shader",
                                "the shader does not compile: %s, line %u of the %s stage",
                                message->text, message->line,
                                message->stage == MXG_STAGE_VERTEX ? "vertex" : "pixel");
    }
    return false;
}

static bool copy_reason(struct render *render)
{
    return bind_fail_as(render->bind, render->gpu->id, "%s", render->gpu->reason);
}

bool render_open(struct render *render, struct draw_canvas *canvas, struct gpu *gpu,
                 struct bind *bind)
{
    *render = (struct render){.gpu = gpu, .bind = bind};
    if (!canvas)
        return copy_reason(render);
    bool good = compile(bind, &render->compiled);
    bind->places = render->compiled.places;
    bind->num_places = render->compiled.num_places;
    if (!good || !bind_shader(bind))
        return false;
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage) {
        bind->draw.code[stage] = render->compiled.stages[stage].words;
        bind->draw.code_words[stage] = render->compiled.stages[stage].num_words;
    }
    render->program = draw_open(canvas, &bind->draw);
    return render->program || copy_reason(render);
}

bool render_frame(struct render *renders, size_t count, struct draw_canvas *canvas,
                  float *out_pixels)
{
    struct draw_program **programs = malloc((count + 1) * sizeof(struct draw_program *));
    bool good = programs != NULL;
    for (size_t i = 0; good && i < count; ++i) {
        good = bind_scene(renders[i].bind);
        programs[i] = renders[i].program;
        if (!good) {
            renders[0].bind->id = renders[i].bind->id;
            memmove(renders[0].bind->reason, renders[i].bind->reason,
                    sizeof renders[0].bind->reason);
        }
    }
    good = good && (draw_frame(canvas, programs, count, out_pixels) || copy_reason(&renders[0]));
    free(programs);
    return good;
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
    struct draw_canvas *canvas = draw_open_canvas(gpu, width, height);
    bool good =
        render_open(&render, canvas, gpu, bind) && render_frame(&render, 1, canvas, out_pixels);
    render_close(&render);
    draw_close_canvas(canvas);
    return good;
}
