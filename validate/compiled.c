// SPDX-License-Identifier: Apache-2.0
/* What compilers say, whichever they are. */
#include "validate/compile.h"

#include <stdlib.h>
#include <string.h>

void compiled_add(struct compiled *out, mxg_stage stage, mxg_severity severity, uint32_t line, const char *text, size_t len)
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
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        free(compiled->stages[stage].words);
    *compiled = (struct compiled){0};
}
