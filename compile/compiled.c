// SPDX-License-Identifier: Apache-2.0
/* What compilers say, whichever they are. */
#include "compile/compile.h"

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

/*
 * A shader for a path tracer (integrator=scatter) is the function scatter() without a program
 * around it. It compiles with a main that calls it, behind its last line, so that the lines of
 * messages stay. NULL if the shader has a main of its own; otherwise the caller frees the source.
 */
static char *with_main(const char *source)
{
    static const char caller[] = "\nvoid main()\n{\n    scatter();\n}\n";
    if (!source || !strstr(source, "\nvoid scatter()\n"))
        return NULL;
    size_t len = strlen(source);
    char *whole = malloc(len + sizeof caller);
    if (whole) {
        memcpy(whole, source, len);
        memcpy(whole + len, caller, sizeof caller);
    }
    return whole;
}

static bool compile_stages(const char *target, const mxg_result *result, struct compiled *out)
{
    const char *sources[MXG_NUM_STAGES];
    for (int stage = 0; stage < MXG_NUM_STAGES; ++stage)
        sources[stage] = mxg_result_source(result, (mxg_stage)stage, NULL);
    char *whole = with_main(sources[MXG_STAGE_PIXEL]);
    if (whole)
        sources[MXG_STAGE_PIXEL] = whole;
    bool good = compile_program(target, sources, out);
    free(whole);
    return good;
}

bool compile_result(const char *target, const mxg_result *result, struct compiled *out)
{
    if (mxg_result_num_parts(result) == 0)
        return compile_stages(target, result, out);
    *out = (struct compiled){0};
    for (uint32_t i = 0; i < mxg_result_num_parts(result); ++i) {
        mxg_part part = {sizeof part};
        mxg_result_part(result, i, &part);
        compile_part(target, &part, out);
    }
    return out->errors == 0;
}
