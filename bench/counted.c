// SPDX-License-Identifier: Apache-2.0
#include "bench/counted.h"

#include "bench/frame_time.h"

#include <stdlib.h>

void counted_instead(struct render *render, struct draw_canvas *canvas, enum count_of what)
{
    const struct compiled_stage *stage = &render->compiled.stages[MXG_STAGE_PIXEL];
    struct draw *draw = &render->bind->draw;
    size_t num_words = 0;
    uint32_t *words = operations_instrument(stage->words, stage->num_words, what, &num_words);
    if (!words)
        bench_fail("the shader cannot be instrumented");
    draw_close(render->program);
    draw->code[MXG_STAGE_PIXEL] = words;
    draw->code_words[MXG_STAGE_PIXEL] = num_words;
    render->program = draw_open(canvas, draw);
    if (!render->program)
        bench_fail("an instrumented shader does not open: %s", render->gpu->reason);
    free(words);
}
