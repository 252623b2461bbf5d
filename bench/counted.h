// SPDX-License-Identifier: Apache-2.0
/* Programs on the device that count what they do. */
#ifndef MXG_BENCH_COUNTED_H
#define MXG_BENCH_COUNTED_H

#include "bench/operations.h"
#include "render/render.h"

/* From now on the program draws what a pixel executes in place of its colour. It has the stages
 * that it was compiled from, so it may count again. Ends the program where it cannot. */
void counted_instead(struct render *render, struct draw_canvas *canvas, enum count_of what);

#endif
